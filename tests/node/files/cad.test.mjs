// `nurbs-hausdorff/cad` on real files and on files made here.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { cpSync, mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, test } from "node:test";
import { fileURLToPath } from "node:url";
import { gzipSync } from "node:zlib";
import startOcct from "@bitbybit-dev/occt/bitbybit-dev-occt/node.js";
import { fromOcct } from "nurbs-hausdorff/adapters";
import { convertCad, readCad } from "nurbs-hausdorff/cad";
import startRhino from "rhino3dm";
import { brepTopology } from "../../../dist/cad/rhino/brep.js";
import { ChunkReader } from "../../../dist/cad/rhino/chunks.js";
import { stepSquares } from "../../page/support/models.mjs";
import { create, interchangeSquare, near, withCode } from "../support.mjs";
import { bytesOf, missing, sharedFile, sharedGzip, zip } from "./files.mjs";

test("a file is read without an engine", async () => {
  const model = await readCad(bytesOf(JSON.stringify(interchangeSquare())));
  assert.equal(model.faceCount, 1);
});

let hd;
const loaded = async () => {
  hd ??= await create({ backend: "cpu" });
  return hd;
};
after(() => hd?.dispose());

test("faces are told as they are read, by their edges, and as they are cut, by triangles", async () => {
  const told = [];
  const onFace = (face) => told.push(face);
  const model = await readCad(bytesOf(stepSquares(3)), { onFace });
  assert.equal(model.faceCount, 3);
  assert.equal(told.length, 6);
  const [read, cut] = [told.slice(0, 3), told.slice(3)];
  for (const [index, { edges, triangles }] of read.entries()) {
    assert.equal(triangles, undefined);
    // Four sides of two ends; the square's corner is 2 further along y each.
    assert.equal(edges.length, 4 * 2 * 3);
    const ys = edges.filter((_, at) => at % 3 === 1);
    assert.deepEqual([Math.min(...ys), Math.max(...ys)], [2 * index, 2 * index + 1]);
  }
  for (const [index, { edges, triangles }] of cut.entries()) {
    assert.equal(edges, undefined);
    const ys = triangles.positions.filter((_, at) => at % 3 === 1);
    const [low, high] = [Math.min(...ys), Math.max(...ys)].map((y) => y + triangles.origin[1]);
    near(low, 2 * index, 1e-6);
    near(high, 2 * index + 1, 1e-6);
  }
  const fractions = told.map(({ fraction }) => fraction);
  assert.deepEqual(
    fractions,
    [...fractions].sort((one, other) => one - other),
  );
  assert.equal(fractions.at(-1), 1);
  const failing = () => {
    throw new RangeError("mine");
  };
  await assert.rejects(readCad(bytesOf(stepSquares(2)), { onFace: failing }), /mine/);
});

/** Files of the shared models: number of faces, and of trimming curves. */
const files = [
  ["step", "AMSurface.step", 1, 4],
  ["step", "screw.step", 10, 44],
  ["step", "NIST_MBE_PMI_11.stp", 10, 52],
  ["step", "linkrods.step", 37, 216],
  ["step", "NIST_MBE_PMI_1.stp", 113, 624],
  ["step", "NIST_MBE_PMI_5.stp", 163, 842],
  ["step", "NIST_MBE_PMI_2.stp", 597, 3056],
  ["iges", "hammer.iges", 45, 208],
  ["iges", "bearing.iges", 213, 941],
  ["step", "featuretype.STEP", 96, 486],
  ["step", "base_interface_AP203.STEP", 30, 168],
  // A whole sphere, without a curve.
  ["step", "axom_revolved_sphere.step", 1, 0],
  ["step", "axom_sliced_cylinder.step", 5, 18],
  ["step", "axom_tet.step", 4, 12],
];

/**
 * Limits on gaps, in mm. The largest known in STEP are NIST's 0.007; hammer.iges, a part of 50 m
 * by its unit, has 2.63; OpenCASCADE's translation keeps 1.03.
 */
