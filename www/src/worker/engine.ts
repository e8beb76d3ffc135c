// The package's worker, with the libraries of others for files that its own readers do not read.
import { loadLibrariesBy } from "nurbs-hausdorff/worker/thread";

loadLibrariesBy({
  occt: () => import("@bitbybit-dev/occt/bitbybit-dev-occt/nuxt.js"),
  rhino: () => import("rhino3dm/rhino3dm.module.js"),
});
