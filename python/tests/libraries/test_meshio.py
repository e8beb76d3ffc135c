"""Meshes of meshio, where it is installed."""

import numpy as np
import pytest

import nurbs_hausdorff as nh
from square import CORNERS, contains, flat, refused

meshio = pytest.importorskip("meshio")


def test_meshes_of_meshio():
    square = [("quad", np.array([[0, 1, 2, 3]])), ("triangle", np.array([[0, 1, 2]]))]
    model = nh.model(meshio.Mesh(CORNERS, square))
    assert (model.kind, model.facet_count, model.gap) == ("mesh", 3, 0.0)
    assert contains(nh.distance(model, flat(3.0)), 3.0)
    raised = meshio.Mesh(CORNERS + [[0, 0, 0], [0, 0, 0], [0, 0, 0], [0, 0, 0.4]], square[:1])
    assert nh.model(raised).gap == pytest.approx(0.1, rel=0.05)
    with pytest.warns(UserWarning, match="1 lines"):
        assert nh.model(meshio.Mesh(CORNERS, [*square, ("line", np.array([[0, 1]]))])).facet_count == 3
    assert nh.model(meshio.Mesh(CORNERS, [])).kind == "points"
    tetrahedron = meshio.Mesh(np.vstack([CORNERS[:3], [[0, 0, 1]]]), [("tetra", np.array([[0, 1, 2, 3]]))])
    assert "'tetra'" in str(refused(tetrahedron))
