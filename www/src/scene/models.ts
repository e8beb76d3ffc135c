// The two models in the scene.
import type { Vector3 as Point } from "nurbs-hausdorff";
import {
  Box3,
  Group,
  Matrix4,
  type Mesh,
  type Plane,
  type Points,
  Raycaster,
  type Texture,
  Vector3,
} from "three";
import type { MapDisplay } from "../worker/map/display.ts";
import { type DisplayModel, type Draft, SIDES, type Side, type Sides } from "../worker/protocol.ts";
import type { Viewport } from "./camera/viewport.ts";
import { DraftModel } from "./draft.ts";
import { Explosion } from "./exploded/explosion.ts";
import type { FaceClass } from "./faces.ts";
import { ModelMesh, type Visibility } from "./mesh.ts";
import { deviationGeometry } from "./overlays/deviation.ts";
import { type FirstHit, firstHit } from "./picking/firstHit.ts";
import type { Pose } from "./pose.ts";
import { type Cut, cutOf, type Section } from "./section.ts";

/** The side of a cap's plane, in diagonals of the scene: it covers all cuts. */
const CAP_SIZE = 2.5;
/** How far a box reaches beyond the other one that it encloses, in diagonals. */
const ENCLOSING = 0.01;

export class Models {
  readonly group = new Group();
  /**
   * The scene's origin in the coordinates of the models. The GPU draws in
   * float32, which is too coarse for models far from their origin.
   */
  readonly center = new Vector3();
  readonly #colors: Record<Side, string>;
  readonly #map: Texture;
  #cut: Cut | undefined;
  readonly #meshes: Sides<ModelMesh> = {};
  #drafts: Sides<DraftModel> = {};
  /** The sides whose files are being read. */
  #replaced: readonly Side[] = [];

  /** `map` is the colour scale of the deviation. */
  constructor(colors: Record<Side, string>, map: Texture) {
    this.#colors = colors;
    this.#map = map;
  }

  /** The model that is neither drawn nor compared. */
  aside: Side | undefined;
  /** The only model that is drawn, where one is compared face by face. */
  #alone: Side | undefined;
  /** A's units in one of B's; the scene is in A's. */
  #scale = 1;

  get scale(): number {
    return this.#scale;
  }

  /** Scales B; the pose has to be set again. */
  set scale(scale: number) {
    this.#scale = scale;
    this.#centre();
  }

