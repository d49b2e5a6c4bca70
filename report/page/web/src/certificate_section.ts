// SPDX-License-Identifier: GPL-3.0-or-later
// A certificate: verdicts, errors, widths, and the decisions that went another way.
import { axisX, binX, rectY, ruleX, ruleY } from "@observablehq/plot";
import { chart, decades } from "./charts";
import { kSeries, toneOf } from "./colours";
import type { Certificate, Flip, Run } from "./documents";
import { h, section, type Child } from "./dom";
import { counted, duration, plural, rounded, sentence } from "./numbers";
import { errorInWords, errorsOf, nameOfRun, widthOf, wrongShare, type RunError } from "./runs";
import { Table } from "./table";

export function policyOf(run: Run): string {
  if (run.candidate !== undefined) return "foreign";
  if (run.exact) return "exact";
  const kernel = run.kernel ?? "";
  return kernel.startsWith("epick") ? "points rounded" : `thickness ${run.thickness ?? 0}`;
}

export function verdictSection(certificate: Certificate): HTMLElement {
  const reference = certificate.runs.find(({ kernel }) => kernel === "double")?.cpu_seconds;
  const ratio = (run: Run): number | null =>
    reference && run.cpu_seconds !== undefined ? run.cpu_seconds / reference : null;
  const table = new Table<Run>({
    caption: "Verdicts, one row a run",
    rows: certificate.runs,
    details: (run) => runDetails(run),
    columns: [
      { key: "run", label: "run", value: (run) => nameOfRun(run, certificate) },
      { key: "policy", label: "policy", value: policyOf, facet: true },
      {
        key: "verdict",
        label: "verdict",
        value: (run) => run.verdict ?? "no answer",
        show: (run) =>
          (run.verdict ?? "no answer") + (run.counts === false ? " (does not count)" : ""),
        tone: (run) => toneOf(run.verdict ?? "no answer"),
        facet: true,
      },
      {
        key: "worst_share",
        label: "worst share",
        title: "Greatest wrong share of a polygon's side: what the tolerance is compared with",
        value: (run) => run.totals?.worst_share ?? null,
        show: (run) => measured(run.totals?.worst_share),
      },
      {
        key: "wrong_area",
        label: "wrong area",
        title: "Misclassified area, as a share of the area that faces a light",
        value: (run) => wrongShare(run, certificate),
        show: (run) => measured(wrongShare(run, certificate)),
      },
      {
        key: "wrong_polygons",
        label: "wrong sides",
        title: "Polygon sides with any error",
        value: (run) => run.totals?.wrong_polygons ?? null,
        show: (run) =>
          run.totals
            ? `${counted(run.totals.wrong_polygons)} of ${counted(run.totals.polygons)}`
            : "–",
      },
      {
        key: "width",
        label: "width",
        title: "Greatest width of a region of error, scene units",
        value: (run) => run.totals?.width[1] ?? null,
        show: (run) => measured(run.totals?.width[1]),
      },
      {
        key: "fragments",
        label: "fragments",
        value: (run) => run.fragments,
        show: (run) => counted(run.fragments),
      },
      {
        key: "cpu_seconds",
        label: "CPU time",
        title: "Of the classification alone, on one thread",
        value: (run) => run.cpu_seconds ?? null,
        show: (run) => (run.cpu_seconds === undefined ? "–" : duration(run.cpu_seconds)),
      },
      {
        key: "ratio",
        label: "to double",
        title: "CPU time as a ratio to double",
        value: ratio,
        show: (run) => {
          const value = ratio(run);
          return value === null ? "–" : `${rounded(value, 2)}×`;
        },
      },
    ],
  });
  return section(
    "verdicts",
    "Verdicts",
    h("p", { class: "lead" }, summary(certificate)),
    table.element,
  );
}

const measured = (value: number | null | undefined): string =>
  value === null || value === undefined ? "–" : rounded(value);

/** "3 identical, 5 within tolerance, 1 failed." */
export function summary(certificate: Certificate): string {
  const counts = new Map<string, number>();
  for (const run of certificate.runs) {
    const verdict = run.verdict ?? "without an answer";
    counts.set(verdict, (counts.get(verdict) ?? 0) + 1);
  }
  const words = [...counts].map(([verdict, count]) => `${counted(count)} ${verdict}`);
  const first = certificate.runs.find(({ tolerance }) => tolerance !== undefined);
  const limits = first
    ? ` Tolerance ${rounded(first.tolerance ?? 0)} of each polygon, width ${rounded(first.width ?? 0)} scene units.`
    : "";
  return `${plural(certificate.runs.length, "run")}: ${words.join(", ")}.${limits}`;
}

function runDetails(run: Run): Child[] {
  const lines: string[] = [];
  if (run.error) lines.push(`No answer: ${run.error}`);
  if (run.reason) lines.push(sentence(`Why: ${run.reason}`));
  if (run.excess) lines.push(sentence(`Too much: ${run.excess}`));
  const { worst, totals } = run;
  if (worst?.point) {
    const at = worst.point.map((x) => rounded(x, 9)).join(", ");
    lines.push(
      `Worst place: light ${worst.light}, polygon ${worst.polygon} (${worst.side}), at (${at}): ` +
        `${errorInWords(worst)}; ${rounded(widthOf(worst))} wide.`,
    );
  } else if (worst?.text) {
    lines.push(sentence(`Worst place: ${worst.text}`));
  }
  if (totals && totals.regions > 0) {
    lines.push(
      `${plural(totals.regions, "region")} of error; ${counted(totals.invented)} invented and ` +
        `${counted(totals.lost)} lost.`,
    );
  }
  if (run.first_difference) lines.push(sentence(`First difference: ${run.first_difference}`));
  lines.push(...(run.problems ?? []), ...(run.notes ?? []));
  return lines.map((line) => h("p", {}, line));
}

