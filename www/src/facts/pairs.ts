// What facts are stated of, side by side: both models, and their bodies, which go together by their names.

import type { Body, Facts } from "nurbs-hausdorff";
import { texts } from "../texts/index.ts";
import { type ModelFacts, SIDES, type Sides } from "../worker/protocol.ts";

/** Models, or a body of one or of each. */
export interface Subject {
  title: string;
  facts: Sides<Facts>;
  bodies: Sides<readonly Body[]>;
}

/** Returns both models, then their bodies; the models alone where each has one body. */
export function subjectsOf(models: Sides<ModelFacts>): Subject[] {
  const whole: Subject = { title: texts.bodies.wholeModels, facts: {}, bodies: {} };
  const named = new Map<string, Subject>();
  let isMany = false;
  for (const side of SIDES) {
    const model = models[side];
    if (model === undefined) continue;
    whole.facts[side] = model.facts;
    whole.bodies[side] = model.bodies;
    isMany ||= model.bodies.length > 1;
    for (const body of model.bodies) {
      const title = body.fullName;
      const subject = named.get(title) ?? { title, facts: {}, bodies: {} };
      subject.facts[side] = body.facts;
      subject.bodies[side] = [body];
      named.set(title, subject);
    }
  }
  return isMany ? [whole, ...named.values()] : [whole];
}
