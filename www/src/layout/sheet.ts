// On a small screen the panel is a sheet at the foot, which is pulled up.

import { element } from "../common/elements.ts";
import { texts } from "../texts/index.ts";

/** Connects the button that pulls the sheet up. */
export function connectSheet(): void {
  const button = element("sheet");
  button.addEventListener("click", () => {
    const open = element("panel").classList.toggle("open");
    button.setAttribute("aria-expanded", `${open}`);
    button.textContent = open ? texts.common.showTheParts : texts.common.showAll;
  });
}
