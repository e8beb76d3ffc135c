// The plan of `npm test`.
import assert from "node:assert/strict";
import { test } from "node:test";
import { steps } from "./steps.mjs";

test("each step stands after those that it needs, so that rows never wait for each other", () => {
  const before = new Set();
  for (const { name, needs = [] } of steps) {
    assert.ok(!before.has(name), `two steps ${name}`);
    for (const need of needs) assert.ok(before.has(need), `${need} stands after ${name}`);
    before.add(name);
  }
});
