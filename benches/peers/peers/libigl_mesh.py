"""libigl: the vertices of A's mesh to the triangles of B's."""

import time

import igl

from peers.tessellated import MeshPeer


class Peer(MeshPeer):
    name = "libigl"
    guarantee = "none: vertices of a mesh to a mesh"
    settings = (
        f"`point_mesh_squared_distance` of A's vertices (`hausdorff` does the same both ways); {MeshPeer.how}"
    )

    def distance(self):
        (vertices_a, _), (vertices_b, faces_b) = self.a, self.b
        start = time.perf_counter()
        squared, _, _ = igl.point_mesh_squared_distance(vertices_a, vertices_b, faces_b)
        return float(squared.max()) ** 0.5, time.perf_counter() - start
