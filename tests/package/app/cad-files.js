// A program that reads STEP files on its own thread; PACKAGE is the entry under test.
import { Hausdorff } from "PACKAGE";
import { readCad } from "nurbs-hausdorff/cad";
import { measureBalls } from "./shared/measure-balls.js";

globalThis.outcome = measureBalls(Hausdorff, {}, (_, bytes) => readCad(bytes));
