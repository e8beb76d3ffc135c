"""Closest points by Open3D and OpenCASCADE, for benches/points/points.mjs.

Usage: points.py FOLDER MODEL. FOLDER holds the points and the mesh that points.mjs
wrote; every tool prints one line of JSON, with the file of its distances.
"""

import json
import sys
import time
from pathlib import Path

import numpy as np

# OpenCASCADE projects on every face in turn: as many points as take some seconds.
OPENCASCADE_POINTS = 200

folder, model = Path(sys.argv[1]), Path(sys.argv[2])
points = np.fromfile(folder / "points.f64", np.float64).reshape(-1, 3)


def clock():
    """The time by the clock, and that of the processor by all threads."""
    return np.array([time.perf_counter(), time.process_time()])


def report(name, times, distances):
    """Prints one tool's line."""
    file = folder / f"{name.split()[0]}.f64"
    np.asarray(distances, np.float64).tofile(file)
    print(json.dumps({"name": name, "seconds": times[0], "busy": times[1], "distances": str(file)}), flush=True)


def open3d():
    """The triangles' closest points by Embree, on all cores."""
    import open3d

    origin = np.array(json.loads((folder / "origin.json").read_text()))
    positions = np.fromfile(folder / "positions.f32", np.float32).reshape(-1, 3)
    indices = np.fromfile(folder / "indices.u32", np.uint32).reshape(-1, 3)
    scene = open3d.t.geometry.RaycastingScene()
    scene.add_triangles(open3d.core.Tensor(positions), open3d.core.Tensor(indices))
    queries = (points - origin).astype(np.float32)
    scene.compute_closest_points(open3d.core.Tensor(queries[:1]))
    start = clock()
    feet = scene.compute_closest_points(open3d.core.Tensor(queries))["points"].numpy()
    report("Open3D, on the mesh, all cores", clock() - start, np.linalg.norm(queries - feet, axis=1))


def opencascade():
    """The surfaces' closest points, every surface in turn."""
    sys.path.insert(0, str(Path(__file__).parent / "peers"))
    import nurbs
    import opencascade as occ
    from OCP.BRep import BRep_Builder
    from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeFace, BRepBuilderAPI_MakeVertex
    from OCP.BRepExtrema import BRepExtrema_DistShapeShape
    from OCP.gp import gp_Pnt
    from OCP.TopoDS import TopoDS_Compound

    shape, builder = TopoDS_Compound(), BRep_Builder()
    builder.MakeCompound(shape)
    for surface in nurbs.load(model):
        builder.Add(shape, BRepBuilderAPI_MakeFace(occ.surface(surface), occ.CONFUSION).Face())
    distances = []
    start = clock()
    for point in points[:: len(points) // OPENCASCADE_POINTS][:OPENCASCADE_POINTS]:
        vertex = BRepBuilderAPI_MakeVertex(gp_Pnt(*map(float, point))).Vertex()
        distances.append(BRepExtrema_DistShapeShape(vertex, shape).Value())
    report("OpenCASCADE, BRepExtrema", clock() - start, distances)


for tool in (open3d, opencascade):
    try:
        tool()
    except ImportError as error:
        print(f"{tool.__name__} is not installed: {error}", file=sys.stderr)
