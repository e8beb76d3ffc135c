// The worker that builds a tree, so that the page answers meanwhile.
import { MeshBVH } from "three-mesh-bvh";
import { geometryOf, type Hittable, type Serialized } from "./geometry.ts";

self.onmessage = ({ data }: MessageEvent<Hittable>) => {
  // Triangles and points keep their order, which other parts of the page know them by.
  const tree = new MeshBVH(geometryOf(data), { indirect: true });
  const { index: _, ...serialized } = MeshBVH.serialize(tree, { cloneBuffers: false });
  const { roots, indirectBuffer }: Serialized = serialized;
  const buffers = [...roots, indirectBuffer?.buffer].filter((one) => one instanceof ArrayBuffer);
  self.postMessage(serialized, { transfer: buffers });
};
