// Bodies moved apart, so that what lies behind and within others is seen.
import { Matrix3 } from "three";
import { SIDES, type Sides } from "../../worker/protocol.ts";
import type { ModelMesh } from "../mesh.ts";
import type { Offsets } from "./displaced.ts";
import { type BodyFaces, waysOf } from "./offsets.ts";

export class Explosion {
  /** The bodies of the models, by their faces; none before they are known. */
  bodies: BodyFaces = {};
  #part = 0;

  /** How far bodies are moved apart: from 0, where they stand, to 1. */
  get part(): number {
    return this.#part;
  }

  /** Moves bodies apart, from the middle of all: from 0, where they stand, to 1. */
  move(meshes: Sides<ModelMesh>, part: number): void {
    if (part === 0 && this.#part === 0) return;
    this.#part = part;
    const all = SIDES.flatMap((side) => {
      const mesh = meshes[side];
      if (mesh === undefined) return [];
      return (this.bodies[side] ?? []).map((faces) => ({ side, faces, box: mesh.restBox(faces) }));
    });
    const ways = waysOf(all, part);
    for (const side of SIDES) {
      const mesh = meshes[side];
      if (mesh === undefined) continue;
      const back = new Matrix3().setFromMatrix4(mesh.group.matrix.clone().invert());
      const offsets: Offsets[number][] = [];
      for (const [index, body] of all.entries()) {
        if (body.side !== side) continue;
        const way = ways[index]?.applyMatrix3(back);
        for (const face of body.faces) offsets[face] = way;
      }
      mesh.explode(part === 0 || offsets.length === 0 ? undefined : offsets);
    }
  }
}
