// node benches/page/rendering.mjs A B: opens two CAD files on the built page (`npx vite build www`) in headless Chromium,
// waits for the colours and turns the camera by the mouse; then does the same with a plain scene of three.js that has
// nothing but the triangles of the page's own glTF, in a canvas of the same size and from the same distance. Prints for
// both the triangles and calls of a frame, and per frame milliseconds by the clock and of CPU, with those of the process
// that draws.
import { readFile } from "node:fs/promises";
import { basename, extname } from "node:path";
import { open } from "../../tests/page/support/open.mjs";
import { watch } from "./marks.mjs";

/** Moves of the mouse, and pixels of each. */
const MOVES = 60;
const STEP = 4;
/** Milliseconds after which the colours are given up. */
const TIMEOUT = 300_000;
/** The page's own, in degrees. */
const FIELD_OF_VIEW = 32;

const [a, b] = process.argv.slice(2);
if (!b) throw new Error("usage: rendering.mjs A B");

/** Counts the triangles and the calls of each frame in `window.drawn`: runs in the page. */
function count() {
  window.drawn = { triangles: 0, calls: 0 };
  const of = WebGL2RenderingContext.prototype;
  for (const [name, at] of [
    ["drawElements", 1],
    ["drawArrays", 2],
  ]) {
    const draw = of[name];
    of[name] = function (mode, ...rest) {
      window.drawn.calls += 1;
      if (mode === this.TRIANGLES) window.drawn.triangles += rest[at - 1] / 3;
      return draw.call(this, mode, ...rest);
    };
  }
}

/** The seconds of CPU of the pages and of the process that draws. */
async function seconds(page) {
  const session = await page.context().browser().newBrowserCDPSession();
  const { processInfo } = await session.send("SystemInfo.getProcessInfo");
  await session.detach();
  const of = (kind) =>
    processInfo.filter(({ type }) => type === kind).reduce((sum, { cpuTime }) => sum + cpuTime, 0);
  return { page: of("renderer"), drawing: of("GPU") };
}

/** Turns the camera and prints what a frame takes. */
async function turn(page, what, canvas) {
  const { x, y, width, height } = await page.locator(canvas).boundingBox();
  const [across, down] = [x + width / 2, y + height / 2];
  await page.mouse.move(across, down);
  await page.mouse.down();
  await page.mouse.move(across + STEP, down);
  await page.evaluate(() => {
    window.drawn = { triangles: 0, calls: 0 };
    window.frames = 0;
    const step = () => {
      window.frames += 1;
      requestAnimationFrame(step);
    };
    requestAnimationFrame(step);
  });
  const [before, start] = [await seconds(page), performance.now()];
  for (let move = 2; move <= MOVES + 1; move++) {
    await page.mouse.move(across + STEP * move, down);
    await page.evaluate(() => new Promise((resolve) => requestAnimationFrame(resolve)));
  }
  // What is drawn is read, so that no frame is left to be drawn.
  await page.locator(canvas).screenshot();
  const [clock, after] = [performance.now() - start, await seconds(page)];
  await page.mouse.up();
  const { triangles, calls } = await page.evaluate(() => window.drawn);
  const each = (value) => (value / MOVES).toFixed(1);
  console.log(
    `${what}: ${Math.round(triangles / MOVES)} triangles and ${each(calls)} calls; ${each(clock)} ms by the clock, ` +
      `${each(1000 * (after.page - before.page))} ms of CPU of the page, ${each(1000 * (after.drawing - before.drawing))} of what draws`,
  );
}

/** A scene of the triangles of a glTF, seen from a distance: the page's source. */
const plain = ({ width, height, distance }) => `<!doctype html>
<style>body { margin: 0 }</style>
<canvas id="plain" style="width: ${width}px; height: ${height}px"></canvas>
<script type="importmap">{ "imports": { "three": "/three/build/three.module.js", "three/addons/": "/three/examples/jsm/" } }</script>
<script type="module">
  import * as THREE from "three";
  import { OrbitControls } from "three/addons/controls/OrbitControls.js";
  import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
  const canvas = document.getElementById("plain");
  const renderer = new THREE.WebGLRenderer({ canvas, antialias: true });
  renderer.setSize(${width}, ${height}, false);
  const { scene: models } = await new GLTFLoader().loadAsync("/plain.glb");
  const box = new THREE.Box3().setFromObject(models);
  const camera = new THREE.PerspectiveCamera(${FIELD_OF_VIEW}, ${width} / ${height}, ${distance / 100}, ${distance * 100});
  const light = new THREE.DirectionalLight(0xffffff, 2);
  const scene = new THREE.Scene().add(models, new THREE.AmbientLight(0xffffff, 1), camera.add(light));
  scene.background = new THREE.Color(0xffffff);
  const controls = new OrbitControls(camera, canvas);
  box.getCenter(controls.target);
  camera.position.copy(controls.target).addScaledVector(new THREE.Vector3(1, 1, 1).normalize(), ${distance});
  controls.addEventListener("change", () => renderer.render(scene, camera));
  controls.update();
  renderer.render(scene, camera);
  document.body.dataset.state = "drawn";
</script>`;

const opened = await open({ path: "", prepare: (page) => page.addInitScript(count) });
try {
  const { page } = opened;
  await page.locator('#result[data-state="done"]').waitFor();
  await page.evaluate(watch, basename(b, extname(b)));
  await page.setInputFiles("#file-both", [a, b]);
  await page.waitForFunction(() => window.marks.colours, undefined, { timeout: TIMEOUT });
  await turn(page, "page", "canvas#canvas");
  const download = page.waitForEvent("download");
  await page.locator("#export-gltf").dispatchEvent("click");
  const model = await readFile(await (await download).path());
  const place = new URLSearchParams(new URL(page.url()).hash.slice(1)).get("camera");
  const { width, height } = await page.locator("canvas#canvas").boundingBox();
  const numbers = place.split(",").map(Number);
  const distance = Math.hypot(...[0, 1, 2].map((axis) => numbers[axis] - numbers[axis + 3])) / 1000;
  await page.route("**/three/**", async (route) => {
    const file = new URL(route.request().url()).pathname.replace("/three/", "node_modules/three/");
    await route.fulfill({ contentType: "text/javascript", body: await readFile(file) });
  });
  await page.route("**/plain.glb", (route) =>
    route.fulfill({ contentType: "model/gltf-binary", body: model }),
  );
  await page.route("**/plain.html", (route) =>
    route.fulfill({ contentType: "text/html", body: plain({ width, height, distance }) }),
  );
  await page.goto(new URL("plain.html", page.url()).href);
  await page.locator('body[data-state="drawn"]').waitFor();
  await turn(page, "plain scene", "canvas#plain");
} finally {
  await opened.close();
}
