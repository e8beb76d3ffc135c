// The worker's side in browsers.
import { serveBrowser } from "./platform/browser-thread.js";

serveBrowser();
