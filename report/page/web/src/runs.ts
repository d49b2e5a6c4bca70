// SPDX-License-Identifier: GPL-3.0-or-later
// The runs of a certificate: their names, and their errors as a list.
import type { Certificate, Run, Witness, WrongSide } from "./documents";

/** As the table of the command names it. */
export function nameOfRun(run: Run, certificate: Certificate): string {
  if (run.candidate !== undefined) return run.candidate;
  const kernel = run.kernel ?? "?";
  const twice = certificate.runs.some((other) => other !== run && other.kernel === kernel);
  return twice ? `${kernel}/${run.algorithm ?? "?"}` : kernel;
}

/** A region of error of a run. */
export interface RunError {
  run: string;
  light: string;
  polygon: string;
  side: string;
  witness: Witness;
  /** The side's own figures. */
  wrong: WrongSide;
}

/** The regions that the certificate has a place of, widest first. */
export function errorsOf(run: Run, certificate: Certificate): RunError[] {
  const name = nameOfRun(run, certificate);
  const errors: RunError[] = [];
  for (const wrong of run.wrong ?? []) {
    if (!wrong.worst) continue;
    for (const witness of [wrong.worst, ...(wrong.others ?? [])]) {
      if (!witness.point) continue;
      const { light, polygon, side } = wrong;
      errors.push({ run: name, light, polygon, side, witness, wrong });
    }
  }
  return errors.sort((a, b) => widthOf(b.witness) - widthOf(a.witness));
}

/** The upper bound of a region's width, scene units. */
export const widthOf = (witness: Witness): number => witness.width?.[1] ?? 0;

/** "found lit, true shadow, by caster table". */
export function errorInWords(witness: Witness): string {
  const words = [`found ${witness.found ?? "nothing"}`, `true ${witness.true ?? "nothing"}`];
  if (witness.caster) words.push(`by caster ${witness.caster}`);
  return words.join(", ");
}

/** Of all lights' facing area, which share is misclassified. */
export function wrongShare(run: Run, certificate: Certificate): number | null {
  const wrong = run.totals?.misclassified[1];
  if (wrong === undefined) return null;
  return certificate.facing_area > 0 ? wrong / certificate.facing_area : wrong;
}
