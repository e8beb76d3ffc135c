"""Mesh to mesh: this package beside `cascading-upper-bounds` and CGAL, at the same tolerance.

    python benches/points/meshes.py NURBS-HAUSDORFF CGAL A.stl[.gz]…

Each mesh is measured to its simplification to a tenth of its triangles (quadric decimation of Open3D), and back, at
1e-4 and 1e-6 of A's diagonal. CGAL is the program of `benches/peers/peers/cgal`, made by
`g++ -O3 -DNDEBUG hausdorff.cpp -lgmp -lmpfr`; `-` leaves it out. Needs `cascading-upper-bounds` and
`open3d`. Seconds are the least user time of five runs on one thread: of a process with reading for ours
and for CGAL, without reading for the other.
"""

import gzip
import json
import resource
import signal
import subprocess
import sys
import tempfile
from multiprocessing import Process, Queue
from pathlib import Path

import numpy as np
import open3d as o3d
from cascading_upper_bounds import pompeiu_hausdorff

# A tool is given up after this time.
LIMIT_SECONDS = 60
PART_KEPT = 0.1
RUNS = 5


def user_seconds(who: int) -> float:
    return resource.getrusage(who).ru_utime


def ours(command: str, a: Path, b: Path, tolerance: float) -> tuple[float, float, float]:
    arguments = [command, "distance", a, b, "--json", "--relative-tolerance", repr(tolerance)]
    times = []
    for _ in range(RUNS):
        before = user_seconds(resource.RUSAGE_CHILDREN)
        found = subprocess.run(
            arguments, capture_output=True, check=True, env={"RAYON_NUM_THREADS": "1"}
        )
        times.append(user_seconds(resource.RUSAGE_CHILDREN) - before)
    found = json.loads(found.stdout)
    return found["lower"], found["upper"], min(times)


def cascading(a: tuple, b: tuple, tolerance: float) -> tuple[float, float, float] | None:
    def run(queue: Queue) -> None:
        times = []
        for _ in range(RUNS):
            before = user_seconds(resource.RUSAGE_SELF)
            found = pompeiu_hausdorff(*a, *b, tol=tolerance)
            times.append(user_seconds(resource.RUSAGE_SELF) - before)
        queue.put((found[0], found[1], min(times)))

    queue = Queue()
    process = Process(target=run, args=(queue,))
    process.start()
    process.join(LIMIT_SECONDS)
    if process.is_alive():
        process.kill()
        return None
    return queue.get() if process.exitcode == 0 else None


def cgal(program: str, a: Path, b: Path, bound: float) -> tuple[float, float, float] | None:
    times = []
    for _ in range(RUNS):
        before = user_seconds(resource.RUSAGE_CHILDREN)
        try:
            found = subprocess.run(
                [program, a, b, repr(bound)],
                capture_output=True,
                check=True,
                timeout=LIMIT_SECONDS,
            )
        except (subprocess.TimeoutExpired, subprocess.CalledProcessError):
            return None
        times.append(user_seconds(resource.RUSAGE_CHILDREN) - before)
    value = json.loads(found.stdout)["value"]
    return value - bound, value + bound, min(times)


def write(folder: Path, name: str, mesh: o3d.geometry.TriangleMesh) -> tuple[Path, Path, tuple]:
    # Triangles without area are left out: CGAL takes none.
    vertices = np.asarray(mesh.vertices).astype(np.float32).astype(np.float64)
    triangles = np.asarray(mesh.triangles).astype(np.int32)
    ply = folder / f"{name}.ply"
    with ply.open("wb") as file:
        head = f"ply\nformat binary_little_endian 1.0\nelement vertex {len(vertices)}\n"
        head += "property double x\nproperty double y\nproperty double z\n"
        head += f"element face {len(triangles)}\nproperty list uchar int vertex_indices\nend_header\n"
        file.write(head.encode())
        file.write(vertices.tobytes())
        rows = np.empty(len(triangles), dtype=[("n", "u1"), ("c", "<i4", 3)])
        rows["n"], rows["c"] = 3, triangles
        file.write(rows.tobytes())
    binary = folder / f"{name}.bin"
    with binary.open("wb") as file:
        np.array([len(vertices), len(triangles)], dtype=np.int64).tofile(file)
        vertices.tofile(file)
        triangles.astype(np.int64).tofile(file)
    return ply, binary, (vertices, triangles)


def shown(found: tuple[float, float, float] | None) -> str:
    if found is None:
        return f"none in {LIMIT_SECONDS} s"
    return f"{found[0]:.9g} to {found[1]:.9g}, {found[2]:.3f}"


def main() -> None:
    command, program, *paths = sys.argv[1:]
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    print("pair, triangles, tolerance, ours, s, cascading-upper-bounds, s, CGAL, s", flush=True)
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        for path in map(Path, paths):
            name = path.name.split(".")[0]
            stl = folder / "in.stl"
            opened = gzip.open(path) if path.suffix == ".gz" else path.open("rb")
            with opened as file:
                stl.write_bytes(file.read())
            mesh = o3d.io.read_triangle_mesh(str(stl))
            mesh = mesh.remove_duplicated_vertices().remove_degenerate_triangles()
            count = len(mesh.triangles)
            few = mesh.simplify_quadric_decimation(int(PART_KEPT * count)).remove_degenerate_triangles()
            sides = [write(folder, "a", mesh), write(folder, "b", few)]
            for a, b, way in [(*sides, "to its simplification"), (*sides[::-1], "from it")]:
                diagonal = float(np.linalg.norm(np.ptp(np.vstack([sides[0][2][0], sides[1][2][0]]), axis=0)))
                for tolerance in [1e-4, 1e-6]:
                    width = tolerance * diagonal
                    found = [
                        ours(command, a[0], b[0], tolerance),
                        cascading(a[2], b[2], width),
                        # Its error bound is to both sides of the value.
                        cgal(program, a[1], b[1], 0.5 * width) if program != "-" else None,
                    ]
                    counts = f"{len(a[2][1])} / {len(b[2][1])}"
                    print(f"{name} {way}; {counts}; {tolerance:g}", *map(shown, found), sep="; ", flush=True)


if __name__ == "__main__":
    main()
