"""PyMeshLab: MeshLab's filter 'Hausdorff Distance'."""

import time

import pymeshlab

from peers.tessellated import MeshPeer


class Peer(MeshPeer):
    name = "PyMeshLab"
    guarantee = "none: samples of a mesh to a mesh"
    settings = (
        "`get_hausdorff_distance`: vertices, edges and faces sampled, `samplenum` the number of vertices "
        f"(its default), `maxdist` beyond both models; {MeshPeer.how}"
    )

    def distance(self):
        (vertices_a, faces_a), (vertices_b, faces_b) = self.a, self.b
        meshes = pymeshlab.MeshSet(verbose=False)
        meshes.add_mesh(pymeshlab.Mesh(vertices_a, faces_a.astype("int32")))
        meshes.add_mesh(pymeshlab.Mesh(vertices_b, faces_b.astype("int32")))
        # Beyond `maxdist` samples are dropped; the boxes can be a diagonal apart many times over.
        apart = abs(vertices_a.mean(axis=0) - vertices_b.mean(axis=0)).sum()
        start = time.perf_counter()
        result = meshes.get_hausdorff_distance(
            sampledmesh=0,
            targetmesh=1,
            samplevert=True,
            sampleedge=True,
            sampleface=True,
            samplenum=len(vertices_a),
            maxdist=pymeshlab.PureValue(2 * self.diagonal + apart),
        )
        return result["max"], time.perf_counter() - start
