"""Writes ten million points about a model, as a scanner would, as PLY of float32.

Usage: cloud.py MODEL OUT.ply. The points are drawn by area from a tessellation within 1e-5 of the
diagonal; each coordinate has normal noise of 1e-3 of the diagonal (seed 31). Needs the Python package.
"""

import sys

import numpy as np

import nurbs_hausdorff as nh

POINTS, PART = 10_000_000, 1_000_000
TOLERANCE, NOISE, SEED = 1e-5, 1e-3, 31

model = nh.read(sys.argv[1])
diagonal = np.linalg.norm(np.diff(model.bounding_box, axis=0))
mesh = model.tessellate(relative_tolerance=TOLERANCE)
first, second, third = (mesh.vertices[mesh.triangles[:, corner]] for corner in range(3))
areas = np.linalg.norm(np.cross(second - first, third - first), axis=1)
random = np.random.default_rng(SEED)
with open(sys.argv[2], "wb") as file:
    coordinates = "".join(f"property float {axis}\n" for axis in "xyz")
    head = f"ply\nformat binary_little_endian 1.0\nelement vertex {POINTS}\n{coordinates}end_header\n"
    file.write(head.encode())
    for _ in range(POINTS // PART):
        triangle = random.choice(len(areas), PART, p=areas / areas.sum())
        s, t = np.sqrt(random.random(PART))[:, None], random.random(PART)[:, None]
        corners = (corner[triangle] for corner in (first, second, third))
        weights = (1 - s, s * (1 - t), s * t)
        points = sum(weight * corner for weight, corner in zip(weights, corners))
        points += NOISE * diagonal * random.normal(size=points.shape)
        file.write(points.astype("<f4").tobytes())