const MAX_GAPS = { step: 0.01, iges: 2.7 };

for (const [kind, name, faces, trims] of files) {
  test(`every face of ${name}`, { skip: missing }, async (context) => {
    await loaded();
    const model = await readCad(sharedGzip(`${kind}/${name}`), { name });
    const { report } = model;
    context.diagnostic(`${name}: ${JSON.stringify(report)}`);
    assert.deepEqual(report.skipped, []);
    assert.equal(report.kind, kind);
    assert.equal(report.reader, "built-in");
    assert.equal(report.faces, faces);
    assert.equal(report.trims, trims);
    assert.equal(report.exact + report.fitted, trims);
    assert.equal(report.unit, 0.001);
    assert.ok(report.gap >= 0 && report.gap < MAX_GAPS[kind]);
    assert.equal(model.faceCount, faces);
    assert.equal(model.name, name);
    model.dispose();
  });
}

/**
 * Rhino files: surfaces, loops and trims of their B-reps, the 2D curves stored, and
 * the trimming curves after polycurves are taken apart.
 */
const rhinoFiles = [
  ["v1_five_solids.3dm", 13, 13, 43, 43, 52, null],
  ["v2_T-Joint2.3dm", 18, 21, 101, 101, 115, 0.001],
  ["v2_my_trimmed_surface.3dm", 1, 1, 3, 3, 3, 0.001],
  ["v4_Gear.3dm", 128, 128, 656, 1144, 656, 0.001],
  ["v4_MechPartA.3dm", 41, 47, 188, 337, 188, 0.001],
  ["v4_MechPartB.3dm", 14, 14, 62, 62, 62, 0.001],
];

for (const [name, faces, loops, trims, curves, pieces, unit] of rhinoFiles) {
  test(`every face of ${name}`, { skip: missing }, async (context) => {
    await loaded();
    const model = await readCad(sharedGzip(`3dm/${name}`), { name });
    const { report } = model;
    context.diagnostic(`${name}: ${JSON.stringify(report)}`);
    assert.deepEqual(report.skipped, []);
    const { kind, reader, faces: read, exact, fitted } = report;
    assert.deepEqual([kind, reader, read, exact, fitted], ["3dm", "rhino3dm", faces, pieces, 0]);
    assert.equal(report.unit, unit);
    assert.equal(model.faceCount, faces);
    model.dispose();
  });

  test(`the B-reps of ${name} have the curves, loops and trims of rhino3dm`, {
    skip: missing,
  }, async () => {
    const rhino = await startRhino();
    const objects = rhino.File3dm.fromByteArray(sharedFile(`3dm/${name}`)).objects();
    const found = { faces: 0, loops: 0, trims: 0, curves: 0 };
    for (let index = 0; index < objects.count; index += 1) {
      const brep = objects.get(index).geometry();
      if (!(brep instanceof rhino.Brep)) continue;
      const topology = brepTopology(ChunkReader.ofBase64(brep.encode().data));
      found.faces += topology.faces.length;
      found.loops += topology.loops.length;
      found.trims += topology.trims.length;
      found.curves += topology.curves.length;
      topology.faces.forEach((face, at) => {
        const theirs = brep.faces().get(at);
        assert.equal(face.reversed, theirs.orientationIsReversed);
        assert.equal(face.loops.length, theirs.loops.count);
        face.loops.forEach((loop, at) => {
          const { trims } = theirs.loops.get(at);
          const edges = Array.from({ length: trims.count }, (_, k) => trims.get(k).edgeIndex);
          assert.deepEqual(
            topology.loops[loop].trims.map((trim) => topology.trims[trim].edge),
            edges,
          );
        });
      });
    }
    assert.deepEqual(found, { faces, loops, trims, curves });
  });
}

