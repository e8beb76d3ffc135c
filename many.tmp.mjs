import { readFileSync } from "node:fs";
const { Hausdorff } = await import("nurbs-hausdorff");
const { readCad } = await import("nurbs-hausdorff/cad");
process.on("warning", (w) => console.log("WARNING", w.name, w.message));
await Hausdorff.create({ backend: "cpu" });
const reader = process.argv[2] === "occt" ? { reader: "occt" } : {};
let n = 0;
for (const file of process.argv.slice(3)) {
  const model = await readCad(readFileSync(file), { name: file, ...reader });
  n += model.report.faces; model.free?.(); 
}
console.log(process.argv.length - 3, "files", n, "faces", process.memoryUsage().rss >> 20, "MiB", process.listenerCount("uncaughtException"), process.listenerCount("unhandledRejection"));
