// The worst places of the maps shown: their list, the view of one, and the faces that are beyond.
import { AGREEING, judgedOf } from "../../common/direction.ts";
import { element } from "../../common/elements.ts";
import { paint } from "../../controls/options.ts";
import type { FaceTree } from "../../faces/faceTree.ts";
import { addMeasured, allowed, allowedOf } from "../../results/verdict.ts";
import type { View } from "../../scene/view.ts";
import { texts } from "../../texts/index.ts";
import type { Side } from "../../worker/protocol.ts";
import { painted } from "../deviationPanel.ts";
import type { Probing } from "../pins/probing.ts";
import { outwardNormal } from "./outwards.ts";
import { PlaceList, type PlaceState, sizeText, stateOf } from "./placeList.ts";
import { type Place, placesOf } from "./places.ts";

/** Digits by which places are ranked: what differs by less is equally far. */
const RANKED_DIGITS = 6;

const ranked = ({ distance }: Place): number => Number(distance.toPrecision(RANKED_DIGITS));

const empty = element("no-places");

export class PlaceView {
  readonly #view: View;
  readonly #probing: Probing;
  readonly #tree: FaceTree;
  readonly #list: PlaceList;
  readonly #isPaused: () => boolean;

  /** `isPaused` says whether something else is measured instead of the deviation. */
  constructor(view: View, probing: Probing, tree: FaceTree, isPaused: () => boolean) {
    this.#view = view;
    this.#isPaused = isPaused;
    this.#probing = probing;
    this.#tree = tree;
    this.#list = new PlaceList((place) => this.#look(place));
  }

  /** The worst place of each face of the models that the distance judges, the largest first. */
  get all(): Place[] {
    const shown = painted();
    if (shown === undefined) return [];
    // One way, faces of B that are far from A would contradict the verdict.
    const maps = judgedOf(shown.result, shown.maps);
    return placesOf(maps, this.#view.models.drawn, shown.bounds).sort(
      (one, two) => ranked(two) - ranked(one),
    );
  }

  /** Shows the list for what is allowed now. */
  show(): void {
    const { all } = this;
    empty.textContent = this.#whyNone;
    const isAllowed = allowed() !== undefined;
    const state = (place: Place): PlaceState => {
      const limits = allowedOf(place.side, place.face);
      return limits === undefined ? "within" : stateOf(place, limits);
    };
    const beyond = (place: Place) => state(place) === "beyond";
    this.#list.show(all, this.#view.models.diagonal, isAllowed ? state : undefined);
    this.#judge(all);
    const changed = (side: Side) =>
      new Set(all.filter((place) => place.side === side && beyond(place)).map(({ face }) => face));
    const { diagonal } = this.#view.models;
    const sizes = (side: Side) =>
      new Map(
        all
          .filter((place) => place.side === side && place.distance > AGREEING * diagonal)
          .map((place) => [place.face, sizeText(place, diagonal)]),
      );
    this.#tree.mark({ a: changed("a"), b: changed("b") }, { a: sizes("a"), b: sizes("b") });
  }

  /** What to do where no place is listed. */
  get #whyNone(): string {
    if (!this.#view.models.complete) return texts.places.openTwoFiles;
    if (this.#isPaused()) return texts.places.clearanceIsMeasuredInstead;
    return paint.value.length === 0 ? texts.places.turnOnTheColours : texts.places.beingMeasured;
  }

  /** Adds the faces that the distance is about to the verdict. */
  #judge(all: readonly Place[]): void {
    const result = painted()?.result;
    if (result === undefined) return;
    const isDirected = result.forward === undefined;
    addMeasured(
      all
        .filter(({ side }) => !isDirected || side === "a")
        .flatMap((face) => {
          const limits = allowedOf(face.side, face.face);
          const name = `${face.side.toUpperCase()} ${face.name}`;
          return limits === undefined ? [] : [{ name, face: face.sure, allowed: limits }];
        }),
    );
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
    const normal = outwardNormal(models, map, place);
    this.#probing.ask(place.side, [x, y, z], ({ point, foot, face, footFace }) => {
      const other = place.side === "a" ? "B" : "A";
      const said = {
        length: sizeText(place, shown.result.diagonal),
        from: `${place.side.toUpperCase()}: ${face}`,
        to: `${other}: ${footFace}`,
      };
      this.#view.approach(point, foot, said, normal);
    });
  }
}
