// The code and the message of anything thrown.
import { HausdorffError } from "nurbs-hausdorff/worker";
import type { Code } from "./protocol.ts";

export const codeOf = (error: unknown): Code =>
  error instanceof HausdorffError ? error.code : "UNEXPECTED";

export const messageOf = (error: unknown): string =>
  error instanceof Error ? error.message : `${error}`;

export const isCancelled = (error: unknown): error is HausdorffError =>
  codeOf(error) === "CANCELLED";
