// Where the models come from: the lists of pairs and shapes, and files.
import type { ShapeInfo } from "nurbs-hausdorff";
import { onDrop } from "./drop.ts";
import { element } from "./elements.ts";
import { IN_PLACE, presets } from "./presets.ts";
import {
  type Placement,
  type Shown,
  SIDES,
  type Side,
  type Sides,
  type Source,
} from "./protocol.ts";

/** What stands in a list for models that are not in it. */
const OTHER = "";

const pair = element("preset", HTMLSelectElement);
const lists: Record<Side, HTMLSelectElement> = {
  a: element("shape-a", HTMLSelectElement),
  b: element("shape-b", HTMLSelectElement),
};

/** Calls back with the models that the user wants; they are compared where they lie but in presets. */
export function onSource(callback: (sources: Sides<Source>, placement: Placement) => void): void {
  pair.append(
    ...presets.map(({ title }, index) => new Option(title, `${index}`)),
    other("own pair"),
  );
  pair.addEventListener("change", () => {
    const preset = presets[Number(pair.value)];
    if (preset === undefined) return;
    callback({ a: { shape: preset.a }, b: { shape: preset.b } }, preset.placement);
  });
  for (const side of SIDES) {
    lists[side].addEventListener("change", () => {
      callback({ [side]: { shape: lists[side].value } }, IN_PLACE);
    });
    const input = element(`file-${side}`, HTMLInputElement);
    input.addEventListener("change", () => {
      const file = input.files?.[0];
      if (file) callback({ [side]: { file } }, IN_PLACE);
      // The same file, changed meanwhile, may be chosen again.
      input.value = "";
    });
  }
  onDrop((files) => {
    const sources = Object.entries(files).map(([side, file]) => [side, { file }]);
    callback(Object.fromEntries(sources), IN_PLACE);
  });
}

/** Fills the lists of shapes, and asks for the first pair. */
export function offer(shapes: ShapeInfo[]): void {
  for (const list of Object.values(lists)) {
    list.replaceChildren(...shapes.map(({ name, title }) => new Option(title, name)), other(""));
  }
  pair.dispatchEvent(new Event("change"));
}

/** Says that models are on their way, or no longer; large ones take a while. */
export function tellLoading(loading: boolean): void {
  element("loading").hidden = !loading;
}

/** Lets the lists say what is shown. */
export function tellSources(models: Sides<Shown>, placement: Placement): void {
  for (const side of SIDES) {
    const shown = models[side];
    if (shown === undefined) continue;
    const { source, surfaceCount } = shown;
    const list = lists[side];
    list.value = "shape" in source ? source.shape : OTHER;
    if ("file" in source) {
      const option = list.querySelector<HTMLOptionElement>(`option[value="${OTHER}"]`);
      if (option) option.textContent = source.file.name;
    }
    list.title = `${surfaceCount} ${surfaceCount === 1 ? "surface" : "surfaces"}`;
  }
  const index = presets.findIndex(
    (preset) =>
      preset.a === lists.a.value && preset.b === lists.b.value && same(preset.placement, placement),
  );
  pair.value = index < 0 ? OTHER : `${index}`;
}

/** Placements come back from the worker as copies. */
const same = (one: Placement, two: Placement): boolean =>
  `${one.move} ${one.turn}` === `${two.move} ${two.turn}`;

function other(title: string): HTMLOptionElement {
  const option = new Option(title, OTHER);
  option.hidden = true;
  return option;
}
