// Parts and faces: their tree and their comparison.

export const faces = {
  andMoreWhichTheJSON: (hidden: number) => `and ${hidden} more, which the JSON export contains`,
  face: (face: number) => `face ${face}`,
  facesInAll: (faces: string) => `${faces} faces in all: type a part of a name`,
  contentsOf: (side: string, fullName: string) => `Contents of ${side} ${fullName}`,
  colourNote:
    "Changed faces have the colour of their model, those only extended or shortened a paler one; undecided ones are violet, others grey.",
  cancelled: "Cancelled.",
  faceCounts: (name: string, changed: string, undecided: string, unchanged: string) =>
    `${name}: ${changed} changed, ${undecided} undecided, ${unchanged} unchanged`,
  orThanIsAllowedOf: ", or than is allowed of it alone",
  noFaceDiffersByMore: (limit: string) => `No face differs by more than ${limit}.`,
  facesDifferByMoreThan: (limit: string) => `Faces differ by more than ${limit}:`,
  undecidedAt: (limit: string) => `Undecided at ${limit}:`,
  inSeconds: (solve: string) => `in ${solve}`,
  ofTheChangedOnlyA: (count: string, side: string) =>
    `; ${count} of the changed only ${side === "a" ? "shortened" : "extended"}`,
  part: "Part",
  state: "State",
  allParts: (parts: number) => `all ${parts} parts`,
  differ: (others: number) => `${others} differ`,
  ofParts: (parts: number) => `of ${parts} parts`,
  to: (nameOfB: string) => `to ${nameOfB}`,
  atMost: (upper: string, unitText: string) => `, at most ${upper}${unitText}`,
  turnedByAbout: (angle: string, axis: string) => `turned by ${angle}° about ${axis}`,
  byAlong: (way: string, unitText: string, shift: string) => `by ${way}${unitText} along ${shift}`,
  allPartsAreTheSame: (parts: number) => `All ${parts} parts are the same.`,
  partsAreNotTheSame: (others: number, parts: number, texts: string) =>
    `${others} of ${parts} parts are not the same: ${texts}.`,
  show: (side: string, fullName: string) => `Show ${side} ${fullName}`,
  showOnly: (side: string, fullName: string) => `Show only ${side} ${fullName}`,
  allowedDeviationOf: (side: string, name: string) => `Allowed deviation of ${side} ${name}`,
  only: "only",
  kinds: {
    ...{ unchanged: "unchanged", changed: "changed", undecided: "undecided" },
    ...{ extended: "extended", shortened: "shortened", added: "added", removed: "removed" },
    ...{ moved: "moved", resized: "resized" },
  },
  resized: (before: string, after: string) => `resized: radius ${before} to ${after}`,
  partStates: {
    ...{ same: "same", renamed: "renamed", moved: "moved", mirrored: "mirrored" },
    ...{ changed: "changed", movedAndChanged: "moved, changed" },
    ...{ added: "added", removed: "removed", undecided: "undecided" },
  },
};
