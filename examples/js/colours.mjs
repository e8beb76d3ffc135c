// A three.js mesh coloured by the distance of its vertices from a model: red at
// `limit` and beyond, white on the model. A page adds the mesh to its scene.
import { Hausdorff } from "nurbs-hausdorff";
import { BufferAttribute, Color, Mesh, MeshBasicMaterial, TorusGeometry } from "three";

const limit = 0.2;
const hd = await Hausdorff.create();
const model = hd.shape("torus");
const { min, max } = model.boundingBox;

const radius = (max[0] - min[0]) / 2;
const geometry = new TorusGeometry(0.75 * radius, 0.25 * radius, 24, 96);
const points = geometry.getAttribute("position").array;
const { distances, bounds } = await hd.closestPoints(model, points, { relativeTolerance: 1e-6 });

const [on, off] = [new Color("white"), new Color("red")];
const colours = new Float32Array(points.length);
distances.forEach((distance, index) => {
  const fraction = Math.min(distance / limit, 1);
  on.clone()
    .lerp(off, fraction)
    .toArray(colours, 3 * index);
});
geometry.setAttribute("color", new BufferAttribute(colours, 3));
export const mesh = new Mesh(geometry, new MeshBasicMaterial({ vertexColors: true }));

const largest = distances.reduce((most, distance) => Math.max(most, distance), 0);
const error = bounds.reduce((most, bound) => Math.max(most, bound), 0);
console.log(`${distances.length} vertices, at most ${largest} away, each within ${error}`);
for (const owner of [model, hd]) owner.dispose();
