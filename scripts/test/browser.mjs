// The options with which the tests start Chromium. The flags that enable WebGPU,
// WebGL and a WebGPU canvas without a GPU are in webdriver.json.
import { readFileSync } from "node:fs";
import { inRoot } from "../paths.mjs";
import { which } from "../process.mjs";

const { args, binary } = JSON.parse(readFileSync(inRoot("webdriver.json"), "utf8"))[
  "goog:chromeOptions"
];

/** Options for playwright-core's `chromium.launch`. */
export const launchOptions = { executablePath: which("chromium") ?? binary, args };
