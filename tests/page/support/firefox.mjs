// Opens the built page in headless Firefox, driven by its own protocol, Marionette:
// JSON with its length before it on a TCP port (https://firefox-source-docs.mozilla.org/testing/marionette/).
import { spawn } from "node:child_process";
import { once } from "node:events";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { connect, createServer } from "node:net";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { setTimeout as wait } from "node:timers/promises";
import { preview } from "vite";
import { which } from "../../../scripts/process.mjs";
import { PLAIN } from "./open.mjs";
import { saveScreenshot } from "./screenshots.mjs";

/** Milliseconds in which Firefox has to listen, and in which a condition has to hold, beside what compiles. */
const START = 180_000;
const TIMEOUT = 180_000;

/** Lets WebGL run on Mesa's software, which Firefox otherwise takes for too slow. */
const SOFTWARE_WEBGL = { "webgl.force-enabled": true };
/** The camera is where it goes at once. */
const WITHOUT_MOTION = { "ui.prefersReducedMotion": 1 };

/** A port that nothing listens on. */
function freePort() {
  return new Promise((resolve) => {
    const server = createServer().listen(0, "127.0.0.1", () => {
      const { port } = server.address();
      server.close(() => resolve(port));
    });
  });
}

/** A screen that nobody sees: without one, Firefox has no WebGL. Undefined where Xvfb is not installed. */
async function virtualScreen() {
  const program = which("Xvfb");
  if (program === undefined) return undefined;
  const args = ["-displayfd", "1", "-screen", "0", "1280x800x24", "-nolisten", "tcp"];
  const server = spawn(program, args, { stdio: ["ignore", "pipe", "ignore"] });
  // It writes the number of the display, which it chooses, once it listens.
  const [number] = await once(server.stdout, "data");
  return {
    environment: { DISPLAY: `:${`${number}`.trim()}`, LIBGL_ALWAYS_SOFTWARE: "1" },
    close: () => server.kill(),
  };
}

async function connected(port) {
  const end = Date.now() + START;
  for (;;) {
    try {
      return await new Promise((resolve, reject) => {
        const socket = connect(port, "127.0.0.1", () => resolve(socket)).on("error", reject);
      });
    } catch (error) {
      if (Date.now() > end) throw error;
      await wait(200);
    }
  }
}

/** The commands of a connection: each resolves to its result. */
function commands(socket) {
  const pending = new Map();
  let received = Buffer.alloc(0);
  let count = 0;
  socket.on("data", (data) => {
    received = Buffer.concat([received, data]);
    for (;;) {
      const colon = received.indexOf(":");
      if (colon < 0) return;
      const end = colon + 1 + Number(received.subarray(0, colon));
      if (received.length < end) return;
      const message = JSON.parse(received.subarray(colon + 1, end));
      received = received.subarray(end);
      // The first message, which is no array, greets.
      if (!Array.isArray(message)) continue;
      const [, id, error, result] = message;
      const { resolve, reject } = pending.get(id);
      pending.delete(id);
      if (error) reject(new Error(`${error.error}: ${error.message}`));
      else resolve(result);
    }
  });
  return (name, parameters = {}) =>
    new Promise((resolve, reject) => {
      count += 1;
      pending.set(count, { resolve, reject });
      const text = JSON.stringify([0, count, name, parameters]);
      socket.write(`${Buffer.byteLength(text)}:${text}`);
    });
}

/** Opens the page in the Firefox at this path. */
export async function openFirefox(executable, path = PLAIN) {
  const server = await preview({ root: "www", preview: { port: 0 }, logLevel: "silent" });
  const port = await freePort();
  const profile = mkdtempSync(join(tmpdir(), "firefox-"));
  const preferences = { "marionette.port": port, ...SOFTWARE_WEBGL, ...WITHOUT_MOTION };
  const lines = Object.entries(preferences).map(
    ([name, value]) => `user_pref("${name}", ${value});\n`,
  );
  writeFileSync(join(profile, "user.js"), lines.join(""));
  const screen = await virtualScreen();
  const args = [...(screen ? [] : ["--headless"]), "--marionette", "--no-remote"];
  const firefox = spawn(executable, [...args, "--profile", profile], {
    stdio: "ignore",
    env: { ...process.env, HOME: profile, ...screen?.environment },
  });
  const ended = new Promise((resolve) => firefox.once("exit", resolve));
  const command = commands(await connected(port));
  await command("WebDriver:NewSession", {});
  await command("WebDriver:Navigate", { url: new URL(path, server.resolvedUrls.local[0]).href });
  /** Runs a function's text in the page. */
  const evaluate = async (run, ...args) => {
    const script = `return (${run})(...arguments)`;
    return (await command("WebDriver:ExecuteScript", { script, args })).value;
  };
  return {
    evaluate,
    /** Waits until a function of the page returns true. */
    async until(condition, ...args) {
      const end = Date.now() + TIMEOUT;
      while (!(await evaluate(condition, ...args))) {
        if (Date.now() > end) throw new Error(`not in ${TIMEOUT} ms: ${condition}`);
        await wait(100);
      }
    },
    /** Chooses a file of this machine in an input of the page. */
    async setFile(selector, file) {
      const { value } = await command("WebDriver:FindElement", {
        using: "css selector",
        value: selector,
      });
      const [id] = Object.values(value);
      await command("WebDriver:ElementSendKeys", { id, text: file });
    },
    /** Keeps a picture of the window, and returns it, a PNG in base64. */
    async screenshot(name) {
      const { value } = await command("WebDriver:TakeScreenshot", { full: false });
      saveScreenshot(name, Buffer.from(value, "base64"));
      return value;
    },
    async close() {
      await command("Marionette:Quit", { flags: ["eForceQuit"] }).catch(() => {});
      await ended;
      screen?.close();
      rmSync(profile, { recursive: true, force: true });
      await server.close();
    },
  };
}
