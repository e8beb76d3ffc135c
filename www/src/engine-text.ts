// What computes, in words.

export function engineText(backend: "gpu" | "cpu", adapter: string | null): string {
  if (backend === "cpu") return "CPU, float64";
  return `WebGPU${adapter ? `: ${adapter}` : ""} · certificates finish in float64`;
}
