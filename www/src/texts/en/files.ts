// Files, sources, units, the position of A and the best fit.

/** A unit in a sentence, where "in in" would be read twice. */
const inWords = (unit: string): string => (unit === "in" ? "inches" : unit);

export const files = {
  openTwoFilesFirst: "Open two files first.",
  openAFileFirst: "Open a file first.",
  aWasMovedCompareAgain: "A was moved: compare again.",
  aWasMovedMeasureAgain: "A was moved: measure again.",
  aWasMovedCheckAgain: "A was moved: check again.",
  reading: (fraction: number) => `reading… ${fraction} %`,
  bestFit: "Best fit",
  stopFitting: "Stop fitting",
  poorFit:
    ". A poor fit: the parts differ much, or A has to be turned by hand near to where it belongs.",
  fitting: "fitting…",
  stepRMS: (step: number, rms: string) => `step ${step}: RMS ${rms}`,
  searchingPoses: (fraction: number) => `searching poses: ${fraction} %`,
  notConverged: ", not converged",
  laidOnByHand: "laid on by hand",
  steps: (steps: number, end: string) => `${steps} steps${end}`,
  datumsTookNothing: (datums: string) =>
    `; pair ${datums} turned and moved nothing, as those before it had left no such freedom`,
  countedOf: (counted: number, samples: number) => `; ${counted} of ${samples} samples count`,
  otherPoses: (ambiguous: number) => `; ${ambiguous} other poses fit as well`,
  rmsBeforeNow: (rmsBefore: string, rms: string, how: string, others: string, poor: string) =>
    `RMS ${rmsBefore} before, ${rms} now (${how})${others}${poor}`,
  findingTheBodies: "finding the bodies…",
  oneBodyEach: "one body each: nothing to move apart",
  toLookAtOnly: "to look at only: distances and pins are of models as they stand",
  bracketAndItsRevision: "Bracket and its revision",
  concentricSpheres: "Concentric spheres",
  nacaWingsAnd: "NACA wings 2412 and 2415",
  glassAndBottle: "Glass and bottle",
  bottleAndCopyMovedAnd: "Bottle and copy, moved and rotated",
  twoWigleyHulls: "Two Wigley hulls",
  twoToriOfDifferentThickness: "Two tori of different thickness",
  torusAndMovedCopy: "Torus and moved copy",
  coneAndCylinder: "Cone and cylinder",
  planeAndCylinderPaperFig: "Plane and cylinder (2012 paper, Fig. 5)",
  experimentsTwoWavySheets: "Experiments: two wavy sheets",
  sectionAt: (value: undefined | string, at: string) => `section at ${value} = ${at}`,
  sectionByTheNormalThrough: (normal: string, center: string) =>
    `section by the normal ${normal} through ${center}`,
  ownPair: "own pair",
  twoFilesAreComparedWas: (more: string) => `Two files are compared: ${more} was not opened.`,
  loading: "loading…",
  noFileYet: "no file yet",
  notHereYet: (name: string) => `not here yet: ${name}`,
  bracket: "Bracket",
  bracketRevised: "Bracket, revised",
  bracketRevisedName: "bracket, revised",
  hasAnotherContent: (name: string, hash: string) =>
    `${name} has another content than the link’s: its SHA-256 begins with ${hash}.`,
  isNoFileOfTheLink: (name: string) => `${name} is not a file of this link.`,
  theLinkIsDamaged: (names: string) =>
    `The link is damaged or of another version of this page: not all of ${names} is shown.`,
  theLinkIsAbout: (names: string, names2: number) =>
    `The link is about ${names}. A link holds no files: drop ${names2 > 1 ? "them" : "it"} here to see what it shows.`,
  unitUnknown: "unit unknown",
  byOpenCASCADE: (formats: string) => `${formats} by OpenCASCADE`,
  skipped: (skipped: string) => `${skipped} skipped`,
  curvesFitted: (fitted: string) => `${fitted} curves fitted`,
  itsTrianglesAreUpTo: (gap: string, suffix: string) =>
    `its triangles are up to ${gap}${suffix} from what they stand for`,
  trimmingCurvesExactFitted: (trims: string, exact: string, fitted: string) =>
    `${trims} trimming curves: ${exact} exact, ${fitted} fitted`,
  edgesAndFacesOfThe: (gap: string, suffix: string) =>
    `edges and faces of the file are up to ${gap}${suffix} apart`,
  andMoreSkipped: (more: string) => `and ${more} more skipped`,
  faceSkipped: (face: string, value: string, why: string) => `${face}${value} skipped: ${why}`,
  face: (face: number) => `face ${face}`,
  inchesAndMillimetres: "inches and millimetres",
  centimetresAndMillimetres: "centimetres and millimetres",
  metresAndMillimetres: "metres and millimetres",
  whichUnit: "unit?",
  and: " and ",
  modelUnits: "model units",
  inUnit: (unit: string) => `in ${inWords(unit)}`,
  theFileStatesNoUnit: "The file states no unit: say which one its numbers are in",
  asTheModelStatesIt: "As the model states it",
  bIsConverted: (a: string, b: string) =>
    `A is in ${inWords(a)} and B in ${inWords(b)}: B is converted to ${inWords(a)}.`,
  oneUnitUnknown: (known: string, a: string, unknown: string, value: string) =>
    `${known} is in ${inWords(a)}, and the file of ${unknown} states no unit: its numbers are taken as they are until you say which.${value}`,
  scanIsA:
    "A is points: both ways also judge how far B is from the nearest point, where none was taken too. One way judges the points alone.",
  scanIsB: (isBothWays: boolean) =>
    `B is points: ${isBothWays ? "both ways also judge" : "one way judges"} how far A is from the nearest point, where none was taken too. To judge the points alone, open them as A, one way.`,
  timesAsLarge: (found: number, found2: string) =>
    `One model is about ${found} times as large as the other, as ${found2} are.`,
  workerNotLoaded: "the worker's script could not be loaded",
  loadingOpenCascade: "loading OpenCASCADE (5 MB)…",
  loadingRhino: "loading rhino3dm (1 MB)…",
  allOfIt: "all of it",
  group: (face: number) => `group ${face}`,
  movedMeshNotChecked: (name: string) =>
    `${name} was moved, and only exact CAD is checked where it was moved to: undo that, or check A and B each alone`,
  faces: (shown: string, count: number) => `${shown} ${count === 1 ? "face" : "faces"}`,
  triangles: (shown: string, count: number) => `${shown} ${count === 1 ? "triangle" : "triangles"}`,
  pointCount: (shown: string, count: number) => `${shown} ${count === 1 ? "point" : "points"}`,
  mesh: "mesh",
  points: "points",
};
