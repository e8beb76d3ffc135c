// The faces of one model, coloured by the class of each: one draw call a class.
import type { Tessellation } from "nurbs-hausdorff";
import {
  Box3,
  BufferAttribute,
  type BufferGeometry,
  Color,
  type Material,
  Mesh,
  Vector3,
} from "three";
import type { Side } from "../worker/protocol.ts";
import { ofSameVertices } from "./bounds.ts";
import { glass, satin } from "./material.ts";

export type FaceClass = "plain" | "own" | "undecided" | "changed" | "extended" | "near" | "clash";

const CLASSES: readonly FaceClass[] = [
  "plain",
  "own",
  "undecided",
  "changed",
  "extended",
  "near",
  "clash",
];

/** The colour of faces that need no attention, and of faces that the search did not decide. */
const PLAIN = "#98a3ad";
const UNDECIDED = "#8a5cc2";
/** The colours of faces that come near the other model, and of those that meet it. */
const NEAR = "#f2a93b";
const CLASH = "#d3122f";

/** The part of the grey in the colour of faces that were only extended or shortened. */
const PALER = 0.6;

const paler = (color: string): string =>
  `#${new Color(color).lerp(new Color(PLAIN), PALER).getHexString()}`;

/** How far back coincident faces lie. */
const OFFSETS: Readonly<Record<Side, number>> = { a: 1, b: 3 };

export class FaceColors {
  readonly mesh: Mesh<BufferGeometry, Material[]>;
  readonly #source: BufferGeometry;
  /** The indices of all faces: the source's may be without those that are hidden. */
  readonly #indices: Uint32Array;
  #hidden: ReadonlySet<number> = new Set();
  #classes: FaceClass[] | undefined;
  readonly #ranges: Tessellation["faces"];

  /** Faces of B lie a little behind those of A that coincide; `color` is the model's colour. */
  constructor(
    source: BufferGeometry,
    { indices, faces: ranges }: Pick<Tessellation, "indices" | "faces">,
    side: Side,
    color: string,
  ) {
    this.#source = source;
    this.#indices = indices;
    this.#ranges = ranges;
    const geometry = ofSameVertices(source, "position", "normal");
    this.mesh = new Mesh(geometry, [
      glass(PLAIN),
      glass(color),
      satin(UNDECIDED, OFFSETS[side]),
      satin(color, OFFSETS[side]),
      satin(paler(color), OFFSETS[side]),
      satin(NEAR, OFFSETS[side]),
      satin(CLASH, OFFSETS[side]),
    ]);
    this.mesh.visible = false;
  }

  /** The faces that are not drawn. */
  set hidden(hidden: ReadonlySet<number>) {
    this.#hidden = hidden;
    this.show(this.#classes);
  }

  /** Shows every face in the colour of its class; without classes, nothing. */
  show(classes: FaceClass[] | undefined): void {
    this.#classes = classes;
    this.mesh.visible = classes !== undefined;
    const source = this.#indices;
    if (classes === undefined) return;
    const { geometry } = this.mesh;
    const indices = new Uint32Array(source.length);
    geometry.clearGroups();
    let end = 0;
    for (const [material, name] of CLASSES.entries()) {
      const begin = end;
      for (const [face, { firstIndex, indexCount }] of this.#ranges.entries()) {
        if ((classes[face] ?? "plain") !== name || this.#hidden.has(face)) continue;
        indices.set(source.subarray(firstIndex, firstIndex + indexCount), end);
        end += indexCount;
      }
      if (end > begin) geometry.addGroup(begin, end - begin, material);
    }
    geometry.setIndex(new BufferAttribute(indices, 1));
  }

  /** The box of one face, in the mesh's coordinates; empty for a face without triangles. */
  box(face: number): Box3 {
    const box = new Box3();
    const range = this.#ranges[face];
    if (range === undefined) return box;
    const positions = this.#source.getAttribute("position");
    const point = new Vector3();
    for (let at = range.firstIndex; at < range.firstIndex + range.indexCount; at++) {
      box.expandByPoint(point.fromBufferAttribute(positions, this.#indices[at] ?? 0));
    }
    return box;
  }

  /** Frees the geometry; the model's mesh frees all materials. */
  dispose(): void {
    this.mesh.geometry.dispose();
  }
}
