// A bracket and its revision as STEP files, written by OpenCASCADE: the page's first example as a
// user has it, two files of a CAD program.
import { writeFileSync } from "node:fs";
import { join } from "node:path";
import startReplicad from "replicad-opencascadejs";

/** The lengths of the example (`www/src/examples/bracket.ts`), in millimetres. */
const COMMON = { height: 70, width: 60, thickness: 8, fillet: 6, screwRadius: 4.5, bearingAt: 45 };
const DESIGN = { ...COMMON, length: 80, screwsAt: 55, bearingRadius: 14 };
/** A longer base plate, screws that moved with it, and a bearing of another size. */
const REVISION = { ...COMMON, length: 80.35, screwsAt: 55.3, bearingRadius: 13.9 };

/** Writes both files into a folder, and returns their paths. */
export async function writeBrackets(folder) {
  const oc = await startReplicad();
  return Object.entries({ bracket: DESIGN, "bracket-revised": REVISION }).map(([name, sizes]) => {
    const file = join(folder, `${name}.step`);
    const writer = new oc.STEPControl_Writer();
    // The name of the part: without it, that of the translator.
    oc.Interface_Static.SetCVal("write.step.product.name", name);
    const kind = oc.STEPControl_StepModelType.STEPControl_AsIs;
    writer.Transfer(bracket(oc, sizes), kind, true, new oc.Message_ProgressRange());
    writer.Write("/bracket.step");
    writeFileSync(file, oc.FS.readFile("/bracket.step"));
    return file;
  });
}

/** An angle of two plates with a fillet, a round back, and three bores. */
function bracket(oc, sizes) {
  const { length, height, width, thickness, fillet } = sizes;
  const axis = thickness + fillet;
  const point = ([x, z]) => new oc.gp_Pnt(x, 0, z);
  const line = (from, to) => new oc.BRepBuilderAPI_MakeEdge(point(from), point(to)).Edge();
  // An eighth turn from either end, towards the profile's inner corner.
  const arc = (from, to, radius) => {
    const middle = axis - radius * Math.SQRT1_2;
    const curve = new oc.GC_MakeArcOfCircle(point(from), point([middle, middle]), point(to));
    return new oc.BRepBuilderAPI_MakeEdge(curve.Value()).Edge();
  };
  const wire = new oc.BRepBuilderAPI_MakeWire();
  for (const edge of [
    line([axis, 0], [length, 0]),
    line([length, 0], [length, thickness]),
    line([length, thickness], [axis, thickness]),
    arc([axis, thickness], [thickness, axis], fillet),
    line([thickness, axis], [thickness, height]),
    line([thickness, height], [0, height]),
    line([0, height], [0, axis]),
    arc([0, axis], [axis, 0], axis),
  ]) {
    wire.Add(edge);
  }
  const face = new oc.BRepBuilderAPI_MakeFace(wire.Wire(), true).Face();
  const along = new oc.gp_Vec(0, width, 0);
  const plates = new oc.BRepPrimAPI_MakePrism(face, along, false, true).Shape();
  return bores(sizes).reduce(
    (whole, { at, direction, radius }) => {
      const place = new oc.gp_Ax2(new oc.gp_Pnt(...at), new oc.gp_Dir(...direction));
      const tool = new oc.BRepPrimAPI_MakeCylinder(place, radius, 4 * thickness).Shape();
      return new oc.BRepAlgoAPI_Cut(whole, tool, new oc.Message_ProgressRange()).Shape();
    },
    plates,
  );
}

/** The bores, each from outside of its plate to beyond it. */
function bores({ width, thickness, screwsAt, screwRadius, bearingAt, bearingRadius }) {
  return [
    ...[0.25, 0.75].map((part) => ({
      ...{ at: [screwsAt, part * width, -thickness], direction: [0, 0, 1], radius: screwRadius },
    })),
    { at: [-thickness, width / 2, bearingAt], direction: [1, 0, 0], radius: bearingRadius },
  ];
}
