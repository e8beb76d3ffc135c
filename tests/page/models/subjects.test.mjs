// What facts are stated of, side by side.
import assert from "node:assert/strict";
import { test } from "node:test";
import { moduleOf } from "../support/module.mjs";

const { subjectsOf } = await moduleOf("facts/pairs.ts");

test("bodies of one name stand side by side, and single ones are the models themselves", () => {
  const model = (...names) => ({
    facts: "whole",
    bodies: names.map((fullName) => ({ fullName, facts: fullName })),
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
