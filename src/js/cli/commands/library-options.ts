import type { Transform } from "../../measure/options.js";
import type { Invocation } from "../arguments/arguments.js";

/** The arguments that are no options of the library. */
const OWN = new Set([
  ...["a", "b", "json", "format", "include", "reuse", "part", "operator"],
  ...["allow-skipped", "strict-gaps", "translate", "rotate"],
]);

/** The library's options; their names are the arguments' in camel case. */
export function libraryOptions(values: Invocation["values"]): object {
  const camel = (name: string) =>
    name.replace(/-(.)/g, (_, letter: string) => letter.toUpperCase());
  const named = [...values]
    .filter(([name]) => !OWN.has(name))
    .map(([name, value]) => [camel(name), value] as const);
  const moves = ["translate", "rotate"].flatMap((name) => values.get(name) ?? []);
  const transform: Transform = Object.assign({}, ...moves);
  return { ...Object.fromEntries(named), ...(moves.length > 0 ? { transform } : {}) };
}
