import type { InterchangeModel } from "../../model/surface.js";
import type { CadOptions } from "../options.js";
import { type Peer, start } from "../peers/peers.js";
import type { CadReport } from "../report.js";
import { rhinoModel } from "./file.js";
import type { Rhino } from "./types.js";

const RHINO: Peer = {
  name: "rhino3dm",
  purpose: "reading 3DM",
  option: "rhino",
  node: "rhino3dm",
};

/**
 * The model of a 3DM file.
 *
 * @throws {HausdorffError} `PEER_MISSING`, `CAD_UNREADABLE`, `EMPTY_MODEL`.
 */
export async function readRhino(
  bytes: Uint8Array,
  { name, ...options }: CadOptions,
): Promise<{ model: InterchangeModel; report: CadReport }> {
  return rhinoModel((await start(RHINO, options)) as Rhino, bytes, name);
}
