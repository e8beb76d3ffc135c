// The description of the backend in words.
import type { EngineState } from "../worker/protocol.ts";

export function engineText({ backend, adapter }: EngineState): string {
  if (backend === "cpu") return "CPU, float64";
  return `WebGPU${adapter ? `: ${adapter}` : ""} · bounds completed in float64`;
}
