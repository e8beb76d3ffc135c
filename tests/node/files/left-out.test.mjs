// Damaged STEP and IGES files by the command: each face that is lost has its number in the
// file and a reason, and a file that is not whole is refused.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { buildCommand, command } from "../../../scripts/build/command.mjs";
import { environment } from "../../../scripts/process.mjs";
import { missing, sharedFile } from "./files.mjs";

const folder = mkdtempSync(join(tmpdir(), "nurbs-hausdorff-"));
after(() => rmSync(folder, { recursive: true }));
before(buildCommand);

const textOf = (path) => Buffer.from(sharedFile(path)).toString("latin1");

/** What the command says of a file: its status, and what is left out or the error's code. */
function left(name, text) {
  const file = join(folder, name);
  writeFileSync(file, text, "latin1");
  const options = { encoding: "utf8", env: environment() };
  const { status, stdout, stderr } = spawnSync(command, ["info", "--json", file], options);
  const { faces, skipped } = status === 0 ? JSON.parse(stdout) : {};
  return { status, faces: faces?.length, skipped, error: stderr.match(/error\[(\w+)\]/)?.[1] };
}

/** The statement of the only instance of a number. */
const statement = (number) => new RegExp(`(?<=\\n)#${number}\\s*=[^;]*;`);

/** The parts of `screw.step` that the damages change: its third face, that one's surface and a loop. */
function parts(step) {
  const [, face] = [...step.matchAll(/#(\d+)\s*=\s*ADVANCED_FACE/g)][2];
  const [entity] = step.match(statement(face));
  const [, bound, surface] = entity.match(/\(#(\d+)[^)]*\),\s*#(\d+),/s);
  return { face: Number(face), bound, surface };
}

test("a face that a damaged STEP file loses is named", { skip: missing }, () => {
  const step = textOf("step/screw.step");
  const { face, bound, surface } = parts(step);
  const without = (number) => step.replace(statement(number), "");
  const instead = (number, text) => step.replace(statement(number), `#${number}=${text};`);
  const twice = (number) => step.replace(statement(number), (found) => `${found}\n${found}`);
  const damaged = {
    "without the face": [without(face), "STEP_REFERENCE"],
    "without its surface": [without(surface), "STEP_REFERENCE"],
    "without its bound": [without(bound), "STEP_REFERENCE"],
    "a surface of no known kind": [instead(surface, "FREE_FORM_SURFACE('',$)"), "STEP_ENTITY"],
    "a bound of no known kind": [instead(bound, "FACE_LIMIT('',$,.T.)"), "STEP_ENTITY"],
    "a surface without placement": [instead(surface, "PLANE('',$)"), "STEP_ATTRIBUTE"],
    "the face twice": [twice(face), "STEP_REFERENCE"],
    "its surface twice": [twice(surface), "STEP_REFERENCE"],
  };
  for (const [name, [text, code]] of Object.entries(damaged)) {
    assert.notEqual(text, step, name);
    const { status, faces, skipped } = left(`${name}.step`, text);
    assert.deepEqual({ status, faces }, { status: 0, faces: 9 }, name);
    const found = skipped.map(({ face, entity, code }) => ({ face, entity, code }));
    assert.deepEqual(found, [{ face: 2, entity: face, code }], name);
  }
});

// In Node such a file goes to OpenCASCADE where that is at hand.
test("a STEP or IGES file that is not whole is refused", { skip: missing }, () => {
  const [step, iges] = [textOf("step/screw.step"), textOf("iges/bearing.iges")];
  const lines = iges.split("\n");
  const middle = lines.length >> 1;
  const damaged = {
    "cut.step": [step.slice(0, step.length >> 1), "STEP_SYNTAX"],
    "without-its-end.step": [step.slice(0, step.lastIndexOf("ENDSEC")), "STEP_SYNTAX"],
    "cut.iges": [iges.slice(0, iges.length >> 1), "IGES_SYNTAX"],
    "without-a-line.iges": [lines.toSpliced(middle, 1).join("\n"), "IGES_SYNTAX"],
    "a-line-twice.iges": [lines.toSpliced(middle, 0, lines[middle]).join("\n"), "IGES_SYNTAX"],
  };
  for (const [name, [text, code]] of Object.entries(damaged)) {
    const { status, error } = left(name, text);
    assert.deepEqual({ status, error }, { status: 2, error: code }, name);
  }
});

test("a face that a damaged IGES file loses is named", { skip: missing }, () => {
  const iges = textOf("iges/hammer.iges");
  const directory = iges.split("\n").filter((line) => line[72] === "D");
  // The last trimmed surface, 144; the number of an entity is that of its first line.
  const entity = directory.findLastIndex((_, index) => {
    const line = directory[index];
    return index % 2 === 0 && line.startsWith("     144");
  });
  const face = Number(directory[entity].slice(73));
  const [first, second] = directory.slice(entity, entity + 2);
  const [, surface] = iges.match(new RegExp(`(?<=\\n)144,(\\d+),[^\\n]*\\s0*${face}P`));
  const damaged = {
    // Another type in both lines of the directory and in the parameters.
    // Nothing says that it was a face: its surface is what is named.
    "of-no-known-type.iges": [
      iges
        .replace(first, first.replace("     144", "     147"))
        .replace(second, second.replace("     144", "     147"))
        .replace(new RegExp(`(?<=\\n)144(?=,[^\\n]*\\s*0*${face}P)`), "147"),
      Number(surface),
      "IGES_LOOSE",
    ],
    // A surface that the directory does not have.
    "without-its-surface.iges": [
      iges.replace(new RegExp(`(?<=\\n144,)(\\d+)(?=,[^\\n]*\\s0*${face}P)`), (digits) =>
        "9".repeat(digits.length),
      ),
      face,
      "IGES_REFERENCE",
    ],
  };
  const whole = left("whole.iges", iges);
  for (const [name, [text, number, code]] of Object.entries(damaged)) {
    assert.notEqual(text, iges, name);
    const { status, faces, skipped } = left(name, text);
    assert.deepEqual({ status, faces }, { status: 0, faces: whole.faces - 1 }, name);
    const found = skipped.map(({ entity, code }) => ({ entity, code }));
    assert.deepEqual(
      found.find(({ entity }) => entity === number),
      { entity: number, code },
      name,
    );
  }
});