test("trimming curves of Rhino begin and end at their vertices", { skip: missing }, async () => {
  await loaded();
  for (const [name] of rhinoFiles) {
    const { json } = await convertCad(sharedFile(`3dm/${name}`), { name });
    for (const { part, trim } of JSON.parse(json).surfaces) {
      for (const loop of trim) {
        loop.forEach(({ ctrl }, index) => {
          const [[u, v], [a, b]] = [ctrl.at(-1), loop[(index + 1) % loop.length].ctrl[0]];
          const size = Math.max(1, Math.abs(u), Math.abs(v));
          assert.ok(Math.hypot(u - a, v - b) <= 1e-12 * size, part);
        });
      }
    }
  }
});

test("IGES in inches is scaled to millimetres", { skip: missing }, async () => {
  await loaded();
  const text = Buffer.from(sharedFile("iges/bearing.iges")).toString("latin1");
  const inches = text.replace("1.,2,   G0000002", "1.,1,   G0000002").replace("2HMM,1,", "2HIN,1,");
  assert.notEqual(inches, text);
  const [a, b] = await Promise.all([text, inches].map((text) => readCad(bytesOf(text))));
  a.boundingBox.max.forEach((x, axis) => {
    near(b.boundingBox.max[axis], 25.4 * x, 1e-9);
  });
});

test("a host's own OpenCASCADE is used", { skip: missing }, async () => {
  await loaded();
  const occt = () => import("replicad-opencascadejs");
  const libraries = [];
  const onLibrary = (library) => libraries.push(library);
  const model = await readCad(sharedFile("step/screw.step"), { occt, reader: "occt", onLibrary });
  assert.deepEqual([model.report.faces, model.report.reader], [10, "occt"]);
  await readCad(sharedFile("step/screw.step"), { occt, reader: "occt", onLibrary });
  assert.deepEqual(libraries, ["occt"], "it is loaded once");
  const never = () => assert.fail("OpenCASCADE was not asked for");
  const { report } = await readCad(sharedFile("step/screw.step"), { occt: never });
  assert.deepEqual([report.faces, report.reader], [10, "built-in"]);
  await assert.rejects(
    readCad(sharedFile("iges/hammer.iges"), { occt, reader: "occt" }),
    withCode("PEER_MISSING", /reads no IGES.*npm install @bitbybit-dev\/occt/),
  );
  await assert.rejects(
    readCad(sharedFile("step/screw.step"), { occt: () => 3, reader: "occt" }),
    withCode("OPTION_INVALID", /occt loads number/),
  );
  const offline = () => Promise.reject(new TypeError("Failed to fetch"));
  await assert.rejects(
    readCad(sharedFile("step/screw.step"), { occt: offline, reader: "occt" }),
    withCode("PEER_MISSING", /function of the option occt failed.*Failed to fetch/),
  );
});

test("an OpenCASCADE that is started anew leaves no listeners on the process", {
  skip: missing,
}, async () => {
  await loaded();
  const counts = () =>
    ["uncaughtException", "unhandledRejection"].map((e) => process.listenerCount(e));
  const before = counts();
  for (const _ of [1, 2]) {
    // Each function is a host's own, and starts a module.
    await readCad(sharedFile("step/screw.step"), { occt: () => startOcct, reader: "occt" });
  }
  assert.deepEqual(counts(), before);
});

/** BREP text of a box of this length, by OpenCASCADE. */
let oc;
async function boxText(length) {
  oc ??= await startOcct();
  return fromOcct(oc, new oc.BRepPrimAPI_MakeBox_2(length, 2, 3).Shape()).brep;
}

test("BREP text, and its unit as the caller states it", async () => {
  await loaded();
  const bytes = bytesOf(await boxText(1));
  const { report } = await readCad(bytes);
  assert.deepEqual(report, {
    ...{ kind: "brep", reader: "built-in" },
    ...{ faces: 6, trims: 24, exact: 24, fitted: 0, gap: report.gap, gapProven: true },
    ...{ unit: null, skipped: [], notes: [] },
  });
  near(report.gap, 0, 1e-12);
  assert.equal((await readCad(bytes, { unit: 0.0254 })).report.unit, 0.0254);
  assert.equal((await readCad(gzipSync(bytes))).report.faces, 6);
  assert.equal((await readCad(bytes.buffer)).report.faces, 6);
});

