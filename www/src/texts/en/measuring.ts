// Measuring in the view, and the list of what was measured.

export const measuring = {
  firstPoint: "Click a first point, or Enter for the middle of the view. Esc ends measuring.",
  secondPoint: "Click a second point.",
  radius: "Click a round face, or near a round edge. Esc ends measuring.",
  edge: "Click a face near the edge. Esc ends measuring.",
  noRadius: "No cylinder, cone, sphere, torus or round edge is there within 0.1 %.",
  noEdge: "That face has no edge.",
  full: "There is room for no more: remove some in the list.",
  modelUnits: "model units",
  /** Numbers of the drawn triangles are estimates, and said to be. */
  about: (length: string, unit: string) => `≈ ${length} ${unit}`,
  turned: (degrees: string) => `faces turned by ${degrees}°`,
  radiusOf: (radius: string, diameter: string, unit: string) =>
    `R ${radius} ${unit} · ⌀ ${diameter} ${unit}`,
  radiusLabel: (radius: string) => `R ${radius}`,
  edgeLength: (length: string, unit: string) => `≈ ${length} ${unit} long`,
  cylinder: "cylinder",
  sphere: "sphere",
  cone: (degrees: string) => `at this place of a cone, ${degrees}° from its axis`,
  torus: (around: string, unit: string) => `tube of a torus, ≈ R ${around} ${unit} around`,
  circle: "round edge",
  certainRadius: (interval: string) =>
    `the distances of its points from the axis or the centre are certainly in ${interval}`,
  certainCone: (deviation: string, unit: string) =>
    `its points are certainly within ${deviation} ${unit} of the cone`,
  fitted: (points: string, residual: string, unit: string) =>
    `fitted to ${points} points, off by at most ${residual} ${unit}`,
  drawnEdge: (parts: string) => `drawn edge of ${parts === "1" ? "1 part" : `${parts} parts`}`,
  roundEdge: (parts: string) => `arcs through the ends of ${parts} drawn parts`,
  closed: "closed",
  of: (face: string) => `of ${face}`,
  from: (face: string, other: string) => `from ${face} to ${other}`,
  look: "Look at it from near",
  remove: (number: number) => `Remove measurement ${number}`,
  table: "Measurements",
  head: ["No.", "Measured", "Of"],
};
