// The models as glTF, in the colours of their deviations.
import {
  DoubleSide,
  Float32BufferAttribute,
  Group,
  Mesh,
  MeshStandardMaterial,
  Points,
  PointsMaterial,
} from "three";
import type { ColorScale } from "../scene/colors/scale.ts";
import type { Models } from "../scene/models.ts";
import type { MapDisplay } from "../worker/map/display.ts";
import type { Sides } from "../worker/protocol.ts";

/**
 * Returns a binary glTF file: metres with y up, as glTF defines. Faces are drawn from both sides,
 * since files orient them either way. Vertices are relative to the middle of B, where float32 is
 * fine; the root node has its place.
 */
export async function gltfOf(
  models: Models,
  painted: { maps: Sides<MapDisplay>; scale: ColorScale } | undefined,
  metres: number,
): Promise<Blob> {
  const { GLTFExporter } = await import("three/addons/exporters/GLTFExporter.js");
  const [root, group] = [new Group(), new Group()];
  root.name = "models";
  root.rotation.x = -Math.PI / 2;
  root.scale.setScalar(metres);
  group.position.copy(models.center);
  root.add(group);
  for (const { side, mesh } of models.exported) {
    const geometry = mesh.geometry.clone();
    const copy =
      mesh instanceof Points
        ? new Points(geometry, new PointsMaterial())
        : new Mesh(geometry, new MeshStandardMaterial({ roughness: 0.6, side: DoubleSide }));
    copy.name = side.toUpperCase();
    mesh.updateWorldMatrix(true, false);
    copy.applyMatrix4(mesh.matrixWorld);
    const map = painted?.maps[side];
    if (copy.geometry.hasAttribute("uv")) {
      copy.geometry.deleteAttribute("uv");
      if (painted !== undefined && map !== undefined) paint(copy, map, painted.scale);
    } else copy.material.color.set(models.colorOf(side));
    group.add(copy);
  }
  const file = await new GLTFExporter().parseAsync(root, { binary: true });
  for (const child of group.children)
    if (child instanceof Mesh || child instanceof Points) child.geometry.dispose();
  return new Blob([file as ArrayBuffer], { type: "model/gltf-binary" });
}

function paint(
  mesh: Mesh<Mesh["geometry"], MeshStandardMaterial> | Points<Mesh["geometry"], PointsMaterial>,
  { signed, distances }: MapDisplay,
  scale: ColorScale,
): void {
  const colors = new Float32Array(3 * signed.length);
  for (const [index, deviation] of signed.entries()) {
    const known = !Number.isNaN(deviation);
    scale.color(known ? deviation : (distances[index] ?? 0), known).toArray(colors, 3 * index);
  }
  mesh.geometry.setAttribute("color", new Float32BufferAttribute(colors, 3));
  mesh.material.vertexColors = true;
}
