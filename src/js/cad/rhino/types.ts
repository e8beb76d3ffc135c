/** The parts of rhino3dm that are used, as its typings declare them. */
export interface RhinoSurface {
  toNurbsSurface(): RhinoNurbsSurface | null;
  pointAt(u: number, v: number): number[];
}

export interface RhinoNurbsSurface extends RhinoSurface {
  readonly orderU: number;
  readonly orderV: number;
  knotsU(): { toList(): number[] };
  knotsV(): { toList(): number[] };
  points(): { countU: number; countV: number; get(u: number, v: number): number[] };
}

export interface RhinoFace {
  underlyingSurface(): RhinoSurface | null;
}

export interface RhinoBrep {
  faces(): { count: number; get(index: number): RhinoFace };
  encode(): object;
}

export interface RhinoExtrusion extends RhinoSurface {
  toBrep(splitKinkyFaces: boolean): RhinoBrep | null;
}

export interface RhinoInstanceReference {
  parentIdefId: string;
  xform: Readonly<Record<string, unknown>>;
}

export interface RhinoAttributes {
  name: string;
  id: string;
  isInstanceDefinitionObject: boolean;
}

export interface RhinoFile {
  settings(): { modelUnitSystem: unknown };
  objects(): {
    count: number;
    get(index: number): { geometry(): object | null; attributes(): RhinoAttributes };
  };
  instanceDefinitions(): { findId(id: string): { getObjectIds(): unknown } | null };
}

/** The started module. */
export interface Rhino {
  File3dm: { fromByteArray(bytes: Uint8Array): RhinoFile | null };
  UnitSystem: Readonly<Record<string, unknown>>;
  ObjectType: Readonly<Record<string, unknown>>;
}
