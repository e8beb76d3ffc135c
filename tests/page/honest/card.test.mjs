// What the card says first, and what happened to faces: no more than the numbers prove.
import assert from "node:assert/strict";
import { test } from "node:test";
import { moduleOf } from "../support/module.mjs";

const { comparedText } = await moduleOf("results/headline.ts");
const { kindsOf } = await moduleOf("faces/kinds.ts");

const both = (limit) => ({ above: limit, below: limit });

test("what is allowed stands beside the distance in the same digits, and is never rounded", () => {
  assert.equal(comparedText("0.350", both(0.2), "fail"), "> 0.200 allowed");
  assert.equal(comparedText("0.350", both(0.4), "pass"), "≤ 0.400 allowed");
  assert.equal(comparedText("0.35", both(0.2125), "fail"), "> 0.2125 allowed");
  assert.equal(comparedText("0", both(0.2), "pass"), "≤ 0.2 allowed");
  assert.equal(comparedText("≤ 1.1e-11", both(0.2), "pass"), "≤ 0.2 allowed");
});

test("no relation is said that the verdict does not prove", () => {
  assert.equal(comparedText("0.200", both(0.2), "undecided"), ", 0.200 allowed");
  // A face with less of its own fails, and the whole's limit does not say so.
  assert.equal(comparedText("0.350", both(0.4), "fail"), ", 0.400 allowed");
  assert.equal(
    comparedText("0.350", { above: 0.4, below: 0.1 }, "fail"),
    ", +0.400/−0.100 allowed",
  );
});

/** The faces of a model with these names and states. */
const faces = (side, ...all) =>
  all.map(([faceName, state], face) => ({
    ...{ face, state, lower: 0, upper: 0 },
    witness: { a: {}, b: {}, [side]: { face, faceName } },
  }));

test("a face is extended where nothing of the other one is gone, and shortened the other way", () => {
  const result = {
    facesOfA: faces("a", ["side", "unchanged"], ["end", "changed"], ["top", "changed"]),
    facesOfB: faces("b", ["side", "changed"], ["end", "changed"], ["top", "unchanged"]),
  };
  assert.deepEqual(kindsOf(result, "a"), ["unchanged", "changed", "shortened"]);
  assert.deepEqual(kindsOf(result, "b"), ["extended", "changed", "unchanged"]);
});

test("a face that is undecided in the other model proves nothing", () => {
  const result = {
    facesOfA: faces("a", ["side", "undecided"]),
    facesOfB: faces("b", ["side", "changed"]),
  };
  assert.deepEqual(kindsOf(result, "a"), ["undecided"]);
  assert.deepEqual(kindsOf(result, "b"), ["changed"]);
});

test("faces are added or removed by names that the files give, each of one face", () => {
  const result = {
    facesOfA: faces("a", ["rib", "changed"], ["face 3", "changed"], ["bore", "unchanged"]),
    facesOfB: faces("b", ["boss", "changed"], ["bore", "changed"], ["bore", "changed"]),
  };
  assert.deepEqual(kindsOf(result, "a"), ["removed", "changed", "unchanged"]);
  assert.deepEqual(kindsOf(result, "b"), ["added", "changed", "changed"]);
  // A file without names does not say that all of the other are new.
  const nameless = { ...result, facesOfA: faces("a", ["face 0", "unchanged"]) };
  assert.deepEqual(kindsOf(nameless, "b"), ["changed", "changed", "changed"]);
});

test("faces that only have numbers in a part of another name are not said to be new", () => {
  const result = {
    facesOfA: faces("a", ["plate 1 / face 0", "changed"], ["plate 1 / face 1", "unchanged"]),
    facesOfB: faces("b", ["plate 2 / face 0", "changed"], ["cover / face 1", "changed"]),
  };
  assert.deepEqual(kindsOf(result, "a"), ["changed", "unchanged"]);
  const parts = [{ state: "added", facesOf: { a: [], b: [1] } }];
  assert.deepEqual(kindsOf(result, "b", parts), ["changed", "added"]);
});

test("a round face is resized where its radius is another one, and moved where only its axis is", () => {
  const [resized, moved, both] = ["resized", "moved", "resizedAndMoved"].map((change) => ({
    counterpart: { face: 0, change },
  }));
  const all = faces("a", ["one", "changed"], ["two", "changed"], ["three", "changed"]);
  const result = {
    facesOfA: all.map((face, index) => ({ ...face, ...[resized, moved, both][index] })),
    facesOfB: faces("b"),
  };
  assert.deepEqual(kindsOf(result, "a"), ["resized", "moved", "resized"]);
});

test("faces of a part that is proven to be moved are moved, and of no other part", () => {
  const result = {
    facesOfA: faces("a", ["side", "changed"], ["top", "changed"], ["rib", "unchanged"]),
    facesOfB: faces("b", ["side", "changed"], ["top", "changed"], ["rib", "changed"]),
  };
  const part = (state, a, b) => ({ state, facesOf: { a, b } });
  const parts = [part("moved", [0, 2], [0]), part("movedAndChanged", [1], [1, 2])];
  // A face that is within the limit all the same, as one that slides on itself, is unchanged.
  assert.deepEqual(kindsOf(result, "a", parts), ["moved", "changed", "unchanged"]);
  assert.deepEqual(kindsOf(result, "b", parts), ["moved", "changed", "extended"]);
});
