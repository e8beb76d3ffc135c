// What is drawn of a file while it is read: its faces as they come, some at a time.
import type { Vector3 } from "nurbs-hausdorff";
import type { FaceDraft } from "nurbs-hausdorff/cad";
import { concatenated } from "../../common/arrays.ts";
import type { Draft } from "../protocol.ts";

/** Milliseconds between two drawings, so that many small faces cost few. */
const PAUSE = 80;

export class Drafts {
  readonly #show: (draft: Draft) => void;
  #faces: FaceDraft[] = [];
  #origin: Vector3 | undefined;
  #shown = performance.now();

  /** `show` is given the faces since the last time. */
  constructor(show: (draft: Draft) => void) {
    this.#show = show;
  }

  add(face: FaceDraft): void {
    this.#faces.push(face);
    if (performance.now() - this.#shown < PAUSE) return;
    this.#shown = performance.now();
    const faces = this.#faces;
    this.#faces = [];
    this.#origin ??= originOf(faces);
    if (this.#origin !== undefined) this.#show(joined(faces, this.#origin, face.fraction));
  }
}

/** Some point of the faces: what is drawn in float32 is relative to it. */
function originOf(faces: FaceDraft[]): Vector3 | undefined {
  for (const { edges, triangles } of faces) {
    if (triangles !== undefined) return triangles.origin;
    const [x, y, z] = edges ?? [];
    if (x !== undefined && y !== undefined && z !== undefined) return [x, y, z];
  }
  return undefined;
}

function joined(faces: FaceDraft[], origin: Vector3, fraction: number): Draft {
  const relative = (values: ArrayLike<number>, own: Vector3) =>
    Float32Array.from(values, (value, at) => value + ((own[at % 3] ?? 0) - (origin[at % 3] ?? 0)));
  const all = faces.flatMap(({ triangles }) => triangles ?? []);
  let first = 0;
  const indices = all.map((face) => {
    const own = face.indices.map((index) => index + first);
    first += face.positions.length / 3;
    return own;
  });
  return {
    ...{ origin, fraction },
    edges: concatenated(
      Float32Array,
      faces.map(({ edges }) => relative(edges ?? [], [0, 0, 0])),
    ),
    positions: concatenated(
      Float32Array,
      all.map((face) => relative(face.positions, face.origin)),
    ),
    normals: concatenated(
      Float32Array,
      all.map(({ normals }) => normals),
    ),
    indices: concatenated(Uint32Array, indices),
  };
}
