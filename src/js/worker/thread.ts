// The worker's side in browsers.
import { serveBrowser } from "./platform/browser-thread.js";

export type { Libraries, LibraryOptions, PeerLoader } from "../cad/peers/peers.js";
export { loadLibrariesBy } from "./serve.js";

serveBrowser();
