// The worst places of the maps shown: their list, the view of one, and the faces that are beyond.
import type { FaceTree } from "../faces/faceTree.ts";
import { allowed } from "../results/verdict.ts";
import type { View } from "../scene/view.ts";
import type { Side } from "../worker/protocol.ts";
import { painted } from "./deviationPanel.ts";
import type { Probing } from "./pins/probing.ts";
import { isBeyond, PlaceList, sizeText } from "./placeList.ts";
import { type Place, placesOf } from "./places.ts";

export class PlaceView {
  readonly #view: View;
  readonly #probing: Probing;
  readonly #tree: FaceTree;
  readonly #list: PlaceList;

  constructor(view: View, probing: Probing, tree: FaceTree) {
    this.#view = view;
    this.#probing = probing;
    this.#tree = tree;
    this.#list = new PlaceList((place) => this.#look(place));
  }

  /** The worst place of each face of the maps, the largest first. */
  get all(): Place[] {
    return placesOf(painted()?.maps ?? {}, this.#view.models.drawn);
  }

  /** Shows the list for what is allowed now. */
  show(): void {
    const { all } = this;
    const limits = allowed();
    this.#list.show(all, limits, this.#view.models.diagonal);
    const changed = (side: Side) =>
      new Set(
        all
          .filter((place) => place.side === side && limits && isBeyond(place, limits))
          .map(({ face }) => face),
      );
    this.#tree.changed = { a: changed("a"), b: changed("b") };
  }

  /** Looks at a place, with the arrow to its foot. */
  #look(place: Place): void {
    const { models } = this.#view;
    const shown = painted();
    const map = shown?.maps[place.side];
    const origin = models.drawn[place.side]?.tessellation.origin;
    if (shown === undefined || map === undefined || origin === undefined) return;
    const at = (all: Float32Array, axis: 0 | 1 | 2) => all[3 * place.vertex + axis] ?? 0;
    const near = ([0, 1, 2] as const).map((axis) => at(map.positions, axis) + origin[axis]);
    const [x = 0, y = 0, z = 0] = near;
    const [u, v, w] = ([0, 1, 2] as const).map((axis) => at(map.normals, axis));
    this.#probing.ask(place.side, [x, y, z], ({ point, foot, face, footFace }) => {
      const other = place.side === "a" ? "B" : "A";
      const texts = {
        length: sizeText(place, shown.result.diagonal),
        from: `${place.side.toUpperCase()}: ${face}`,
        to: `${other}: ${footFace}`,
      };
      this.#view.approach(point, foot, texts, models.turn(place.side, [u ?? 0, v ?? 0, w ?? 0]));
    });
  }
}
