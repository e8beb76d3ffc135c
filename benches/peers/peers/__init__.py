"""One file a peer, each with a class `Peer`; see `base.py` for what it offers."""

# In the order of the table.
NAMES = [
    "ours",
    "occt",
    "brep_kernel",
    "smlib",
    "splinepy_proximity",
    "scipy_samples",
    "libigl_mesh",
    "cgal_mesh",
    "meshlab_mesh",
]
