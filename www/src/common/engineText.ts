// The description of the backend in words.
import { texts } from "../texts/index.ts";
import type { EngineState } from "../worker/protocol.ts";

export function engineText({ backend, adapter }: EngineState): string {
  if (backend === "cpu") return texts.common.cpuFloat64;
  return texts.common.webGpuAndFloat64(adapter ? `: ${adapter}` : "");
}
