// All pairs of bodies, here and in a worker, of boxes whose answers are known.
import assert from "node:assert/strict";
import { test } from "node:test";
import { Hausdorff } from "nurbs-hausdorff";
import { Hausdorff as Worker } from "nurbs-hausdorff/worker";
import { withCode } from "../../support.mjs";

const holds = ({ lower, upper }, number) =>
  assert.ok(lower <= number && number <= upper, `${number} in ${lower} to ${upper}`);

/** The faces of a box, named after it. */
function box(name, low, high) {
  const corner = (index) => [0, 1, 2].map((axis) => ((index >> axis) & 1 ? high : low)[axis]);
  const faces = ["0231", "4576", "0154", "2673", "0462", "1375"];
  return faces.map((corners, face) => {
    const [a, b, c, d] = [...corners].map((index) => [...corner(+index), 1]);
    return {
      degree: [1, 1],
      knots_u: [0, 0, 1, 1],
      knots_v: [0, 0, 1, 1],
      ctrl: [
        [a, d],
        [b, c],
      ],
      part: `${name} / face ${face}`,
    };
  });
}

const assembly = {
  surfaces: [
    ...box("shaft", [0, 0, 0], [1, 1, 1]),
    ...box("hub", [0.5, 0.25, 0.25], [2, 2, 2]),
    ...box("lid", [0, 0, 2], [1, 1, 3]),
  ],
};
const stand = { surfaces: box("stand", [1.25, 0, 0], [2, 1, 1]) };
const shaft = { surfaces: box("shaft", [0, 0, 0], [1, 1, 1]) };

for (const [name, Engine] of [
  ["main", Hausdorff],
  ["worker", Worker],
]) {
  test(`bodies clash, touch and come near: ${name}`, async (context) => {
    const hd = await Engine.create({ backend: "cpu" });
    context.after(() => hd.dispose());
    const model = await hd.model(assembly);
    const fractions = [];
    const onProgress = (fraction) => fractions.push(fraction);
    const found = await hd.check(model, { below: 1.5, onProgress });
    assert.equal(found.clean, false);
    assert.equal(found.pairCount, 3);
    assert.equal(fractions.at(-1), 1);
    const names = found.pairs.map(({ a, b, state }) => `${a} ${b} ${state}`);
    assert.deepEqual(names, ["shaft hub clash", "hub lid touching", "shaft lid near"]);
    const [clash, , near] = found.pairs;
    holds(clash.volume, 0.5 * 0.75 * 0.75);
    holds(clash.depth, 0.5);
    assert.deepEqual(clash.clearance, { lower: 0, upper: 0 });
    assert.ok(clash.point.every((x, axis) => x > [0.5, 0.25, 0.25][axis] && x < 1));
    holds(near.clearance, 1);
    assert.ok(near.volume === null && near.depth === null && near.intended === false);
    const rules = { intended: [{ a: "shaft", b: "hub" }] };
    assert.equal((await hd.check(model, { rules })).clean, true);
  });

  test(`models are checked where they stand: ${name}`, async (context) => {
    const hd = await Engine.create({ backend: "cpu" });
    context.after(() => hd.dispose());
    const models = [await hd.model(shaft), await hd.model(stand)];
    const numbered = (await hd.check(models)).bodies.map((body) => body.name);
    assert.deepEqual(numbered, ["model 1 / shaft", "model 2 / stand"]);
    const rules = (distance) => ({ atLeast: [{ a: "pump/*", b: "**/stand", distance }] });
    const names = ["pump", "foot"];
    assert.equal((await hd.check(models, { names, rules: rules(0.2) })).clean, true);
    const broken = await hd.check(models, { names, rules: rules(0.3) });
    assert.equal(broken.clean, false);
    assert.deepEqual([broken.rules[0].rule, broken.rules[0].broken], ["atLeast", true]);
    holds(broken.rules[0].clearance, 0.25);
    const code = withCode("OPTION_INVALID");
    for (const options of [
      { names: ["one"] },
      { transform: { translation: [1, 0, 0] } },
      { bellow: 1 },
      { rules: { mustTouch: [{ a: "lid", b: "**" }] } },
      { rules: { most: [] } },
      { rules: { intended: [{ a: "**", b: "**", distance: 1 }] } },
      { rules: { atLeast: [{ a: "**", b: "**" }] } },
      { rules: 1 },
    ]) {
      await assert.rejects(hd.check(models, options), code);
    }
    await assert.rejects(hd.check([models[0], {}]), withCode("ARGUMENT_INVALID", /models\[1\]/));
    await assert.rejects(hd.check([]), withCode("EMPTY_MODEL"));
    const signal = AbortSignal.abort();
    await assert.rejects(hd.check(models, { signal }), withCode("CANCELLED"));
  });
}
