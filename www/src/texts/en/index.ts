// All texts of the page in English.
import { measuring } from "./measuring.ts";

export const en = { measuring };
