// The worker's side in browsers, with the readers of CAD files.
import { readCad } from "../../cad/read.js";
import { serveBrowser } from "../platform/browser-thread.js";

serveBrowser(readCad);
