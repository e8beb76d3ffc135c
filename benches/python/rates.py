"""Rates of the Python package beside Open3D, trimesh and OpenCASCADE.

    python rates.py points FILE.stp [COUNT]
    python rates.py distance A.stp B.stp [COUNT]

`points`: closest points of random points of the model's box, and of a tessellation of the same
error by Open3D and trimesh. `distance`: the certified distance from A to B, and BRepExtrema at
COUNT of A's vertices and samples. CPU seconds of all threads.
"""

import sys
import time

import numpy as np
import nurbs_hausdorff as nh

#: Largest error of the distances, as a fraction of the diagonal, for all alike.
RELATIVE_ERROR = 1e-4


class Timed:
    """CPU seconds of a block."""

    def __enter__(self):
        self.begun = time.process_time()
        return self

    def __exit__(self, *_):
        self.seconds = time.process_time() - self.begun


def points(path: str, count: str = "1000000") -> None:
    model = nh.read(path)
    low, high = model.bounding_box
    diagonal = float(np.linalg.norm(high - low))
    given = np.random.default_rng(1).uniform(low, high, (int(count), 3))
    with Timed() as timed:
        found = nh.closest_points(model, given, relative_tolerance=RELATIVE_ERROR)
    report("nurbs_hausdorff", len(given), timed.seconds, found.distances, found.distances)
    mesh = model.tessellate(relative_tolerance=RELATIVE_ERROR)
    print(f"{len(mesh.triangles)} triangles within {RELATIVE_ERROR * diagonal:.3g}")
    for tool in (open3d, trimesh):
        try:
            tool(mesh, given, found.distances)
        except ImportError as error:
            print(f"{tool.__name__} is not installed: {error}", file=sys.stderr)


def report(name: str, count: int, seconds: float, distances, ours) -> None:
    off = np.abs(distances - ours[: len(distances)]).max()
    print(f"{name}: {count / seconds:,.0f} points a second, {off:.2g} from ours", flush=True)


def open3d(mesh: nh.Mesh, given, ours) -> None:
    import open3d

    scene = open3d.t.geometry.RaycastingScene()
    origin = mesh.vertices.mean(axis=0)
    scene.add_triangles(
        open3d.core.Tensor((mesh.vertices - origin).astype(np.float32)),
        open3d.core.Tensor(mesh.triangles),
    )
    queries = (given - origin).astype(np.float32)
    with Timed() as timed:
        feet = scene.compute_closest_points(open3d.core.Tensor(queries))["points"].numpy()
    report("Open3D", len(given), timed.seconds, np.linalg.norm(queries - feet, axis=1), ours)


#: Points for trimesh, which takes minutes for a million.
TRIMESH_POINTS = 20_000


def trimesh(mesh: nh.Mesh, given, ours) -> None:
    import trimesh

    given = given[:TRIMESH_POINTS]
    surface = trimesh.Trimesh(mesh.vertices, mesh.triangles, process=False)
    surface.triangles_tree
    with Timed() as timed:
        distances = trimesh.proximity.closest_point(surface, given)[1]
    report("trimesh", len(given), timed.seconds, distances, ours)


def distance(a: str, b: str, count: str = "200") -> None:
    with Timed() as timed:
        models = nh.read(a), nh.read(b)
        result = nh.distance(*models)
    print(f"nurbs_hausdorff: {result.lower} to {result.upper}, {timed.seconds:.2f} s with reading")
    from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeVertex
    from OCP.BRepExtrema import BRepExtrema_DistShapeShape
    from OCP.gp import gp_Pnt
    from OCP.STEPControl import STEPControl_Reader

    reader = STEPControl_Reader()
    reader.ReadFile(b)
    reader.TransferRoots()
    shape = reader.OneShape()
    vertices = models[0].tessellate().vertices
    chosen = vertices[:: max(1, len(vertices) // int(count))]
    with Timed() as timed:
        largest = max(
            BRepExtrema_DistShapeShape(
                BRepBuilderAPI_MakeVertex(gp_Pnt(*map(float, point))).Vertex(), shape
            ).Value()
            for point in chosen
        )
    print(f"BRepExtrema: {largest} at {len(chosen)} samples, {timed.seconds:.2f} s without reading")


if __name__ == "__main__":
    {"points": points, "distance": distance}[sys.argv[1]](*sys.argv[2:])
