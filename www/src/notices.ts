// What the machine cannot do.
import { element } from "./elements.ts";
import { engineText } from "./engine-text.ts";

const banner = element("banner");
const notices = element("notices");

element("dismiss").addEventListener("click", () => {
  banner.hidden = true;
});

/** Says what computes. */
export function tellEngine(
  backend: "gpu" | "cpu",
  adapter: string | null,
  notice: string | null,
): void {
  element("engine").textContent = engineText(backend, adapter);
  if (notice !== null) tellCpu(notice);
}

/** Says why the CPU computes what the GPU could. */
export function tellCpu(notice: string): void {
  tell("No WebGPU: everything runs on the CPU", notice);
}

/** Says why there is nothing to see. */
export function tellNoWebGl(why: string): void {
  tell("No WebGL: the models cannot be shown, but distances are computed", why);
}

/** One line, the reason unfolding below it; each is told once. */
function tell(what: string, why: string): void {
  const lines = Array.from(notices.children, ({ firstChild }) => firstChild?.textContent);
  if (lines.includes(what)) return;
  const line = document.createElement("details");
  const summary = document.createElement("summary");
  summary.textContent = what;
  line.append(summary, why);
  notices.append(line);
  banner.hidden = false;
}