test("interchange JSON without a unit has that of the caller", async () => {
  const text = (unit) => bytesOf(JSON.stringify({ ...interchangeSquare(), ...unit }));
  const unitOf = async (...given) => {
    const { unit, report } = await readCad(...given);
    assert.equal(report.unit, unit);
    return unit;
  };
  assert.equal(await unitOf(text({})), null);
  assert.equal(await unitOf(text({}), { unit: 0.0254 }), 0.0254);
  assert.equal(await unitOf(text({ unit: 0.001 }), { unit: 0.0254 }), 0.001);
  const { json, report } = await convertCad(text({}), { unit: 0.01 });
  assert.deepEqual([JSON.parse(json).unit, report.unit], [0.01, 0.01]);
});

test("conversion and reading give the same model", async () => {
  const hd = await loaded();
  const bytes = bytesOf(await boxText(1));
  const { json, report } = await convertCad(bytes, { name: "box", unit: 0.001 });
  assert.equal(report.faces, 6);
  const model = hd.model(json);
  assert.deepEqual([model.name, model.faceCount], ["box", 6]);
  const { upper } = await hd.distance(model, await readCad(bytes, { unit: 0.001 }), {
    symmetric: true,
  });
  near(upper, 0, 1e-5);
  const again = await convertCad(bytesOf(json));
  assert.deepEqual(JSON.parse(again.json), JSON.parse(json));
  assert.equal(again.report.kind, "json");
  assert.equal(again.report.trims, 24);
});

test("interchange JSON, also behind a byte order mark", async () => {
  await loaded();
  const text = JSON.stringify(interchangeSquare(1));
  for (const bytes of [bytesOf(text), bytesOf(`\xEF\xBB\xBF${text}`), gzipSync(text)]) {
    const { report, name } = await readCad(bytes);
    assert.deepEqual([report.kind, report.faces, name], ["json", 1, "square"]);
  }
  const ragged = interchangeSquare();
  ragged.surfaces[0].ctrl[1].pop();
  for (const read of [readCad, convertCad]) {
    await assert.rejects(read(bytesOf(JSON.stringify(ragged))), withCode("RAGGED_NET"));
  }
});

/** A FreeCAD document of these objects: name, visible, file of the shape, more properties. */
function documentXml(objects) {
  const shape = (file) =>
    file
      ? `<Property name="Shape" type="Part::PropertyPartShape"><Part file="${file}"/></Property>`
      : "";
  const datas = objects.map(
    ({ name, file, more = "" }) =>
      `<Object name="${name}"><Properties>${shape(file)}${more}</Properties></Object>`,
  );
  const views = objects.map(
    ({ name, visible = true }) =>
      `<ViewProvider name="${name}" expanded="0"><Properties><Property name="Visibility" type="App::PropertyBool"><Bool value="${visible}"/></Property></Properties></ViewProvider>`,
  );
  return {
    "Document.xml": `<Document><Objects Count="1"><Object type="Part::Box" name="Box"/></Objects><ObjectData>${datas.join("")}</ObjectData></Document>`,
    "GuiDocument.xml": `<Document><ViewProviderData>${views.join("")}</ViewProviderData></Document>`,
  };
}

test("the visible shapes of a FreeCAD document", async () => {
  await loaded();
  const files = { "a.brp": await boxText(1), "b.brp": await boxText(5), "c.brp": await boxText(9) };
  const tip =
    '<Property name="Tip"/><Property name="Group"><LinkList><Link value="Pad"/></LinkList></Property>';
  const document = documentXml([
    { name: "Box", file: "a.brp" },
    { name: "Hidden", file: "c.brp", visible: false },
    { name: "Pad", file: "b.brp" },
    { name: "Body", file: "b.brp", more: tip },
  ]);
  for (const method of [0, 8]) {
    const model = await readCad(zip({ ...document, ...files }, method), { name: "part" });
    assert.deepEqual([model.name, model.faceCount], ["part", 12]);
    assert.deepEqual(model.boundingBox.max, [5, 2, 3]);
    const { kind, faces, trims, unit, skipped } = model.report;
    assert.deepEqual([kind, faces, trims, unit, skipped], ["fcstd", 12, 48, 0.001, []]);
  }
  const edges = JSON.parse((await convertCad(zip({ ...document, ...files }))).json)
    .surfaces.flatMap(({ trim }) => trim.flat())
    .map(({ edge }) => edge);
  assert.equal(new Set(edges).size, 24, "every box has edges of its own");
});

