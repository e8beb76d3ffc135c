// The unit beside each model: what its file states, or what the user says of one that states none.

import { batch, computed, effect, signal } from "@preact/signals-core";
import { element } from "../common/elements.ts";
import { setShownFactor } from "../common/text/numbers.ts";
import { unitName } from "../common/text/units.ts";
import { field, onChange } from "../state/store.ts";
import { texts } from "../texts/index.ts";
import { type DisplayModel, SIDES, type Side, type Sides } from "../worker/protocol.ts";

/** Lengths that files are often in, in metres. */
const COMMON: readonly number[] = [1e-6, 1e-3, 1e-2, 0.0254, 0.3048, 1];
/** Factors between units that are confused, with their names. */
const CONFUSED: readonly (readonly [factor: number, names: string])[] = [
  [25.4, texts.files.inchesAndMillimetres],
  [10, texts.files.centimetresAndMillimetres],
  [1000, texts.files.metresAndMillimetres],
];
/** The part by which the sizes of models may differ from such a factor: one is a revision of the other. */
const LIKE = 0.05;

const selects: Record<Side, HTMLSelectElement> = {
  a: element("unit-a", HTMLSelectElement),
  b: element("unit-b", HTMLSelectElement),
};
const note = element("units-differ");
const shown = field("shown-unit");
/** Metres per unit of each model, null where that is unknown, and the diagonals of their boxes. */
const units = signal<Sides<number | null>>({});
const sizes = signal<Sides<number>>({});
/** The metres of A's unit where those of both are known. */
const known = computed((): number | undefined => {
  const { a = null, b = null } = units.value;
  return a === null || b === null ? undefined : a;
});

for (const select of Object.values(selects)) {
  select.append(
    new Option(texts.files.whichUnit, ""),
    ...COMMON.map((metres) => new Option(unitName(metres), `${metres}`)),
  );
}

// Lengths are shown in the unit that the user wants, where that of the models is known.
effect(() => {
  const metres = known.value;
  setShownFactor(metres !== undefined && shown.value !== "" ? metres / Number(shown.value) : 1);
  element("shown-offer").hidden = metres === undefined;
  const fields = texts.files.inUnit(modelUnit() ?? texts.files.modelUnits);
  for (const id of ["position-unit", "limit-unit"]) element(id).textContent = fields;
});

effect(() => {
  const text = textOf(units.value, sizes.value);
  note.hidden = text === "";
  note.textContent = text;
});

/** Calls back when the user wants lengths in another unit. */
export const onShownUnit = (callback: () => void): void => onChange(() => shown.value, callback);

/** Shows the units of models that were loaded. */
export function showUnits(models: Sides<DisplayModel>): void {
  batch(() => {
    for (const side of SIDES) {
      const model = models[side];
      if (model === undefined) continue;
      const { unit, box } = model;
      const size = Math.hypot(...box.max.map((end, axis) => end - (box.min[axis] ?? 0)));
      units.value = { ...units.value, [side]: unit };
      sizes.value = { ...sizes.value, [side]: size };
    }
  });
  for (const side of SIDES) {
    const model = models[side];
    if (model === undefined) continue;
    const { unit, source } = model;
    const said = "file" in source ? source.unit : undefined;
    const isOpen = "file" in source && (unit === null || said !== undefined);
    const [none] = selects[side].options;
    if (none) none.textContent = isOpen || unit === null ? texts.files.whichUnit : unitName(unit);
    selects[side].disabled = !isOpen;
    selects[side].title = isOpen ? texts.files.theFileStatesNoUnit : texts.files.asTheModelStatesIt;
    selects[side].value = said === undefined ? "" : `${said}`;
  }
}

/** What the user has to know of the units of A and B; nothing where they are the same. */
function textOf({ a = null, b = null }: Sides<number | null>, sizes: Sides<number>): string {
  if (a !== null && b !== null) {
    if (unitName(a) === unitName(b)) return "";
    return texts.files.bIsConverted(unitName(a), unitName(b));
  }
  const hint = hintOf((sizes.a ?? 0) / (sizes.b || 1));
  if (a === null && b === null) return hint;
  const [known, unknown] = a === null ? ["B", "A"] : ["A", "B"];
  return texts.files.oneUnitUnknown(
    known,
    unitName(a ?? b ?? 1),
    unknown,
    hint === "" ? "" : ` ${hint}`,
  );
}

/** What a factor between the sizes of models suggests. */
function hintOf(factor: number): string {
  const found = CONFUSED.find(([one]) =>
    [factor, 1 / factor].some((size) => Math.abs(size / one - 1) < LIKE),
  );
  if (found === undefined) return "";
  return texts.files.timesAsLarge(found[0], found[1]);
}

/** Calls back with the metres in a unit that the user says a file is in; with `undefined`, none. */
export function onUnit(callback: (side: Side, metres: number | undefined) => void): void {
  for (const side of SIDES) {
    selects[side].addEventListener("input", () => {
      const { value } = selects[side];
      callback(side, value === "" ? undefined : Number(value));
    });
  }
}

/** Returns A's units in one of B's: B is converted where both are known. */
export function unitScale(): number {
  const { a = null, b = null } = units.value;
  return a !== null && b !== null ? b / a : 1;
}

/** Returns the metres in a unit of the scene, 1 where none is stated. */
export const metresPerUnit = (): number => units.value.a ?? units.value.b ?? 1;

/** Returns the unit in which lengths are shown, or undefined where that of a model is unknown. */
export function commonUnit(): string | undefined {
  const own = modelUnit();
  return own === undefined || shown.value === "" ? own : unitName(Number(shown.value));
}

/** Returns the unit of what is typed, A's, or undefined where it is unknown of one of the models. */
export function modelUnit(): string | undefined {
  const metres = known.value;
  return metres === undefined ? undefined : unitName(metres);
}
