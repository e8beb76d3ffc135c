// What the pages say before anything is done: their HTML names these texts in braces, as {{main.tools}}.
import { deforming } from "./deforming.ts";
import { experiments } from "./experiments.ts";
import { main } from "./main.ts";

export const pages = { main, experiments, deforming };
