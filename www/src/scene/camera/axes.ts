// The directions of the axes x, y and z in the corner of the view.
import { type Camera, Vector3 } from "three";

/** The length of an axis in the drawing, and of its letter's place. */
const LENGTH = 24;
const LETTER = 32;

const SVG = "http://www.w3.org/2000/svg";
const NAMES = ["x", "y", "z"] as const;

export class Axes {
  readonly #axes: { direction: Vector3; line: SVGElement; letter: SVGElement }[];

  /** Draws into an SVG whose view box is centred on its origin. */
  constructor(drawing: Element) {
    this.#axes = NAMES.map((name, index) => {
      const line = document.createElementNS(SVG, "line");
      const letter = document.createElementNS(SVG, "text");
      letter.textContent = name;
      for (const part of [line, letter]) part.setAttribute("class", `axis-${name}`);
      drawing.append(line, letter);
      return { direction: new Vector3().setComponent(index, 1), line, letter };
    });
  }

  /** Turns the axes as the camera sees them. */
  update(camera: Camera): void {
    const toCamera = camera.quaternion.clone().invert();
    for (const { direction, line, letter } of this.#axes) {
      const { x, y } = direction.clone().applyQuaternion(toCamera);
      line.setAttribute("x2", `${LENGTH * x}`);
      line.setAttribute("y2", `${-LENGTH * y}`);
      letter.setAttribute("x", `${LETTER * x}`);
      letter.setAttribute("y", `${-LETTER * y}`);
    }
  }
}