export function errorSection(
  certificate: Certificate,
  show: ((error: RunError) => void) | null,
): HTMLElement | null {
  const errors = certificate.runs.flatMap((run) => errorsOf(run, certificate));
  if (errors.length === 0) return null;
  const table = new Table<RunError>({
    caption: "Places of error, widest first",
    rows: errors.sort((a, b) => widthOf(b.witness) - widthOf(a.witness)),
    ...(show && {
      pick: (error: RunError) => {
        table.select(error);
        show(error);
      },
      pickLabel: (error: RunError) => `Fly to the error of ${error.run} on ${error.polygon}`,
    }),
    pageSize: 12,
    columns: [
      { key: "polygon", label: "polygon", value: ({ polygon }) => polygon },
      { key: "side", label: "side", value: ({ side }) => side },
      { key: "run", label: "run", value: ({ run }) => run, facet: true },
      { key: "light", label: "light", value: ({ light }) => light, facet: true },
      {
        key: "what",
        label: "what",
        value: ({ witness }) =>
          `found ${witness.found ?? "nothing"}, true ${witness.true ?? "nothing"}`,
        facet: true,
      },
      { key: "caster", label: "caster", value: ({ witness }) => witness.caster ?? null },
      {
        key: "width",
        label: "width",
        title: "Of the region, scene units",
        value: ({ witness }) => widthOf(witness),
        show: ({ witness }) => rounded(widthOf(witness)),
      },
      {
        key: "share",
        label: "wrong share",
        title: "Of the side, all its regions together",
        value: ({ wrong }) => wrong.misclassified.fraction[1],
        show: ({ wrong }) => rounded(wrong.misclassified.fraction[1]),
      },
      {
        key: "regions",
        label: "regions",
        value: ({ wrong }) => wrong.regions,
        show: ({ wrong }) => counted(wrong.regions),
      },
    ],
  });
  return section(
    "errors",
    "Errors",
    h("p", { class: "lead" }, show ? "A click on a polygon flies to the place." : ""),
    table.element,
    widthChart(certificate, errors),
  );
}

/** How wide the regions of error are, run by run. */
function widthChart(certificate: Certificate, errors: RunError[]): HTMLElement {
  const data = errors
    .map(({ run, witness }) => ({ run, log: Math.log10(widthOf(witness)) }))
    .filter(({ log }) => Number.isFinite(log));
  const [low, high] = decades(errors.map(({ witness }) => widthOf(witness)));
  const limit = certificate.runs.find(({ width }) => width !== undefined)?.width;
  const runs = [...new Set(data.map(({ run }) => run))];
  const thresholds = Array.from({ length: (high - low) * 4 + 1 }, (_, i) => low + i / 4);
  const bins = {
    x: { value: "log", thresholds },
    fill: "run",
    tip: true,
  };
  const label =
    `Widths of ${plural(data.length, "region")} of error, in scene units` +
    (limit ? `; the dashed line is the tolerance, ${rounded(limit)}` : "") +
    ".";
  return chart({ label, height: 260 }, () => ({
    marginBottom: 40,
    x: { domain: [low, high], label: "width, scene units" },
    y: { grid: true, label: "regions" },
    color: { domain: runs, range: kSeries, legend: true },
    marks: [
      axisX({ tickFormat: (d: number) => `1e${d}`, interval: 1 }),
      rectY(data, binX({ y: "count" }, bins as never)),
      ruleY([0]),
      ...(limit ? [ruleX([Math.log10(limit)], { strokeDasharray: "4 3" })] : []),
    ],
  }));
}

export function decisionSection(certificate: Certificate): HTMLElement | null {
  const explained = certificate.runs.filter((run) => run.first_difference || run.decisions);
  if (explained.length === 0) {
    const failed = certificate.runs.some((run) => run.verdict === "failed");
    return failed
      ? section(
          "decisions",
          "The first decision that differs",
          h("p", { class: "lead" }, "Run the same command with --explain to see it here."),
        )
      : null;
  }
  return section(
    "decisions",
    "The first decision that differs",
    ...explained.map((run) => decisionsOf(run, nameOfRun(run, certificate))),
  );
}

function decisionsOf(run: Run, name: string): HTMLElement {
  const { decisions } = run;
  const box = h("article", { class: "decision" }, h("h3", {}, name));
  if (run.first_difference) box.append(h("p", { class: "first" }, sentence(run.first_difference)));
  if (!decisions || decisions.differing === 0) return box;
  box.append(
    h(
      "p",
      {},
      `${plural(decisions.differing, "decision")} differ, in ${plural(decisions.answers, "answer")}. ` +
        `All together change ${plural(decisions.together.changed_sides, "polygon side")}.`,
    ),
  );
  if (decisions.flipped.length === 0) return box;
  const table = new Table<Flip>({
    caption: "Each decision alone, made as the kernel makes it",
    rows: decisions.flipped,
    pageSize: 10,
    columns: [
      { key: "text", label: "decision", value: (flip) => flip.text },
      { key: "predicate", label: "predicate", value: (flip) => flip.predicate, facet: true },
      { key: "ulps", label: "ulps", value: (flip) => flip.ulps },
      { key: "exact", label: "exact", value: (flip) => flip.exact },
      { key: "kernel", label: "kernel", value: (flip) => flip.kernel },
      {
        key: "changed",
        label: "sides changed",
        value: (flip) => flip.effect.changed_sides,
      },
    ],
  });
  box.append(table.element);
  return box;
}
