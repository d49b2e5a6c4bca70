// SPDX-License-Identifier: GPL-3.0-or-later
// Where each kernel begins to fail: a plot an axis, a line a kernel, the thresholds marked.
import { axisY, dot, line, ruleX, ruleY, tip, pointer } from "@observablehq/plot";
import { chart, decades } from "./charts";
import { kSeries } from "./colours";
import type { Curve, CurveStep, Extremes } from "./documents";
import { command, h, section } from "./dom";
import { duration, plural, rounded } from "./numbers";
import { Table } from "./table";
import { contradictions, powerText } from "./tradeoff_section";

const kTolerance = 1e-9;

export function nameOfCurve(curve: Curve): string {
  return (
    curve.kernel + (curve.thickness === null ? "" : `, thickness ${powerText(curve.thickness)}`)
  );
}

export function extremesSections(extremes: Extremes): HTMLElement[] {
  const sections: HTMLElement[] = [thresholdSection(extremes)];
  const axes = [...new Set(extremes.curves.map(({ axis }) => axis))];
  for (const axis of axes) {
    sections.push(
      axisSection(
        axis,
        extremes.curves.filter((curve) => curve.axis === axis),
      ),
    );
  }
  if (extremes.contradictions.length > 0) sections.unshift(contradictions(extremes.contradictions));
  return sections;
}

function thresholdSection(extremes: Extremes): HTMLElement {
  const table = new Table<Curve>({
    caption: "Thresholds, one row a curve",
    rows: extremes.curves,
    details: (curve) =>
      curve.steps
        .filter(({ k }) => k === curve.first_failure)
        .map((step) => h("p", {}, `${step.failure}: `, command(step.command))),
    columns: [
      { key: "axis", label: "axis", value: ({ axis }) => axis, facet: true },
      { key: "system", label: "system", value: ({ system }) => system, facet: true },
      { key: "kernel", label: "kernel", value: ({ kernel }) => kernel, facet: true },
      { key: "thickness", label: "thickness", value: ({ thickness }) => thickness },
      {
        key: "first_failure",
        label: "first failure, k",
        value: (curve) => curve.first_failure,
        show: (curve) => (curve.first_failure === null ? "none" : String(curve.first_failure)),
        tone: (curve) => (curve.first_failure === null ? "good" : "bad"),
      },
      { key: "last_right", label: "right before, k", value: (curve) => curve.last_right },
      {
        key: "failure",
        label: "how it fails",
        value: (curve) => curve.steps.find(({ k }) => k === curve.first_failure)?.failure ?? null,
        facet: true,
      },
    ],
  });
  const never = extremes.curves.filter(({ first_failure }) => first_failure === null).length;
  return section(
    "thresholds",
    "Where each begins to fail",
    h(
      "p",
      { class: "lead" },
      `${plural(extremes.curves.length, "curve")}, ${never} of them without any failure.`,
    ),
    table.element,
  );
}

interface Step {
  curve: string;
  system: string;
  k: number;
  log: number;
  failed: boolean;
  label: string;
  step: CurveStep;
}

function axisSection(axis: string, curves: Curve[]): HTMLElement {
  const values = curves.flatMap(({ steps }) => steps.map(({ worst_share }) => worst_share ?? 0));
  const [low, high] = decades([...values, kTolerance]);
  const zero = low - 1.5;
  const steps: Step[] = curves.flatMap((curve) =>
    curve.steps
      .filter(({ worst_share }) => worst_share !== null)
      .map((step) => ({
        curve: nameOfCurve(curve),
        system: curve.system,
        k: step.k,
        log: step.worst_share ? Math.log10(step.worst_share) : zero,
        failed: step.failure !== "",
        label:
          `${nameOfCurve(curve)}/${curve.system}, k = ${step.k}\nworst share ${rounded(step.worst_share ?? 0)}` +
          `, ${duration(step.cpu_seconds)}\n${step.failure === "" ? "right" : step.failure}`,
        step,
      })),
  );
  const names = [...new Set(curves.map((curve) => nameOfCurve(curve)))];
  const systems = [...new Set(curves.map(({ system }) => system))];
  const thresholds = curves
    .filter(({ first_failure }) => first_failure !== null)
    .map((curve) => ({
      k: curve.first_failure,
      curve: nameOfCurve(curve),
      system: curve.system,
    }));
  const chosen = h("div", { class: "chosen", "aria-live": "polite" });
  const show = ({ curve, system, k, step }: Step): void =>
    chosen.replaceChildren(
      h("h3", {}, `${curve}/${system}, k = ${k}`),
      h("p", {}, step.failure === "" ? "right" : step.failure),
      h("p", {}, command(step.command)),
    );
  const ticks = [zero];
  for (let k = low; k <= high; k += Math.max(1, Math.round((high - low) / 8))) ticks.push(k);
  const label =
    `Axis ${axis}: the step k to the right, greatest wrong share upwards. Filled dots are failures, ` +
    `dotted lines the first of each, the dashed line the tolerance. A click shows the command.`;
  const value = curves[0]?.value ?? "";
  return section(
    `axis-${axis}`,
    axis,
    h("p", { class: "lead" }, value ? `Step k: ${value}` : ""),
    chart({ label, height: 340, onclick: (picked) => show(picked as Step) }, (width) => {
      // Systems beside each other, or where there is no room, below.
      const beside = width >= 260 * systems.length;
      const facet = beside ? { fx: "system" } : { fy: "system" };
      return {
        height: beside ? 340 : 220 * systems.length + 60,
        marginLeft: 60,
        marginBottom: 40,
        marginRight: beside ? 20 : 80,
        x: { label: "k", grid: true },
        y: { domain: [zero - 0.4, high + 0.3], label: "worst share" },
        fx: { label: null },
        fy: { label: null },
        color: { domain: names, range: kSeries, legend: true },
        marks: [
          axisY(ticks, { tickFormat: (k: number) => (k === zero ? "0" : `1e${k}`) }),
          ruleY([Math.log10(kTolerance)], { strokeDasharray: "6 4", strokeOpacity: 0.6 }),
          ruleX(thresholds, { ...facet, x: "k", stroke: "curve", strokeDasharray: "2 3" }),
          line(steps, { ...facet, x: "k", y: "log", stroke: "curve", strokeWidth: 1.6 }),
          dot(
            steps.filter(({ failed }) => !failed),
            { ...facet, x: "k", y: "log", stroke: "curve", r: 2.5 },
          ),
          dot(
            steps.filter(({ failed }) => failed),
            { ...facet, x: "k", y: "log", stroke: "curve", fill: "curve", r: 4.5 },
          ),
          tip(steps, pointer({ x: "k", y: "log", title: "label", ...facet })),
        ],
      };
    }),
    chosen,
  );
}