  /** Adds models to the scene, each in place of the one before. */
  show(models: Sides<DisplayModel>): void {
    for (const side of SIDES) {
      const model = models[side];
      if (model === undefined) continue;
      this.#meshes[side]?.dispose();
      const mesh = new ModelMesh(model, side, this.#colors[side], this.#map);
      this.#meshes[side] = mesh;
      this.group.add(mesh.group);
    }
    this.dropDrafts();
    this.#centre();
  }

  /** Adds faces of a file that is being read; the models that it replaces are no longer drawn. */
  showDraft(side: Side, replaced: readonly Side[], draft: Draft): void {
    this.#replaced = replaced;
    for (const one of replaced) this.#hide(one);
    let model = this.#drafts[side];
    if (model === undefined) {
      model = new DraftModel(this.#colors[side]);
      this.#drafts[side] = model;
      this.group.add(model.group);
    }
    model.add(draft, this.center, side === "b" ? this.#scale : 1);
  }

  /** Whether faces of files that are being read are drawn. */
  get isDrafting(): boolean {
    return this.#replaced.length > 0;
  }

  /** Removes what is drawn of files that are being read, since others are read instead. */
  clearDrafts(): void {
    for (const draft of Object.values(this.#drafts)) draft.dispose();
    this.#drafts = {};
  }

  /** Ends the drawing of files that are being read; returns whether there was any. */
  dropDrafts(): boolean {
    const { isDrafting } = this;
    this.clearDrafts();
    this.#replaced = [];
    return isDrafting;
  }

  /** The sides whose models are not there to be drawn. */
  get #absent(): readonly Side[] {
    return this.aside === undefined ? this.#replaced : [...this.#replaced, this.aside];
  }

  /** The sides whose models are not drawn. */
  get #undrawn(): readonly Side[] {
    const others = SIDES.filter((side) => this.#alone !== undefined && side !== this.#alone);
    return [...this.#absent, ...others];
  }

  /** Draws one model without the other one; with `undefined`, both as they are displayed. */
  set alone(side: Side | undefined) {
    this.#alone = side;
    for (const one of SIDES) {
      const mesh = this.#meshes[one];
      if (mesh === undefined) continue;
      mesh.group.visible = mesh.visibility !== "hidden" && !this.#undrawn.includes(one);
      if (mesh.cap !== undefined) {
        mesh.cap.plane.visible = mesh.group.visible && mesh.cap.group.visible;
      }
    }
  }

  #hide(side: Side): void {
    const mesh = this.#meshes[side];
    if (mesh === undefined) return;
    mesh.group.visible = false;
    if (mesh.cap !== undefined) mesh.cap.plane.visible = false;
  }

  /** The faces of a model close: it has a cap where it is cut. */
  close(side: Side): void {
    const cap = this.#meshes[side]?.close();
    if (cap !== undefined) this.group.add(cap.plane);
  }

  #centre(): void {
    const { a, b } = this.#meshes;
    if (b !== undefined) boxOf(b.model.box).getCenter(this.center).multiplyScalar(this.#scale);
    else if (a !== undefined) boxOf(a.model.box).getCenter(this.center);
  }

  /** Shows or hides models and their triangles. */
  setDisplay(visibility: Record<Side, Visibility>, triangles: boolean): void {
    for (const side of SIDES) {
      const mesh = this.#meshes[side];
      if (mesh === undefined) continue;
      mesh.visibility = visibility[side];
      mesh.triangles = triangles;
    }
    for (const side of this.#undrawn) this.#hide(side);
  }

  /** Whether a model has colours of its file. */
  get hasFileColors(): boolean {
    return Object.values(this.#meshes).some(({ model }) => model.faceColors.length > 0);
  }

  /** Shows what is not painted in the colours of its file, or in those of the models. */
  set fileColors(shown: boolean) {
    for (const mesh of Object.values(this.#meshes)) mesh.fileColors = shown;
  }

  /** Cuts both models open; closed ones are capped. */
  cutOpen(section: Section | undefined): void {
    const { box } = this;
    this.#cut = cutOf(section, box);
    const planes = this.planes;
    const size = CAP_SIZE * box.getSize(new Vector3()).length();
    for (const mesh of Object.values(this.#meshes)) {
      if (mesh.cap !== undefined) mesh.cap.size = size;
      mesh.clipping = planes;
    }
    for (const side of this.#undrawn) this.#hide(side);
  }

  /** The planes of the section. */
  get planes(): Plane[] {
    return this.#cut === undefined ? [] : [this.#cut.plane];
  }

  /** The section where it is; undefined without one. */
  get cut(): Cut | undefined {
    return this.#cut;
  }

  /** Draws all faces of a model but these. */
  hideFaces(side: Side, hidden: ReadonlySet<number>): void {
    this.#meshes[side]?.hideFaces(hidden);
  }

  /** Draws only one of the models, or both again. */
  only(side: Side | undefined): void {
    for (const one of SIDES) {
      const mesh = this.#meshes[one];
      if (mesh === undefined || this.#undrawn.includes(one)) continue;
      const shown = mesh.visibility !== "hidden" && (side === undefined || side === one);
      mesh.group.visible = shown;
      if (mesh.cap !== undefined) mesh.cap.plane.visible = shown && mesh.cap.group.visible;
    }
  }

  /** The model that encloses the other one, which it would hide; undefined if none does. */
  get outer(): Side | undefined {
    const { a, b } = this.#meshes;
    if (a === undefined || b === undefined) return undefined;
    const [boxA, boxB] = [a, b].map(({ target, group }) => {
      group.updateWorldMatrix(true, true);
      return new Box3().setFromObject(target);
    }) as [Box3, Box3];
    const margin = ENCLOSING * this.diagonal;
    if (boxB.clone().expandByScalar(-margin).containsBox(boxA)) return "b";
    return boxA.clone().expandByScalar(-margin).containsBox(boxB) ? "a" : undefined;
  }

  /** The point of a model that the view's ray hits first, with the normal there, in the model's coordinates. */
  hit(
    viewport: Viewport,
    clientX: number,
    clientY: number,
  ): { side: Side; face: number; near: Point; normal: Point } | undefined {
    const found = this.#hit(viewport, clientX, clientY);
    if (found === undefined) return undefined;
    const { side, hit, mesh } = found;
    const face = mesh.faceHit(hit);
    const local = mesh.target.worldToLocal(hit.point.clone());
    const offset = mesh.offsetOf(face);
    if (offset !== undefined) local.sub(offset);
    const near = local.add(new Vector3(...mesh.model.tessellation.origin)).toArray();
    // Points of a scan have no normal.
    return { side, face, near, normal: hit.normal?.toArray() ?? [0, 0, 0] };
  }

  /** Where a point of a face is drawn, from the model's own coordinates; undefined where it is not. */
  pointOf(side: Side, face: number, point: Point): Vector3 | undefined {
    const mesh = this.#meshes[side];
    if (mesh === undefined || this.#undrawn.includes(side) || !mesh.draws(face)) return undefined;
    const at = new Vector3(...point).sub(new Vector3(...mesh.model.tessellation.origin));
    const offset = mesh.offsetOf(face);
    if (offset !== undefined) at.add(offset);
    return at.applyMatrix4(mesh.group.matrix);
  }

  /** Bodies that are moved apart. */
  readonly explosion = new Explosion();

  /** Moves bodies apart, from the middle of all: from 0, where they stand, to 1. */
  explode(part: number): void {
    this.explosion.move(this.#meshes, part);
  }

  /** The point that the view's ray hits first, with the surface's normal there, in the scene. */
  facing(
    viewport: Viewport,
    clientX: number,
    clientY: number,
  ): { point: Vector3; normal: Vector3 } | undefined {
    const found = this.#hit(viewport, clientX, clientY);
    if (found?.hit.normal === undefined) return undefined;
    const { hit, mesh } = found;
    const normal = hit.normal?.clone().transformDirection(mesh.target.matrixWorld);
    return normal && { point: hit.point.clone(), normal };
  }

  #hit(viewport: Viewport, clientX: number, clientY: number): FirstHit | undefined {
    return firstHit(this.#meshes, this.planes, viewport, [clientX, clientY]);
  }

  /** How many times a ray of the scene meets a model's own triangles, drawn or not. */
  crossings(side: Side, from: Vector3, direction: Vector3): number {
    const mesh = this.#meshes[side];
    if (mesh === undefined) return 0;
    mesh.group.updateWorldMatrix(true, true);
    const ray = new Raycaster(from, direction.clone().normalize());
    return ray.intersectObject(mesh.target, false).length;
  }

  /** The names of the models' shapes or files. */
  get names(): Record<Side, string> {
    const name = (side: Side) => {
      const source = this.#meshes[side]?.model.source;
      if (source === undefined) return "";
      return "shape" in source ? source.shape : source.file.name;
    };
    return { a: name("a"), b: name("b") };
  }

  colorOf(side: Side): string {
    return this.#colors[side];
  }

  /** The meshes to export, with their names. */
  get exported(): { side: Side; mesh: Mesh | Points }[] {
    return SIDES.flatMap((side) => {
      const mesh = this.#meshes[side];
      return mesh === undefined ? [] : [{ side, mesh: mesh.exported }];
    });
  }

  /** Paints models by their deviations; those without a map are plain. */
  paint(maps: Sides<MapDisplay>): void {
    for (const side of SIDES) {
      const map = maps[side];
      if (map === undefined) this.#meshes[side]?.paint();
      else this.#meshes[side]?.paint(deviationGeometry(map), map.faces);
    }
  }

  /** Colours the faces of both models by their classes; without classes, as models. */
  classify(classes: Sides<FaceClass[]>): void {
    for (const side of SIDES) this.#meshes[side]?.classify(classes[side]);
  }

  /** The box of one face, in scene coordinates. */
  faceBox(side: Side, face: number): Box3 {
    return this.#meshes[side]?.faceBox(face) ?? new Box3();
  }

  /** A point that is relative to a model's tessellation, in scene coordinates. */
  place(side: Side, [x, y, z]: Point): Vector3 {
    return new Vector3(x, y, z).applyMatrix4(this.matrixOf(side));
  }

  /** Where a model's tessellation is in the scene. */
  matrixOf(side: Side): Matrix4 {
    return this.#meshes[side]?.group.matrix ?? new Matrix4();
  }

  /** A direction of a model in the scene. */
  turn(side: Side, [x, y, z]: Point): Vector3 {
    return new Vector3(x, y, z).transformDirection(this.matrixOf(side));
  }

  /** The models drawn. */
  get drawn(): Sides<DisplayModel> {
    return Object.fromEntries(
      SIDES.flatMap((side) => {
        const model = this.#meshes[side]?.model;
        return model === undefined || side === this.aside ? [] : [[side, model]];
      }),
    );
  }

  /** Whether both models are loaded, and compared. */
  get complete(): boolean {
    return SIDES.every((side) => this.#meshes[side] !== undefined && side !== this.aside);
  }

  /** The larger diagonal of the two models' boxes. */
  get diagonal(): number {
    const diagonals = SIDES.map((side) => {
      const box = this.#meshes[side]?.model.box;
      if (box === undefined) return 0;
      const length = new Vector3(...box.min).distanceTo(new Vector3(...box.max));
      return side === "b" ? this.#scale * length : length;
    });
    return Math.max(...diagonals, 0);
  }

  /** The centre of A's box before A is moved. */
  get middle(): Vector3 {
    const box = this.#meshes.a?.model.box;
    return box === undefined ? new Vector3() : boxOf(box).getCenter(new Vector3());
  }

  /** The box of both models at their positions, in scene coordinates. */
  get box(): Box3 {
    const box = new Box3();
    for (const side of SIDES) {
      const mesh = this.#meshes[side];
      if (mesh === undefined || this.#absent.includes(side)) continue;
      mesh.group.updateWorldMatrix(true, true);
      box.union(new Box3().setFromObject(mesh.target));
    }
    for (const draft of Object.values(this.#drafts)) box.union(draft.box);
    return box;
  }

  /** Moves A to the pose, and B to its own position. */
  pose(pose: Pose): void {
    for (const side of SIDES) {
      const mesh = this.#meshes[side];
      if (mesh === undefined) continue;
      const origin = new Vector3(...mesh.model.tessellation.origin);
      if (side === "a") mesh.group.matrix.copy(pose.matrix(origin, this.center));
      else {
        const { scale } = this;
        mesh.group.matrix
          .makeScale(scale, scale, scale)
          .setPosition(origin.multiplyScalar(scale).sub(this.center));
      }
      mesh.group.matrixWorldNeedsUpdate = true;
    }
  }
}

function boxOf({ min, max }: DisplayModel["box"]): Box3 {
  return new Box3(new Vector3(...min), new Vector3(...max));
}
