// What the machine cannot do.
import { element } from "./elements.ts";

const banner = element("banner");

/** Says what computes. */
export function tellEngine(
  backend: "gpu" | "cpu",
  adapter: string | null,
  notice: string | null,
): void {
  element("engine").textContent =
    backend === "gpu"
      ? `WebGPU${adapter ? `: ${adapter}` : ""} · certificates in float64`
      : "CPU, float64";
  if (notice !== null) tellCpu(notice);
}

/** Says why the CPU computes what the GPU could. */
export function tellCpu(notice: string): void {
  tell("No WebGPU here, so everything runs on the CPU", notice);
}

/** Says why there is nothing to see. */
export function tellNoWebGl(why: string): void {
  tell("No WebGL here, so the models cannot be shown; distances are computed all the same", why);
}

function tell(what: string, why: string): void {
  const text = `${what}: ${why}`;
  const said = [...banner.children].some((line) => line.textContent === text);
  if (said) return;
  const line = document.createElement("p");
  line.textContent = text;
  banner.append(line);
  banner.hidden = false;
}
