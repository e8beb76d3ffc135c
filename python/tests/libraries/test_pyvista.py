"""Meshes, grids and blocks of pyvista, where it is installed."""

import numpy as np
import pytest

import nurbs_hausdorff as nh
from square import CORNERS, contains, flat

pyvista = pytest.importorskip("pyvista")


def test_meshes_of_pyvista_are_taken():
    square = pyvista.Plane(i_size=2, j_size=2, i_resolution=3, j_resolution=2)
    model = nh.model(square)
    assert model.facet_count == 12 and contains(nh.distance(model, flat(0.5)), 0.5)
    assert nh.model(pyvista.PolyData(CORNERS)).kind == "points"


def test_grids_and_blocks_of_pyvista():
    plane = pyvista.Plane(i_size=2, j_size=2)
    assert nh.model(plane.cast_to_unstructured_grid()).facet_count == nh.model(plane).facet_count
    blocks = pyvista.MultiBlock([plane.triangulate(), plane.triangulate().translate((0, 0, 1))])
    assert nh.model(blocks).facet_count == 2 * plane.triangulate().n_cells


def test_a_field_becomes_a_pyvista_mesh():
    slope = flat(1.0)
    slope["ctrl"] = slope["ctrl"] + slope["ctrl"][..., :1] * [0.0, 0.0, 0.5]
    field = nh.field(flat(0.0), slope, samples=5)
    grid = field.to_pyvista()[0]
    assert grid.n_points == 25
    order = np.argsort(grid.points @ [7.0, 1.0, 0.1])
    distances = field.parts[0].distances.ravel()
    other = np.argsort(field.parts[0].points.reshape(-1, 3) @ [7.0, 1.0, 0.1])
    assert np.allclose(grid.point_data["distance"][order], distances[other])
