// Reads the 3DM file of standard input for the native program, which starts this with the file's name:
// its interchange JSON with the report, or the error.
import { buffer } from "node:stream/consumers";
import { convertCad } from "../cad/node.js";
import { HausdorffError } from "../error.js";

async function answer(name: string): Promise<object> {
  try {
    return { model: await convertCad(await buffer(process.stdin), { name }) };
  } catch (error) {
    if (!(error instanceof HausdorffError)) throw error;
    return { error: { code: error.code, message: error.message } };
  }
}

process.stdout.write(JSON.stringify(await answer(process.argv[2] ?? "")));
