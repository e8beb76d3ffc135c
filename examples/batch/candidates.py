"""Prints the pairs of a library that may be the same part: python candidates.py FILE… > pairs.jsonl

The lines are those of `nurbs-hausdorff batch`, which decides them. Files are left apart by area and
volume, which do not depend on where a part is, and with --placed by their boxes too, for parts that
have kept their places. With n files and k pairs it takes O(n log n + k) after reading.
"""

import argparse
import itertools
import json
from dataclasses import dataclass

import numpy as np
import nurbs_hausdorff as nh

#: The largest distance of the triangles, for volumes and boxes, as a fraction of the diagonal.
MESH_TOLERANCE = 1e-4


@dataclass(frozen=True)
class Part:
    path: str
    area: float
    volume: float
    box: np.ndarray
    slack: float


def part(path: str) -> Part:
    """Return the figures of a file. The area is that of an interval; the volume that the
    triangles enclose, which for an open sheet is a number without a meaning of its own."""
    model = nh.read(path)
    mesh = model.tessellate(relative_tolerance=MESH_TOLERANCE)
    low, high = model.bounding_box
    slack = MESH_TOLERANCE * float(np.linalg.norm(high - low))
    corners = mesh.vertices[mesh.triangles] - (low + high) / 2
    volume = abs(float(np.linalg.det(corners).sum())) / 6
    box = np.stack([mesh.vertices.min(axis=0), mesh.vertices.max(axis=0)])
    return Part(path, model.area.middle, volume, box, slack)


def candidates(parts: list[Part], limit: float, difference: float, placed: bool):
    """Yield the pairs whose areas and volumes differ by at most a fraction, and whose boxes, if
    parts have kept their places, differ by no more than the limit explains.

    Only the boxes prove something: where they differ more, a point is farther than the limit.
    """
    parts = sorted(parts, key=lambda one: one.area)
    for index, one in enumerate(parts):
        near = itertools.takewhile(
            lambda other: other.area <= one.area * (1 + difference), parts[index + 1 :]
        )
        for other in near:
            volumes = sorted((one.volume, other.volume))
            # An area times the limit is the volume that a shift of the surface adds.
            if volumes[1] - volumes[0] > difference * volumes[1] + limit * other.area:
                continue
            if placed and np.abs(one.box - other.box).max() > limit + one.slack + other.slack:
                continue
            yield one, other


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("files", nargs="+")
    parser.add_argument("--limit", type=float, default=1e-3, help="in model units")
    parser.add_argument("--difference", type=float, default=1e-3, help="of areas and volumes")
    parser.add_argument("--placed", action="store_true", help="parts have kept their places")
    arguments = parser.parse_args()
    parts = [part(path) for path in arguments.files]
    found = candidates(parts, arguments.limit, arguments.difference, arguments.placed)
    for index, (one, other) in enumerate(found):
        line = {"id": index, "a": one.path, "b": other.path, "symmetric": True}
        print(json.dumps({**line, "limit": arguments.limit}))


if __name__ == "__main__":
    main()