test("a FreeCAD document with a sketch, a broken and a binary shape", async () => {
  await loaded();
  const document = documentXml([
    { name: "Box", file: "a.brp" },
    { name: "Sketch", file: "empty.brp" },
    { name: "Broken", file: "broken.brp" },
    { name: "Binary", file: "shape.bin" },
  ]);
  const files = { "a.brp": await boxText(1), "empty.brp": "", "broken.brp": "CASCADE Topology V9" };
  const { report } = await readCad(zip({ ...document, ...files, "shape.bin": "" }));
  assert.equal(report.faces, 6);
  assert.deepEqual(
    report.skipped.map(({ face }) => face),
    ["Binary", "Broken"],
  );
  assert.deepEqual(
    report.skipped.map(({ code }) => code),
    ["FORMAT_UNSUPPORTED", "BREP_SYNTAX"],
  );
});

test("what places the shapes of a FreeCAD document is not passed over", async () => {
  await loaded();
  const link =
    '<Property name="LinkedObject"/><Property name="LinkPlacement"><PropertyPlacement Px="1"/></Property>';
  const document = documentXml([
    { name: "Box", file: "a.brp" },
    { name: "Copy", more: link },
  ]);
  const { report } = await readCad(zip({ ...document, "a.brp": await boxText(1) }));
  assert.deepEqual(
    report.skipped.map(({ face }) => face),
    ["Copy"],
  );
});

test("what a FreeCAD document has besides its objects' own shapes", async () => {
  await loaded();
  const group = (name) =>
    `<Property name="Group"><LinkList><Link value="${name}"/></LinkList></Property>`;
  const kernel = (name) => `<Property name="${name}"><${name} file="data"/></Property>`;
  const shapes =
    '<Property name="AddSubShape"><Part file="b.brp"/></Property><Property name="Shape"><Part file="a.brp"/></Property>';
  const elements =
    '<Property name="ElementList"><LinkList><Link value="Pad"/></LinkList></Property>';
  const document = documentXml([
    { name: "Pad", more: shapes },
    { name: "Link", more: '<Property name="LinkedObject"><XLink name="Pad"/></Property>' },
    { name: "LinkGroup", more: elements },
    { name: "Scan", more: kernel("Mesh") },
    { name: "Cloud", more: kernel("Points") },
    { name: "Part", visible: false, more: `${group("Inner")}<Property name="Origin"/>` },
    { name: "Inner", more: group("Deep") },
    { name: "Deep", file: "b.brp" },
    { name: "Lost", file: "lost.brp" },
  ]);
  const { report, boundingBox } = await readCad(
    zip({ ...document, "a.brp": await boxText(1), "b.brp": await boxText(5), data: "" }),
  );
  assert.deepEqual([report.faces, boundingBox.max], [6, [1, 2, 3]]);
  const names = ({ face }) => face;
  assert.deepEqual(report.skipped.map(names), ["Link", "LinkGroup", "Scan", "Lost"]);
  assert.deepEqual(report.notes.map(names), ["Cloud"]);
});

