// Writes OpenCASCADE's BREP text of compressed STEP and IGES files: `node occt-brep.mjs OUT FILE…`.
import { readFileSync, writeFileSync } from "node:fs";
import { basename, join } from "node:path";
import { gunzipSync } from "node:zlib";
import start from "@bitbybit-dev/occt/bitbybit-dev-occt/node.js";

const [out, ...files] = process.argv.slice(2);
const oc = await start();
const made = (...names) => names.map((name) => oc[name]).find((constructor) => constructor);
const Progress = made("Message_ProgressRange_1", "Message_ProgressRange");
for (const file of files) {
  const name = basename(file, ".gz");
  const kind = /\.igs$|\.iges$/i.test(name) ? "IGES" : "STEP";
  const Reader = made(`${kind}Control_Reader_1`, `${kind}Control_Reader`);
  oc.FS.writeFile("/file", gunzipSync(readFileSync(file)));
  const reader = new Reader();
  reader.ReadFile("/file");
  reader.TransferRoots(new Progress());
  oc.BRepTools.Write_3(reader.OneShape(), "/brep", new Progress());
  writeFileSync(join(out, `${name}.brep`), oc.FS.readFile("/brep"));
}
