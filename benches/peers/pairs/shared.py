"""Models of others, read where they are when they are there."""

from nurbs import load
from pairs import Pair
from places import SHARED

# Name, model A, model B, and what A is moved by.
PAIRS = [
    ("duck-moved", "duck", "duck", (0.4, 0.1, 0.0)),
    ("teapot-merged", "utah_teapot_4nurbs", "utah_teapot", (0.0, 0.0, 0.0)),
    ("teapot-teacup", "utah_teapot", "utah_teacup", (0.0, 0.0, 0.0)),
    ("sphere6-moved", "mfem_sphere6", "mfem_sphere6", (0.3, 0.0, 0.0)),
    ("6x6-cylinder", "geomdl_surface01_6x6", "geomdl_cylinder", (0.0, 0.0, 0.0)),
    ("wings", "tigl_simplewing", "tigl_d150_wing", (0.0, 0.0, 0.0)),
    ("skinned-moved", "tigl_skinned_298x11", "tigl_skinned_298x11", (50.0, 20.0, 10.0)),
    ("wavy-moved", "nurbsdiff_amsurface", "nurbsdiff_amsurface", (0.5, 0.2, 1.0)),
    ("aorta-moved", "aorta", "aorta", (0.5, 0.3, 0.1)),
]


def pairs():
    """The pairs whose models are there; says which are not."""
    for name, a, b, translation in PAIRS:
        paths = [SHARED / f"{model}.json" for model in (a, b)]
        absent = [path.name for path in paths if not path.is_file()]
        if absent:
            print(f"SKIPPED pair {name}: {', '.join(absent)} not in {SHARED}", flush=True)
            continue
        moved = [surface.moved(translation) for surface in load(paths[0])]
        what = f"{a} moved by {translation} to {b}" if any(translation) else f"{a} to {b}"
        yield Pair(name, what, moved, load(paths[1]))
