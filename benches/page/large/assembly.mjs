// Writes the STEP file of an assembly of many parts: one product, a body of many faces, placed at each part's place.

/** Parts in a row, and the distance of their places in mm: more than the largest part is wide. */
const IN_A_ROW = 15;
const SPACING = 400;

/**
 * Returns the text of a STEP file with one body as an assembly of `count` uses of that body; `shift` moves the last use.
 * The file is AP203 or AP214 as CAD systems write it, with one shape representation.
 *
 * @throws {Error} if the file has no such representation.
 */
export function assemblyOf(step, count, shift = 0) {
  const end = step.lastIndexOf("ENDSEC;");
  let next = Math.max(...[...step.matchAll(/^\s*#(\d+)\s*=/gm)].map(([, id]) => Number(id))) + 1;
  const lines = [];
  const add = (entity) => {
    lines.push(`#${next}=${entity};`);
    next += 1;
    return `#${next - 1}`;
  };
  const [, part] = /#(\d+)\s*=\s*(?:ADVANCED_BREP_|MANIFOLD_SURFACE_)?SHAPE_REPRESENTATION\s*\(/i.exec(step) ?? [];
  const shape = /SHAPE_DEFINITION_REPRESENTATION\s*\(\s*(#\d+)\s*,\s*(#\d+)\s*\)/i.exec(step);
  if (part === undefined || shape === null) throw new Error("the file has no shape of a product");
  const [, property, representation] = shape;
  const definition = new RegExp(`${property}\\s*=\\s*PRODUCT_DEFINITION_SHAPE\\s*\\([^#]*(#\\d+)\\s*\\)`, "i").exec(step)?.[1];
  const context = new RegExp(`${representation}\\s*=\\s*\\w*SHAPE_REPRESENTATION\\s*\\([^;]*?,\\s*(#\\d+)\\s*\\)\\s*;`, "i").exec(step)?.[1];
  if (definition === undefined || context === undefined) throw new Error("the file's product is not known");
  const place = (x, y) => {
    const [up, along] = ["(0.,0.,1.)", "(1.,0.,0.)"].map((xyz) => add(`DIRECTION('',${xyz})`));
    return add(`AXIS2_PLACEMENT_3D('',${add(`CARTESIAN_POINT('',(${x.toFixed(3)},${y.toFixed(3)},0.))`)},${up},${along})`);
  };
  const origin = place(0, 0);
  const whole = add(`SHAPE_REPRESENTATION('',(${origin}),${context})`);
  const product = add("PRODUCT('machine','machine','',())");
  const formation = add(`PRODUCT_DEFINITION_FORMATION('','',${product})`);
  const outer = add(`PRODUCT_DEFINITION('','',${formation},$)`);
  add(`SHAPE_DEFINITION_REPRESENTATION(${add(`PRODUCT_DEFINITION_SHAPE('','',${outer})`)},${whole})`);
  for (let index = 0; index < count; index++) {
    const moved = index === count - 1 ? shift : 0;
    const at = place(SPACING * (index % IN_A_ROW) + moved, SPACING * Math.floor(index / IN_A_ROW));
    const map = add(`ITEM_DEFINED_TRANSFORMATION('','',${origin},${at})`);
    const relation = add(
      `(REPRESENTATION_RELATIONSHIP('','',${representation},${whole})REPRESENTATION_RELATIONSHIP_WITH_TRANSFORMATION(${map})SHAPE_REPRESENTATION_RELATIONSHIP())`,
    );
    const use = add(`NEXT_ASSEMBLY_USAGE_OCCURRENCE('${index}','part ${index + 1}','',${outer},${definition},$)`);
    const used = add(`PRODUCT_DEFINITION_SHAPE('','',${use})`);
    add(`CONTEXT_DEPENDENT_SHAPE_REPRESENTATION(${relation},${used})`);
  }
  return `${step.slice(0, end)}${lines.join("\n")}\n${step.slice(end)}`;
}
