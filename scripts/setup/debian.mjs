// Programs from Debian's packages. Only the presence of the programs is
// checked, so other distributions pass once these are installed.
import { readdirSync, readFileSync } from "node:fs";
import { ask, Failure, must, which } from "../process.mjs";

const hasLavapipe = () => {
  try {
    return readdirSync("/usr/share/vulkan/icd.d").some((name) => name.startsWith("lvp_icd"));
  } catch {
    return false;
  }
};

/** The programs that compiling Rust needs. */
export const compiler = [
  {
    packages: ["gcc", "libc6-dev"],
    what: "a C compiler and linker (cc)",
    present: () => which("cc"),
  },
];

/** The programs that the tests need in addition: a browser, its driver, and Vulkan in software. */
export const browser = [
  { packages: ["chromium"], what: "Chromium", present: () => which("chromium") },
  { packages: ["chromium-driver"], what: "chromedriver", present: () => which("chromedriver") },
  {
    packages: ["mesa-vulkan-drivers", "libvulkan1"],
    what: "the Vulkan loader and Mesa's lavapipe driver",
    present: hasLavapipe,
  },
];

/** The second browser of the page's tests. */
export const firefox = [
  {
    packages: ["firefox-esr"],
    what: "Firefox",
    present: () => which("firefox") ?? which("firefox-esr"),
  },
  {
    packages: ["xvfb", "libgl1-mesa-dri"],
    what: "a screen for WebGL in Firefox",
    present: () => which("Xvfb"),
  },
];

/** The oldest Java of Spark 4. */
const MIN_JAVA = 17;

/** Whether the Java on PATH is one that Spark 4 runs on. */
function hasJava() {
  const version = ask("java", ["--version"])?.match(/^\S+ (\d+)/)?.[1];
  return Number(version) >= MIN_JAVA;
}

/** Java, for the tests on Spark. */
export const java = [
  {
    packages: ["default-jre-headless"],
    what: `Java ${MIN_JAVA} or newer`,
    present: hasJava,
  },
];

/** Returns the fields of /etc/os-release. */
export function distribution() {
  try {
    const lines = readFileSync("/etc/os-release", "utf8").matchAll(/^(\w+)="?([^"\n]*)"?$/gm);
    return Object.fromEntries([...lines].map(([, name, value]) => [name, value]));
  } catch {
    return {};
  }
}

/** Returns `[]` for root, `["sudo", "-n"]` if that needs no password, else undefined. */
function asRoot() {
  if (process.getuid?.() === 0) return [];
  return ask("sudo", ["-n", "true"]) === undefined ? undefined : ["sudo", "-n"];
}

const absent = (needs) => needs.filter(({ present }) => !present());

/** The packages of the programs that are missing. */
export const missingPackages = (needs) => absent(needs).flatMap((need) => need.packages);

/** Installs the missing programs, or fails with instructions. */
export async function debian(needs) {
  const missing = absent(needs);
  if (missing.length === 0) return "present";

  const packages = missing.flatMap((need) => need.packages);
  const { ID, ID_LIKE = "" } = distribution();
  const prefix = asRoot();
  if (ID !== "debian" || prefix === undefined) {
    const what = missing.map((need) => need.what).join("; ");
    const like = `${ID} ${ID_LIKE}`.includes("debian")
      ? `run: sudo apt-get install ${packages.join(" ")}`
      : `on Debian these are the packages ${packages.join(" ")}`;
    throw new Failure(`please install ${what} (${like}), then start again`);
  }

  const apt = (...args) => {
    const command = [
      ...prefix,
      "env",
      "DEBIAN_FRONTEND=noninteractive",
      "apt-get",
      "-q",
      "-o",
      "DPkg::Lock::Timeout=300",
      ...args,
    ];
    return must(command[0], command.slice(1));
  };
  await apt("update");
  await apt("install", "-y", "--no-install-recommends", ...packages);
  return `installed ${packages.join(", ")}`;
}