/** Contents that are recognised and refused: the code, and what the message names. */
const refused = [
  ["FORMAT_UNSUPPORTED", "", /an empty file/],
  ["FORMAT_UNSUPPORTED", "solid cube\nfacet normal", /an STL file.*triangles.*readMesh/],
  ["FORMAT_UNSUPPORTED", "ply\nformat ascii", /a PLY file/],
  ["FORMAT_UNSUPPORTED", "# made by hand\nv 0 0 0", /an OBJ file/],
  ["FORMAT_UNSUPPORTED", "glTF\x02", /a glTF file/],
  ["FORMAT_UNSUPPORTED", "LASF\0", /a LAS or LAZ file.*points.*readMesh/],
  ["FORMAT_UNSUPPORTED", "**ABCDEFGHIJ", /a Parasolid file.*export it as STEP/],
  ["FORMAT_UNSUPPORTED", "700 0 1 0 \n", /an ACIS file/],
  ["FORMAT_UNSUPPORTED", "\xD0\xCF\x11\xE0\xA1\xB1\x1A\xE1", /SolidWorks/],
  ["FORMAT_UNSUPPORTED", "AC1032", /a DWG file/],
  ["FORMAT_UNSUPPORTED", "\nOpen CASCADE Topology V4", /BREP file in binary.*BRepTools/],
  ["FORMAT_UNSUPPORTED", "hello", /an unknown format; read are STEP, IGES/],
  ["JSON_SHAPE", "{", /not interchange JSON/],
  ["BREP_SYNTAX", "DBRep_DrawableShape\nCASCADE Topology V3\nLocations x", /./],
  ["STEP_SYNTAX", "ISO-10303-21;\nHEADER;\nENDSEC;\nDATA;\n#1=(broken;\nENDSEC;", /line 5/],
  ["EMPTY_MODEL", "ISO-10303-21;\nHEADER;\nENDSEC;\nDATA;\nENDSEC;\nEND-ISO-10303-21;", /./],
  ["IGES_SYNTAX", `${"x".repeat(72)}S      1\n${"x".repeat(72)}G      1\n`, /./],
  ["CAD_UNREADABLE", "3D Geometry File Format        4", /rhino3dm/],
  ["CAD_UNREADABLE", "PK\x03\x04", /zip archive is damaged/],
  ["CAD_UNREADABLE", "\x1f\x8b\x08 broken", /compressed content is damaged/],
];

for (const [code, content, message] of refused) {
  const shown = JSON.stringify(content.slice(0, 24));
  test(`${shown} is refused: ${code}`, async () => {
    await loaded();
    await assert.rejects(readCad(bytesOf(content)), withCode(code, message));
  });
}

test("archives of other kinds are refused", async () => {
  await loaded();
  for (const [files, message] of [
    [{ "3D/3dmodel.model": "<model/>" }, /3MF.*triangles/],
    [{ "readme.txt": "" }, /a zip archive.*unpack/],
  ]) {
    await assert.rejects(readCad(zip(files)), withCode("FORMAT_UNSUPPORTED", message));
  }
  const empty = zip(documentXml([{ name: "Sketch" }]));
  await assert.rejects(readCad(empty), withCode("EMPTY_MODEL"));
});

