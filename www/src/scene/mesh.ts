// One model in the scene: its surface, plain or painted, its outline, its triangles and its cap.
import {
  Box3,
  BufferAttribute,
  BufferGeometry,
  Color,
  Group,
  type Intersection,
  LineBasicMaterial,
  LineSegments,
  type Material,
  Mesh,
  MeshBasicMaterial,
  type Plane,
  Points,
  PointsMaterial,
  SRGBColorSpace,
  type Texture,
  Vector3,
} from "three";
import { concatenated } from "../common/arrays.ts";
import type { DisplayModel, Side } from "../worker/protocol.ts";
import { forgetAllBounds, ofSameVertices, setBounds } from "./bounds.ts";
import { Cap } from "./cap.ts";
import {
  displace,
  faceOfTriangle,
  facesByTriangles,
  facesOfVertices,
  type Offsets,
  setPositions,
} from "./exploded/displaced.ts";
import { type FaceClass, FaceColors } from "./faces.ts";
import { glass, POINT_SIZE, painted, rounded, satin } from "./material.ts";
import { PointHits } from "./picking/pointHits.ts";
import { TriangleHits } from "./picking/triangleHits.ts";

/** How much of a model is shown: all, a see-through surface, or nothing. */
export type Visibility = "solid" | "glass" | "hidden";

const TRIANGLES = { color: 0x101820, wireframe: true, transparent: true, opacity: 0.16 };
/** The opacity of colours that are seen through. */
const SEE_THROUGH = 0.4;
/** The outline of a model in its own colours, and of one whose outline alone shows which it is. */
const OUTLINE = { color: 0x0d151d, opacity: 0.55 };
const OUTLINE_OPACITY = 0.95;

export class ModelMesh {
  readonly group = new Group();
  readonly model: DisplayModel;
  readonly #satin: Material;
  readonly #glass: Material;
  readonly #surface: Mesh | Points;
  readonly #hits: TriangleHits | PointHits;
  readonly #painted: Mesh | Points;
  readonly #triangles: Mesh;
  readonly #outline: LineSegments<BufferGeometry, LineBasicMaterial>;
  readonly #faces: FaceColors;
  readonly #side: Side;
  readonly #color: string;
  #cap: Cap | undefined;
  #hasPaint = false;
  #visibility: Visibility = "solid";
  #fileColors = false;
  #hidden: ReadonlySet<number> = new Set();
  /** The painted triangles with their faces, of which those of hidden faces are not drawn. */
  #paintedTriangles: { indices: Uint32Array; faces: Uint32Array } | undefined;
  /** The ways of faces, where bodies are moved apart, and where all vertices are without them. */
  #offsets: Offsets | undefined;
  #rest: Float32Array | undefined;
  #paintRest: Float32Array | undefined;
  #vertexFaces: Uint32Array | undefined;

