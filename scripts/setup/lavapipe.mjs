// Lavapipe (Vulkan on the CPU) of Mesa 25. Debian 12 has Mesa 22, which is about
// a fifth as fast on our kernels, and which npm's `webgpu` rejects. There the
// driver is unpacked from the backports package into the user's cache; the
// system and its package lists are not changed. Newer distributions use their
// own driver.
import {
  existsSync,
  mkdirSync,
  mkdtempSync,
  readdirSync,
  readFileSync,
  renameSync,
  rmSync,
  writeFileSync,
} from "node:fs";
import { join } from "node:path";
import { cache } from "../paths.mjs";
import { ask, environment, Failure, must } from "../process.mjs";
import { distribution } from "./debian.mjs";

const home = join(cache, "lavapipe-25");
const icd = join(home, "lvp_icd.json");
const systemFolder = "/usr/share/vulkan/icd.d";

const needsBackport = () => distribution().VERSION_CODENAME === "bookworm";

/** Returns the driver description for the Vulkan loader, or undefined. */
export function driver() {
  if (existsSync(icd)) return icd;
  if (needsBackport() || !existsSync(systemFolder)) return undefined;
  const name = readdirSync(systemFolder).find((file) => file.startsWith("lvp_icd"));
  return name && join(systemFolder, name);
}

/** Returns the variables that make the Vulkan loader use only that driver. */
export function vulkan() {
  const file = driver();
  return {
    ...(file && { VK_ICD_FILENAMES: file, VK_DRIVER_FILES: file }),
    // Disables Mesa's device-select layer, which prints a message.
    NODEVICE_SELECT: "1",
  };
}

// Returns the address of the archive of this machine's Debian packages.
async function archive(options) {
  const list = () =>
    (
      ask(
        "apt-get",
        ["indextargets", "--format", "$(REPO_URI) $(RELEASE) $(COMPONENT)"],
        options,
      ) ?? ""
    )
      .split("\n")
      .map((line) => line.split(" "))
      .find(([, release, component]) => release === "bookworm" && component === "main")?.[0];
  const known = list();
  if (known) return known;
  // The system has no package lists: read them into our own.
  await must("apt-get", ["-q", "update"], options);
  return list();
}

function aptConfiguration(folder, sources) {
  for (const name of ["lists/partial", "cache/archives/partial", "empty"]) {
    mkdirSync(join(folder, name), { recursive: true });
  }
  const lines = [
    `Dir::State::Lists "${folder}/lists";`,
    `Dir::Cache "${folder}/cache";`,
    'Acquire::Languages "none";',
    ...(process.getuid?.() === 0 ? ['APT::Sandbox::User "root";'] : []),
    ...(sources
      ? [
          `Dir::Etc::SourceList "${sources}";`,
          `Dir::Etc::SourceParts "${folder}/empty";`,
          `Dir::Etc::PreferencesParts "${folder}/empty";`,
        ]
      : []),
  ];
  const file = join(folder, sources ? "backports.conf" : "system.conf");
  writeFileSync(file, `${lines.join("\n")}\n`);
  return { cwd: folder, env: environment({ APT_CONFIG: file }) };
}

async function unpackBackport(folder) {
  const site = (await archive({})) ?? (await archive(aptConfiguration(folder)));
  if (!site) {
    throw new Failure("no Debian archive is configured in apt (looked for bookworm/main)");
  }
  const sources = join(folder, "sources.list");
  const key = "/usr/share/keyrings/debian-archive-keyring.gpg";
  writeFileSync(sources, `deb [signed-by=${key}] ${site} bookworm-backports main\n`);

  const apt = aptConfiguration(folder, sources);
  await must("apt-get", ["-q", "update"], apt);
  await must("apt-get", ["-q", "download", "mesa-vulkan-drivers"], apt);
  const deb = readdirSync(folder).find((name) => name.endsWith(".deb"));
  await must("dpkg-deb", ["-x", deb, "root"], apt);

  const from = join(folder, "root", systemFolder);
  const description = JSON.parse(
    readFileSync(
      join(
        from,
        readdirSync(from).find((name) => name.startsWith("lvp_icd")),
      ),
    ),
  );
  const libraries = join(folder, "root/usr/lib");
  const library = readdirSync(libraries, { recursive: true, encoding: "utf8" }).find((name) =>
    name.endsWith("libvulkan_lvp.so"),
  );
  const missing = (ask("ldd", [join(libraries, library)]) ?? "")
    .split("\n")
    .filter((line) => line.includes("not found"))
    .map((line) => line.trim().split(" ")[0]);
  if (missing.length > 0) {
    throw new Failure(`lavapipe needs libraries that are missing here: ${missing.join(", ")}`);
  }

  const made = join(folder, "made");
  mkdirSync(made);
  renameSync(join(libraries, library), join(made, "libvulkan_lvp.so"));
  description.ICD.library_path = join(home, "libvulkan_lvp.so");
  writeFileSync(join(made, "lvp_icd.json"), JSON.stringify(description, null, 2));
  rmSync(home, { recursive: true, force: true });
  renameSync(made, home);
  return deb.split("_")[1];
}

/** Provides the driver, and returns how. */
export async function lavapipe() {
  if (driver()) return "present";
  if (!needsBackport()) throw new Failure("found no lavapipe driver (Mesa 25 or newer)");
  mkdirSync(cache, { recursive: true });
  const folder = mkdtempSync(join(cache, "making-lavapipe-"));
  try {
    return `unpacked Mesa ${await unpackBackport(folder)}`;
  } finally {
    rmSync(folder, { recursive: true, force: true });
  }
}
