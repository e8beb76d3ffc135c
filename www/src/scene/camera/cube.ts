// A cube in the corner of the view, seen as the camera sees the models: each side shows a
// standard view when it is pressed. The axes start at its corner.

import { type Camera, Vector3 } from "three";
import { texts } from "../../texts/index.ts";
import { STANDARD_VIEWS, type StandardView } from "./standardViews.ts";

/** Half a side of the cube in the drawing, the length of an axis, and the place of its letter. */
const HALF = 15;
const LENGTH = 22;
const LETTER = 28;
const SVG = "http://www.w3.org/2000/svg";

const SIDES: readonly StandardView[] = ["front", "back", "left", "right", "top", "bottom"];
const AXES = ["x", "y", "z"] as const;

export class ViewCube {
  readonly #sides: { normal: Vector3; corners: Vector3[]; node: SVGElement; text: SVGElement }[];
  readonly #axes: { direction: Vector3; line: SVGElement; letter: SVGElement }[];

  /** Draws into an SVG whose view box is centred on its origin. */
  constructor(drawing: Element, onLook: (view: StandardView) => void) {
    drawing.setAttribute("role", "group");
    this.#sides = SIDES.map((view) => {
      const node = svg("polygon");
      const text = svg("text");
      text.textContent = texts.places.sides[view];
      node.setAttribute("role", "button");
      node.setAttribute("tabindex", "0");
      node.setAttribute("aria-label", texts.places.viewFrom(texts.places.sides[view]));
      node.addEventListener("click", () => onLook(view));
      node.addEventListener("keydown", (event) => {
        if (event.key !== "Enter" && event.key !== " ") return;
        event.preventDefault();
        onLook(view);
      });
      const normal = STANDARD_VIEWS[view].clone();
      return { normal, corners: cornersOf(normal), node, text };
    });
    this.#axes = AXES.map((name, index) => {
      const [line, letter] = [svg("line"), svg("text")];
      letter.textContent = name;
      for (const part of [line, letter]) part.setAttribute("class", `axis-${name}`);
      return { direction: new Vector3().setComponent(index, 1), line, letter };
    });
    drawing.append(
      ...this.#axes.flatMap(({ line, letter }) => [line, letter]),
      ...this.#sides.flatMap(({ node, text }) => [node, text]),
    );
  }

  /** Turns the cube as the camera sees it. */
  update(camera: Camera): void {
    const toCamera = camera.quaternion.clone().invert();
    const seen = (point: Vector3) => point.clone().applyQuaternion(toCamera);
    for (const { normal, corners, node, text } of this.#sides) {
      const { x, y, z } = seen(normal);
      const visible = z > MIN_FACING;
      for (const part of [node, text]) part.toggleAttribute("hidden", !visible);
      node.setAttribute("tabindex", visible ? "0" : "-1");
      node.setAttribute(
        "points",
        corners
          .map((corner) => seen(corner))
          .map((at) => `${at.x},${-at.y}`)
          .join(" "),
      );
      text.setAttribute("x", `${HALF * x}`);
      text.setAttribute("y", `${-HALF * y}`);
    }
    const start = seen(new Vector3(-HALF, -HALF, -HALF));
    for (const { direction, line, letter } of this.#axes) {
      const along = seen(direction);
      const at = (length: number) => start.clone().addScaledVector(along, HALF + length);
      const [end, place] = [at(LENGTH), at(LETTER)];
      line.setAttribute("x1", `${start.x}`);
      line.setAttribute("y1", `${-start.y}`);
      line.setAttribute("x2", `${end.x}`);
      line.setAttribute("y2", `${-end.y}`);
      letter.setAttribute("x", `${place.x}`);
      letter.setAttribute("y", `${-place.y}`);
    }
  }
}

/** How much of a side has to face the camera to be drawn and pressed. */
const MIN_FACING = 0.05;

/** The corners of a cube's side, around its normal. */
function cornersOf(normal: Vector3): Vector3[] {
  const across = new Vector3(normal.y, normal.z, normal.x);
  const up = normal.clone().cross(across);
  return [
    [1, 1],
    [1, -1],
    [-1, -1],
    [-1, 1],
  ].map(([s = 0, t = 0]) =>
    normal.clone().addScaledVector(across, s).addScaledVector(up, t).multiplyScalar(HALF),
  );
}

const svg = (name: string): SVGElement => document.createElementNS(SVG, name);
