// The face of a cut through a closed model: counted in the stencil buffer, drawn as a plane.
//
// It is where the number of faces in front is odd, which is what inside means for signs and sides too:
// faces may be oriented either way.
import {
  AlwaysStencilFunc,
  type BufferGeometry,
  Color,
  DoubleSide,
  Group,
  InvertStencilOp,
  Mesh,
  MeshBasicMaterial,
  NotEqualStencilFunc,
  type Plane,
  PlaneGeometry,
  ReplaceStencilOp,
  Vector3,
} from "three";
import type { Side } from "../worker/protocol.ts";

/** The order in which caps are drawn: after opaque surfaces, one model after the other. */
const ORDERS = { a: 0.1, b: 0.3 } as const;
/** The colours of a cut: none of those that stand for deviations. */
const GROUND = "#cdd3d9";
const LINE = "#5c656e";
/** Pixels from one line of the hatching to the next, and the part of that which is line. */
const SPACING = 9;
const LINE_PART = 0.16;
/** The slant of the hatching, which tells the models apart. */
const SLANTS: Readonly<Record<Side, "+" | "-">> = { a: "+", b: "-" };

export class Cap {
  /** What is counted: moves with the model. */
  readonly group = new Group();
  /** The plane, which is placed in the scene. */
  readonly plane: Mesh;
  readonly #counted: MeshBasicMaterial;

  constructor(geometry: BufferGeometry, side: Side) {
    const order = ORDERS[side];
    this.#counted = new MeshBasicMaterial({
      ...{ side: DoubleSide, colorWrite: false, depthWrite: false, depthTest: false },
      ...{ stencilWrite: true, stencilFunc: AlwaysStencilFunc, stencilZPass: InvertStencilOp },
    });
    const counted = new Mesh(geometry, this.#counted);
    counted.renderOrder = order;
    this.group.add(counted);
    const material = new MeshBasicMaterial({
      ...{ color: GROUND, side: DoubleSide, toneMapped: false },
      ...{ stencilWrite: true, stencilRef: 0, stencilFunc: NotEqualStencilFunc },
      ...{
        stencilFail: ReplaceStencilOp,
        stencilZFail: ReplaceStencilOp,
        stencilZPass: ReplaceStencilOp,
      },
    });
    hatch(material, SLANTS[side]);
    this.plane = new Mesh(new PlaneGeometry(1, 1), material);
    this.plane.renderOrder = order + 0.1;
    this.plane.onAfterRender = (renderer) => renderer.clearStencil();
    this.cut(undefined);
  }

  /** Shows the cut at a plane of the scene; without one, none. */
  cut(plane: Plane | undefined): void {
    this.group.visible = plane !== undefined;
    this.plane.visible = plane !== undefined;
    if (plane === undefined) return;
    this.#counted.clippingPlanes = [plane];
    plane.coplanarPoint(this.plane.position);
    this.plane.lookAt(this.plane.position.clone().sub(plane.normal));
  }

  /** Makes the plane as large as the models. */
  set size(size: number) {
    this.plane.scale.copy(new Vector3(size, size, 1));
  }

  dispose(): void {
    this.plane.removeFromParent();
    this.plane.geometry.dispose();
    (this.plane.material as MeshBasicMaterial).dispose();
    this.#counted.dispose();
  }
}

/** Draws lines over a material, as drawings have them over what is cut. */
function hatch(material: MeshBasicMaterial, slant: "+" | "-"): void {
  const { r, g, b } = new Color(LINE);
  material.onBeforeCompile = (shader) => {
    shader.fragmentShader = shader.fragmentShader.replace(
      "#include <opaque_fragment>",
      `float across = fract((gl_FragCoord.x ${slant} gl_FragCoord.y) / ${SPACING.toFixed(1)});
      if (across < ${LINE_PART.toFixed(3)}) outgoingLight = vec3(${[r, g, b].map((part) => part.toFixed(4)).join(", ")});
      #include <opaque_fragment>`,
    );
  };
  // Materials that differ only by what they hatch have shaders of their own.
  material.customProgramCacheKey = () => `hatch ${slant}`;
}