  /** `map` is the colour scale of the paint. */
  constructor(model: DisplayModel, side: Side, color: string, map: Texture) {
    this.model = model;
    this.#side = side;
    this.#color = color;
    const { positions, normals, indices } = model.tessellation;
    const isCloud = indices.length === 0;
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(positions, 3));
    geometry.setAttribute("normal", new BufferAttribute(normals, 3));
    if (!isCloud) geometry.setIndex(new BufferAttribute(indices, 1));
    setBounds(geometry, model.bounds);
    const edges = ofSameVertices(geometry, "position");
    edges.setIndex(new BufferAttribute(model.outline.edges, 1));
    const dots = { size: POINT_SIZE, sizeAttenuation: false };
    this.#satin = isCloud ? rounded(new PointsMaterial({ color, ...dots })) : satin(color);
    this.#glass = isCloud
      ? rounded(new PointsMaterial({ color, ...dots, transparent: true, opacity: SEE_THROUGH }))
      : glass(color);
    if (isCloud) {
      this.#surface = new Points(geometry, this.#satin);
      this.#hits = new PointHits(this.#surface, positions);
    } else {
      this.#surface = new Mesh(geometry, this.#satin);
      this.#hits = new TriangleHits(this.#surface, { positions, indices });
    }
    // B lies a little behind A, so that coincident colours do not fight for depth.
    const paint = isCloud
      ? rounded(new PointsMaterial({ map, ...dots, transparent: true }))
      : painted(map, side === "a" ? 1 : 3);
    const unpainted = likePaint(geometry);
    this.#painted = isCloud ? new Points(unpainted, paint) : new Mesh(unpainted, paint);
    this.#outline = new LineSegments(
      edges,
      new LineBasicMaterial({ ...OUTLINE, transparent: true }),
    );
    this.#outline.renderOrder = 3;
    // Three.js derives the lines from the triangles at the first drawing.
    this.#triangles = new Mesh(geometry, new MeshBasicMaterial(TRIANGLES));
    this.#triangles.visible = false;
    this.#triangles.renderOrder = 3;
    this.#painted.visible = false;
    this.#painted.renderOrder = 2;
    this.#faces = new FaceColors(geometry, model.tessellation, side, color);
    // The triangles of a mesh are shaded flat in every material.
    for (const material of this.#materials()) {
      if ("flatShading" in material) material.flatShading = model.isMesh;
    }
    this.group.add(
      ...[this.#surface, this.#painted, this.#faces.mesh],
      ...[this.#outline, this.#triangles],
    );
    this.group.matrixAutoUpdate = false;
  }

  /** Gives the faces of a closed model a cap where they are cut; returns a new one. */
  close(): Cap | undefined {
    if (this.#cap !== undefined) return undefined;
    // All faces, whichever are hidden: what is counted has to close.
    const whole = ofSameVertices(this.#surface.geometry, "position");
    whole.setIndex(new BufferAttribute(this.model.tessellation.indices, 1));
    this.#cap = new Cap(whole, this.#side);
    this.group.add(this.#cap.group);
    return this.#cap;
  }

  /** The face of the cut through the model, which is placed in the scene. */
  get cap(): Cap | undefined {
    return this.#cap;
  }

  set visibility(visibility: Visibility) {
    const transparent = visibility === "glass";
    this.#visibility = visibility;
    this.group.visible = visibility !== "hidden";
    this.#surface.material = transparent ? this.#glass : this.#satin;
    this.#surface.renderOrder = transparent ? 1 : 0;
    const paint = this.#painted.material as Material;
    paint.opacity = transparent ? SEE_THROUGH : 1;
    paint.depthWrite = !transparent;
    // Only what is seen through is drawn back to front: in two passes, with a shader for each.
    paint.forceSinglePass = !transparent;
    // Before what is solid, whose colours it then does not change.
    this.#painted.renderOrder = transparent ? 1 : 2;
  }

  get visibility(): Visibility {
    return this.#visibility;
  }

  /** Whether faces have the colours of their file where it gives them one, and edges that of the model. */
  set fileColors(shown: boolean) {
    const wanted = shown && this.model.faceColors.length > 0;
    if (wanted === this.#fileColors) return;
    this.#fileColors = wanted;
    const { geometry } = this.#surface;
    if (wanted) geometry.setAttribute("color", vertexColors(this.model, this.#color));
    else geometry.deleteAttribute("color");
    for (const material of [this.#satin, this.#glass]) {
      if (!("color" in material && material.color instanceof Color)) continue;
      material.vertexColors = wanted;
      material.color.set(wanted ? "white" : this.#color);
      material.needsUpdate = true;
    }
    const { material } = this.#outline;
    material.color.set(wanted ? this.#color : OUTLINE.color);
    material.opacity = wanted ? OUTLINE_OPACITY : OUTLINE.opacity;
  }

  /** The planes that cut the model open. */
  set clipping(planes: Plane[]) {
    for (const material of this.#materials()) material.clippingPlanes = planes;
    this.#cap?.cut(this.#visibility === "solid" ? planes[0] : undefined);
  }

  /** The mesh that the pointer can hit, in the model's coordinates relative to its origin. */
  get target(): Mesh | Points {
    return this.#surface;
  }

  /** What an export contains: the painted surface if there is paint. */
  get exported(): Mesh | Points {
    return this.#hasPaint ? this.#painted : this.#surface;
  }

  set triangles(visible: boolean) {
    this.#triangles.visible = visible && this.#surface instanceof Mesh;
  }

  /** Shows coloured triangles instead of the surface; without a geometry, the surface. */
  paint(geometry?: BufferGeometry, faces: Uint32Array = new Uint32Array()): void {
    this.#painted.geometry.dispose();
    if (geometry !== undefined) this.#painted.geometry = geometry;
    this.#paintRest = geometry?.getAttribute("position").array as Float32Array | undefined;
    this.#hasPaint = geometry !== undefined;
    const indices = geometry?.getIndex()?.array;
    this.#paintedTriangles =
      indices === undefined ? undefined : { indices: indices as Uint32Array, faces };
    this.#hidePaint();
    this.#displacePaint();
    this.#showSurface();
  }

  /** Moves faces by these ways, in the model's coordinates; without any, all are where they are. */
  explode(offsets: Offsets | undefined): void {
    if (offsets === this.#offsets || this.#hits instanceof PointHits) return;
    this.#offsets = offsets;
    const position = this.#surface.geometry.getAttribute("position") as BufferAttribute;
    const positions = position.array as Float32Array;
    this.#rest ??= positions.slice();
    if (offsets === undefined) positions.set(this.#rest);
    else displace(this.#rest, this.#facesOfVertices, offsets, positions);
    position.needsUpdate = true;
    this.#hits.moved();
    this.#displacePaint();
    forgetAllBounds(this.group);
  }

  #displacePaint(): void {
    const [rest, triangles] = [this.#paintRest, this.#paintedTriangles];
    if (rest === undefined || triangles === undefined) return;
    const { geometry } = this.#painted;
    if (this.#offsets === undefined) {
      if (geometry.getAttribute("position").array !== rest) setPositions(geometry, rest);
      return;
    }
    const positions = new Float32Array(rest.length);
    const faces = facesByTriangles(rest.length / 3, triangles.indices, triangles.faces);
    displace(rest, faces, this.#offsets, positions);
    setPositions(geometry, positions);
  }

  get #facesOfVertices(): Uint32Array {
    const { positions, indices, faces } = this.model.tessellation;
    this.#vertexFaces ??= facesOfVertices(positions.length / 3, indices, faces);
    return this.#vertexFaces;
  }

  /** The face that a ray hit. */
  faceHit(hit: Intersection): number {
    return faceOfTriangle(hit.faceIndex ?? 0, this.model.tessellation.faces);
  }

  /** The way of a face, where bodies are moved apart. */
  offsetOf(face: number): Offsets[number] {
    return this.#offsets?.[face];
  }

  /** Whether a face is drawn. */
  draws(face: number): boolean {
    return this.group.visible && !this.#hidden.has(face);
  }

  /** The box of faces where they are if bodies are not moved apart, in scene coordinates. */
  restBox(faces: readonly number[]): Box3 {
    const { positions, indices, faces: ranges } = this.model.tessellation;
    const rest = this.#rest ?? positions;
    const box = new Box3();
    const point = new Vector3();
    for (const face of faces) {
      const { firstIndex = 0, indexCount = 0 } = ranges[face] ?? {};
      for (let at = firstIndex; at < firstIndex + indexCount; at++) {
        box.expandByPoint(point.fromArray(rest, 3 * (indices[at] ?? 0)));
      }
    }
    return box.applyMatrix4(this.group.matrix);
  }

  /** Colours every face by its class, instead of all paint; without classes, ends that. */
  classify(classes: FaceClass[] | undefined): void {
    this.#faces.show(classes);
    this.#showSurface();
  }

  /** Draws all faces but these. */
  hideFaces(hidden: ReadonlySet<number>): void {
    if (this.#surface instanceof Points) return;
    this.#hidden = hidden;
    this.#faces.hidden = hidden;
    const { tessellation, outline } = this.model;
    const { indices, faces } = tessellation;
    const kept = keep(
      indices,
      hidden,
      (face) => {
        const { firstIndex = 0, indexCount = 0 } = faces[face] ?? {};
        return [firstIndex, firstIndex + indexCount];
      },
      faces.length,
    );
    this.#surface.geometry.setIndex(new BufferAttribute(kept, 1));
    const edges = keep(
      outline.edges,
      hidden,
      (face) => [outline.ends[face - 1] ?? 0, outline.ends[face] ?? 0],
      faces.length,
    );
    this.#outline.geometry.setIndex(new BufferAttribute(edges, 1));
    this.#hidePaint();
  }

  #hidePaint(): void {
    if (this.#paintedTriangles === undefined) return;
    const { indices, faces } = this.#paintedTriangles;
    const kept =
      this.#hidden.size === 0
        ? indices
        : indices.filter((_, at) => !this.#hidden.has(faces[Math.floor(at / 3)] ?? 0));
    this.#painted.geometry.setIndex(new BufferAttribute(kept, 1));
  }

  /** The box of one face, in scene coordinates. */
  faceBox(face: number): Box3 {
    return this.#faces.box(face).applyMatrix4(this.group.matrix);
  }

  #showSurface(): void {
    const plain = !this.#faces.mesh.visible;
    this.#painted.visible = plain && this.#hasPaint;
    this.#surface.visible = plain && !this.#hasPaint;
  }

  dispose(): void {
    this.group.removeFromParent();
    this.#hits.dispose();
    this.#faces.dispose();
    this.#cap?.dispose();
    const parts = [this.#surface, this.#painted, this.#outline, this.#triangles];
    for (const part of parts) part.geometry.dispose();
    for (const material of this.#materials()) material.dispose();
  }

  #materials(): Material[] {
    const { material } = this.#faces.mesh;
    const parts = [this.#painted, this.#outline, this.#triangles];
    return [this.#satin, this.#glass, ...material, ...parts.flatMap((part) => part.material)];
  }
}

/**
 * What is painted before there is a map, and not drawn: with the attributes that a map has, by
 * which three.js chooses the shaders that it compiles ahead.
 */
function likePaint(surface: BufferGeometry): BufferGeometry {
  const geometry = ofSameVertices(surface, "position", "normal");
  geometry.setAttribute("uv", new BufferAttribute(new Float32Array(), 2));
  return geometry;
}

/** The colours of the vertices of all faces; `other` is that of faces without one in their file. */
function vertexColors({ tessellation, faceColors }: DisplayModel, other: string): BufferAttribute {
  const { positions, indices, faces } = tessellation;
  const colors = new Float32Array(positions.length);
  const color = new Color();
  for (const [face, { firstIndex, indexCount }] of faces.entries()) {
    const own = faceColors[face];
    if (own) color.setRGB(...own, SRGBColorSpace);
    else color.set(other);
    for (const vertex of indices.subarray(firstIndex, firstIndex + indexCount)) {
      color.toArray(colors, 3 * vertex);
    }
  }
  return new BufferAttribute(colors, 3);
}

/** The indices of all faces but the hidden ones. */
function keep(
  indices: Uint32Array<ArrayBuffer>,
  hidden: ReadonlySet<number>,
  rangeOf: (face: number) => [from: number, to: number],
  count: number,
): Uint32Array<ArrayBuffer> {
  if (hidden.size === 0) return indices;
  const ranges = Array.from({ length: count }, (_, face) => face)
    .filter((face) => !hidden.has(face))
    .map((face) => indices.subarray(...rangeOf(face)));
  return concatenated(Uint32Array, ranges);
}
