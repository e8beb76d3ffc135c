// The picture of the sheet, the part and the arrow between them.
import type { DistanceResult, Tessellation } from "nurbs-hausdorff/worker";
import { BufferAttribute, BufferGeometry, type Material, Mesh, Vector3 } from "three";
import { element } from "../common/elements.ts";
import { distanceText } from "../common/text/numbers.ts";
import { Viewport } from "../scene/camera/viewport.ts";
import { cssColor } from "../scene/colors/css.ts";
import { glass, satin } from "../scene/material.ts";
import { Arrow } from "../scene/overlays/arrow.ts";

const ORIGIN = new Vector3();

export class DeformingScene {
  readonly #viewport: Viewport;
  readonly #sheet: Mesh;
  readonly #part: Mesh;
  readonly #arrow = new Arrow(element("label"), [], cssColor("accent"));

  /** @throws {Error} without WebGL. */
  static async open(canvas: HTMLCanvasElement): Promise<DeformingScene> {
    return new DeformingScene(await Viewport.open(canvas));
  }

  private constructor(viewport: Viewport) {
    this.#viewport = viewport;
    this.#sheet = meshOf(satin(cssColor("a")));
    this.#part = meshOf(glass(cssColor("b")));
    this.#viewport.scene.add(this.#sheet, this.#part, this.#arrow.group);
    this.#viewport.onDraw = () => this.#arrow.update(this.#viewport);
  }

  /** Shows another part, whole. */
  showPart(triangles: Tessellation): void {
    show(this.#part, triangles);
    void this.#viewport.compile();
    const box = this.#part.geometry.boundingBox;
    if (box === null) return;
    this.#viewport.fit(box.clone().translate(this.#part.position));
  }

  show(triangles: Tessellation, { witness, computed, diagonal }: DistanceResult): void {
    show(this.#sheet, triangles);
    const texts = { length: distanceText(computed, diagonal), from: "", to: "" };
    this.#arrow.show(witness.a.point, witness.b.point, texts, ORIGIN);
    this.#viewport.draw();
  }
}

function meshOf(material: Material): Mesh {
  const mesh = new Mesh(new BufferGeometry(), material);
  // The sheet changes every frame.
  mesh.frustumCulled = false;
  return mesh;
}

function show(mesh: Mesh, { positions, normals, indices, origin }: Tessellation): void {
  mesh.geometry.dispose();
  mesh.geometry = new BufferGeometry()
    .setAttribute("position", new BufferAttribute(positions, 3))
    .setAttribute("normal", new BufferAttribute(normals, 3))
    .setIndex(new BufferAttribute(indices, 1));
  mesh.geometry.computeBoundingBox();
  mesh.position.set(...origin);
}
