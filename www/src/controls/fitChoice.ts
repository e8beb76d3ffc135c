// What counts in the best fit: a share of A's samples, those near to B, and those nearest to chosen faces of B.
import { element } from "../common/elements.ts";
import type { PlainFitOptions } from "../worker/protocol.ts";

const choice = element("fit-choice", HTMLDetailsElement);
const outliers = element("fit-outliers", HTMLInputElement);
const distance = element("fit-distance", HTMLInputElement);
const faces = element("fit-faces", HTMLInputElement);

/** The options of a fit that say what counts; undefined where a field has no such value, which is said there. */
export function fitChoice():
  | Pick<PlainFitOptions, "outliers" | "maxDistance" | "facesOfB">
  | undefined {
  const fields = [outliers, distance, faces];
  // Browsers say nothing of a field that is folded away.
  if (fields.some((field) => !field.checkValidity())) choice.open = true;
  if (!fields.every((field) => field.reportValidity())) return undefined;
  return {
    ...(outliers.value !== "" && { outliers: outliers.valueAsNumber / 100 }),
    ...(distance.value !== "" && { maxDistance: distance.valueAsNumber }),
    ...(faces.value.trim() !== "" && { facesOfB: indicesOf(faces.value) }),
  };
}

/** The indices of a list such as 3, 7-9, which the field's pattern accepts. */
function indicesOf(list: string): number[] {
  return list.split(",").flatMap((range) => {
    const ends = range.split("-").map(Number);
    const [first, last] = [Math.min(...ends), Math.max(...ends)];
    return Array.from({ length: last - first + 1 }, (_, index) => first + index);
  });
}