test("a STEP file that is refused is read by OpenCASCADE, and the report says so", {
  skip: missing,
}, async () => {
  const step = Buffer.from(sharedFile("step/screw.step")).toString("latin1");
  // A character that ISO 10303-21 does not know outside of text; OpenCASCADE passes over it.
  const damaged = bytesOf(step.replace("ENDSEC;\nEND-ISO", "#999999=X(@);\nENDSEC;\nEND-ISO"));
  const { reader, faces, notes } = (await readCad(damaged)).report;
  assert.deepEqual([reader, faces, notes[0].face], ["occt", 10, "the file"]);
  assert.match(notes[0].why, /the package's reader refused it: line \d+: found/);
  // Without OpenCASCADE the reader's own reason is the error.
  await assert.rejects(
    readCad(damaged, { occt: "no-such-package" }),
    withCode("STEP_SYNTAX", /line \d+/),
  );
});

test("a shape in memory, and its unit", async () => {
  const brep = await boxText(1);
  assert.equal((await readCad({ brep, unit: 0.01 })).unit, 0.01);
  assert.equal((await readCad({ brep }, { unit: 0.02, name: "box" })).unit, 0.02);
  await assert.rejects(readCad({ brep: 1 }), withCode("ARGUMENT_INVALID", /brep is number/));
  await assert.rejects(readCad({ brep, units: 1 }), withCode("OPTION_INVALID", /"unit"/));
});

test("a face left out has its number in the file", { skip: missing }, async () => {
  const step = Buffer.from(sharedFile("step/screw.step")).toString("latin1");
  const [, number] = step.match(/#(\d+)\s*=\s*ADVANCED_FACE/);
  const without = step.replace(new RegExp(`#${number}\\s*=\\s*ADVANCED_FACE[^;]*;`), "");
  const { faces, skipped } = (await readCad(bytesOf(without))).report;
  assert.deepEqual([faces, skipped.length, skipped[0].entity], [9, 1, Number(number)]);
});

test("what is no file is refused", async () => {
  await loaded();
  for (const input of [undefined, null, "part.step", [1]]) {
    await assert.rejects(readCad(input), withCode("ARGUMENT_INVALID"));
  }
});

test("a file cut off is read in part or refused, never by another error", {
  skip: missing,
}, async () => {
  await loaded();
  const cut = [
    ["3dm/v4_MechPartB.3dm", [0.1, 0.5, 0.9]],
    ["step/screw.step", [0.2, 0.5, 0.97]],
    ["iges/hammer.iges", [0.3, 0.8]],
  ];
  for (const [path, parts] of cut) {
    const bytes = sharedFile(path);
    for (const part of parts) {
      const error = await readCad(bytes.slice(0, part * bytes.length)).then(
        ({ report }) => assert.ok(report.faces > 0),
        (error) => error,
      );
      if (error) withCode(error.code, /./)(error);
    }
  }
});

test("a damaged ON_Brep is refused, whatever bytes it has", { skip: missing }, async () => {
  const rhino = await startRhino();
  const objects = rhino.File3dm.fromByteArray(
    sharedFile("3dm/v2_my_trimmed_surface.3dm"),
  ).objects();
  const bytes = Buffer.from(objects.get(0).geometry().encode().data, "base64");
  let refused = 0;
  for (let index = 0; index < bytes.length; index += 1) {
    const changed = Buffer.from(bytes);
    changed[index] ^= 0xff;
    try {
      brepTopology(
        new ChunkReader(new DataView(changed.buffer, changed.byteOffset, changed.length)),
      );
    } catch (error) {
      withCode("CAD_UNREADABLE")(error);
      refused += 1;
    }
  }
  assert.ok(refused > 100);
});

test("without optional packages STEP and IGES are read, and for 3DM the missing one is named", {
  skip: missing,
}, () => {
  const folder = mkdtempSync(join(tmpdir(), "nurbs-hausdorff-"));
  try {
    const dist = fileURLToPath(new URL("../../../dist", import.meta.url));
    cpSync(dist, join(folder, "dist"), { recursive: true });
    writeFileSync(join(folder, "package.json"), '{"type": "module", "version": "0.0.0"}');
    const program = `
      import { readFileSync } from "node:fs";
      import { convertCad } from "./dist/cad/node.js";
      const read = convertCad(readFileSync(process.argv[2]));
      const said = read.then(({ report }) => report.faces, ({ code, message }) => [code, message]);
      console.log(JSON.stringify(await said));`;
    writeFileSync(join(folder, "convert.js"), program);
    const said = (name, path) => {
      writeFileSync(join(folder, name), sharedFile(path));
      const options = { cwd: folder, stdio: "pipe" };
      return JSON.parse(`${execFileSync(process.execPath, ["convert.js", name], options)}`);
    };
    assert.equal(said("part.stp", "step/screw.step"), 10);
    assert.equal(said("part.igs", "iges/hammer.iges"), 45);
    const [code, message] = said("part.3dm", "3dm/v4_MechPartB.3dm");
    assert.equal(code, "PEER_MISSING");
    assert.match(message, /npm install rhino3dm/);
  } finally {
    rmSync(folder, { recursive: true });
  }
});
