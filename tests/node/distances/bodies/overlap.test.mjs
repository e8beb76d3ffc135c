import assert from "node:assert/strict";
import { test } from "node:test";
import { Hausdorff } from "nurbs-hausdorff";
import { Hausdorff as Worker } from "nurbs-hausdorff/worker";

const holds = ({ lower, upper }, number) =>
  assert.ok(lower <= number && number <= upper, `${number} in ${lower} to ${upper}`);

/** The lens of two balls of radius 2 whose centres are d apart. */
const lens = (d) => (Math.PI * (8 + d) * (4 - d) ** 2) / 12;
const ball = (32 / 3) * Math.PI;

for (const [name, Engine] of [
  ["main", Hausdorff],
  ["worker", Worker],
]) {
  test(`facts and the volumes in common of balls: ${name}`, async (context) => {
    const hd = await Engine.create({ backend: "cpu" });
    context.after(() => hd.dispose());
    const model = await hd.shape("sphere");
    const facts = await model.facts();
    // Weights of arcs are rounded.
    const near = ({ lower, upper }, number) =>
      holds({ lower: lower - 1e-12, upper: upper + 1e-12 }, number);
    near(facts.volume, ball);
    near(facts.extents[2], 4);
    const [body, ...others] = await model.bodies();
    assert.equal(others.length, 0);
    assert.equal(body.kind, "solid");
    near(body.facts.volume, ball);
    const found = await hd.overlap(model, model, {
      tolerance: 1e-2,
      transform: { translation: [1, 0, 0] },
    });
    assert.ok(found.converged);
    holds(found.volumes.intersection, lens(1));
    holds(found.volumes.onlyA, ball - lens(1));
    holds(found.ratio, lens(1) / (2 * ball - lens(1)));
    const [form] = await model.faceForms();
    assert.equal(form.kind, "sphere");
    holds(form.radius, 2);
    const sheet = await hd.shape("wavy-sheet");
    assert.deepEqual(await sheet.faceForms(), [null]);
    assert.equal((await hd.overlap(sheet, model)).volumesUnknown, "a-open");
  });
}
