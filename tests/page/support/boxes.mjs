// Assemblies of boxes, whose volumes, areas and distances are known.
import { modelFile } from "./models.mjs";

/** The faces of a box with these corners, each face called by the box's name and its number; without `lid`, the top. */
export function box(name, low, high, { lid = true } = {}) {
  const faces = [0, 1, 2].flatMap((axis) =>
    [low, high].map((end, isHigh) => {
      const [u, v] = [(axis + 1) % 3, (axis + 2) % 3];
      const at = (first, second) => {
        const point = [0, 0, 0];
        point[axis] = end[axis];
        point[u] = first[u];
        point[v] = second[v];
        return [...point, 1];
      };
      // Normals point outwards.
      const ctrl = [low, high].map((first) => [low, high].map((second) => at(first, second)));
      return {
        ...{ degree: [1, 1], knots_u: [0, 0, 1, 1], knots_v: [0, 0, 1, 1] },
        ctrl: isHigh === 1 ? ctrl : ctrl.reverse(),
        part: `${name} / face ${2 * axis + isHigh}`,
      };
    }),
  );
  return lid ? faces : faces.slice(0, -1);
}

const MM = 1e-3;

/** A file in millimetres of boxes. */
export const model = (name, ...boxes) => modelFile(name, { unit: MM, surfaces: boxes.flat() });
