// The names that the page finds bodies by are those of the parts of a comparison.
import assert from "node:assert/strict";
import { test } from "node:test";
import { moduleOf } from "../support/module.mjs";

const { bodyNames } = await moduleOf("worker/bodyNames.ts");
const { subjectsOf } = await moduleOf("facts/pairs.ts");

const named = (...paths) => paths.map((path) => ({ path }));

test("a body has the names of its levels, else its number, and equal names are numbered", () => {
  assert.deepEqual(bodyNames(named(["pump", "bolt"], [], ["pump", "bolt"], ["pump", "bolt"])), [
    "pump / bolt",
    "body 2",
    "pump / bolt (2)",
    "pump / bolt (3)",
  ]);
});

test("a word of slashes in the name of a level has one more", () => {
  assert.deepEqual(bodyNames(named(["in / out", "a//b", "//"])), ["in // out / a//b / ///"]);
});

test("a name that a copy would have is kept by the body that has it", () => {
  assert.deepEqual(bodyNames(named(["bolt (2)"], ["bolt"], ["bolt"])), [
    "bolt (2)",
    "bolt",
    "bolt (3)",
  ]);
});

test("bodies of one name stand side by side, and single ones are the models themselves", () => {
  const model = (...names) => ({
    facts: "whole",
    bodies: names.map((name) => ({ path: [name], facts: name })),
  });
  const subjects = subjectsOf({ a: model("base", "pin"), b: model("pin", "cap") });
  assert.deepEqual(
    subjects.map(({ title, facts }) => [title, facts]),
    [
      ["whole models", { a: "whole", b: "whole" }],
      ["base", { a: "base" }],
      ["pin", { a: "pin", b: "pin" }],
      ["cap", { b: "cap" }],
    ],
  );
  assert.equal(subjectsOf({ a: model("base"), b: model("other") }).length, 1);
});
