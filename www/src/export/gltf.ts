// The models as glTF, A in the colours of its deviation.
import { DoubleSide, Float32BufferAttribute, Group, Mesh, MeshStandardMaterial } from "three";
import type { ColorScale } from "../scene/colors/scale.ts";
import type { Models } from "../scene/models.ts";
import type { FieldDisplay } from "../worker/field/fieldDisplay.ts";

/**
 * Returns a binary glTF file: metres with y up, as glTF defines. Faces are drawn from both sides,
 * since files orient them either way. Vertices are relative to the middle of B, where float32 is
 * fine; the root node has its place.
 */
export async function gltfOf(
  models: Models,
  painted: { field: FieldDisplay; scale: ColorScale } | undefined,
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
    const copy = new Mesh(
      mesh.geometry.clone(),
      new MeshStandardMaterial({ roughness: 0.6, side: DoubleSide }),
    );
    copy.name = side.toUpperCase();
    mesh.updateWorldMatrix(true, false);
    copy.applyMatrix4(mesh.matrixWorld);
    if (copy.geometry.hasAttribute("uv")) {
      copy.geometry.deleteAttribute("uv");
      if (painted !== undefined) paint(copy, painted.field, painted.scale);
    } else copy.material.color.set(models.colorOf(side));
    group.add(copy);
  }
  const file = await new GLTFExporter().parseAsync(root, { binary: true });
  for (const child of group.children) if (child instanceof Mesh) child.geometry.dispose();
  return new Blob([file as ArrayBuffer], { type: "model/gltf-binary" });
}

function paint(
  mesh: Mesh<Mesh["geometry"], MeshStandardMaterial>,
  { signed, distances }: FieldDisplay,
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
