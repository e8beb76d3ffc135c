"""All distances of a cloud of cloud.py by Open3D, and of some of its points by trimesh.

Usage: cloud_peers.py MESH.npz CLOUD.ply, after

    cloud_peers.py MESH.npz --tessellate MODEL [--relative-tolerance 1e-4]

which needs the Python package; the other tools may be in an environment of their own. A line for
each tool has its seconds by the clock and of the processor, points, the largest distance, the mean
and the peak memory of the process. Distances are those from the triangles, off by up to the tolerance.
"""

import argparse
import resource
import time

import numpy as np

# trimesh takes about a millisecond a point.
TRIMESH_POINTS = 20_000
TOLERANCE = 1e-4
# The system counts in KiB.
MIB = 1024


def tessellate(path, model, tolerance):
    import nurbs_hausdorff as nh

    mesh = nh.read(model).tessellate(relative_tolerance=tolerance)
    np.savez(path, vertices=mesh.vertices, triangles=mesh.triangles)


def points_of(path):
    with open(path, "rb") as file:
        while file.readline() != b"end_header\n":
            pass
        return np.frombuffer(file.read(), "<f4").reshape(-1, 3)


def report(name, start, distances):
    clock, busy = time.perf_counter() - start[0], time.process_time() - start[1]
    memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss // MIB
    print(
        f"{name}: {clock:.1f} s, {busy:.1f} s of the processor, {len(distances):,} points, "
        f"largest {distances.max():.7f}, mean {distances.mean():.7f}, {memory} MiB",
        flush=True,
    )


def now():
    return time.perf_counter(), time.process_time()


def open3d(vertices, triangles, points):
    import open3d

    scene = open3d.t.geometry.RaycastingScene()
    scene.add_triangles(
        open3d.core.Tensor(vertices.astype(np.float32)), open3d.core.Tensor(triangles.astype(np.uint32))
    )
    start = now()
    distances = scene.compute_distance(open3d.core.Tensor(np.ascontiguousarray(points))).numpy()
    report("Open3D", start, distances)


def trimesh(vertices, triangles, points):
    import trimesh

    mesh = trimesh.Trimesh(vertices, triangles, process=False)
    some = points[:: max(1, len(points) // TRIMESH_POINTS)][:TRIMESH_POINTS]
    trimesh.proximity.closest_point(mesh, some[:1])
    start = now()
    _, distances, _ = trimesh.proximity.closest_point(mesh, some)
    report("trimesh", start, distances)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("mesh")
    parser.add_argument("cloud", nargs="?")
    parser.add_argument("--tessellate", metavar="MODEL")
    parser.add_argument("--relative-tolerance", type=float, default=TOLERANCE)
    options = parser.parse_args()
    if options.tessellate:
        tessellate(options.mesh, options.tessellate, options.relative_tolerance)
        return
    mesh, points = np.load(options.mesh), points_of(options.cloud)
    print(f"{len(mesh['triangles']):,} triangles", flush=True)
    open3d(mesh["vertices"], mesh["triangles"], points)
    trimesh(mesh["vertices"], mesh["triangles"], points)


if __name__ == "__main__":
    main()
