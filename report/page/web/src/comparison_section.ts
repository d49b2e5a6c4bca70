// SPDX-License-Identifier: GPL-3.0-or-later
// Systems beside each other, and how their times grow.
import { axisX, axisY, dot, gridX, gridY, line, tip, pointer } from "@observablehq/plot";
import { chart } from "./charts";
import { kSeries, toneOf } from "./colours";
import type { Comparison, ComparisonRow } from "./documents";
import { command, h, section } from "./dom";
import { counted, duration, rounded } from "./numbers";
import { Table, type Column } from "./table";
import { contradictions } from "./tradeoff_section";

export function comparisonSections(comparison: Comparison): HTMLElement[] {
  const sections = [rowSection(comparison), ...growthSections(comparison)];
  if (comparison.contradictions.length > 0) {
    sections.unshift(contradictions(comparison.contradictions));
  }
  return sections;
}

function rowSection(comparison: Comparison): HTMLElement {
  const work = new Set(comparison.rows.flatMap((row) => Object.keys(row.work ?? {})));
  const counters: Column<ComparisonRow>[] = [...work].map((name) => ({
    key: `work-${name}`,
    label: name,
    title: "What the system counts",
    value: (row) => row.work?.[name] ?? null,
    show: (row) => (row.work?.[name] === undefined ? "–" : rounded(row.work[name] ?? 0, 4)),
  }));
  const verdict = (row: ComparisonRow): string =>
    row.verdict ?? (row.end === "measured" ? "not judged" : row.end);
  const table = new Table<ComparisonRow>({
    caption: "System by kernel by scene",
    rows: comparison.rows,
    details: (row) => [
      row.why && h("p", {}, row.why),
      row.breaks && h("p", {}, row.breaks),
      row.checksum && h("p", {}, "Answer ", h("code", {}, row.checksum)),
      h("p", {}, command(row.command)),
    ],
    columns: [
      { key: "scene", label: "scene", value: (row) => row.scene, facet: true },
      {
        key: "polygons",
        label: "polygons",
        value: (row) => row.polygons,
        show: (row) => counted(row.polygons),
      },
      { key: "system", label: "system", value: (row) => row.system, facet: true },
      { key: "kernel", label: "kernel", value: (row) => row.kernel, facet: true },
      {
        key: "verdict",
        label: "verdict",
        value: verdict,
        tone: (row) => toneOf(verdict(row)),
        facet: true,
      },
      {
        key: "wrong",
        label: "wrong",
        title: "Share of the area that is misclassified",
        value: (row) => row.wrong ?? null,
        show: (row) => (row.wrong === undefined ? "–" : rounded(row.wrong)),
      },
      {
        key: "fragments",
        label: "fragments",
        value: (row) => row.fragments ?? null,
        show: (row) => (row.fragments === undefined ? "–" : counted(row.fragments)),
      },
      {
        key: "cpu_seconds",
        label: "CPU time",
        value: (row) => row.cpu_seconds ?? null,
        show: (row) => (row.cpu_seconds === undefined ? "–" : duration(row.cpu_seconds)),
      },
      {
        key: "ratio",
        label: "to reference",
        title: "To svbsp, or of area lights receiver, on doubles",
        value: (row) => row.ratio ?? null,
        show: (row) => (typeof row.ratio === "number" ? `${rounded(row.ratio)}×` : "–"),
      },
      {
        key: "peak_bytes",
        label: "MB",
        value: (row) => row.peak_bytes ?? null,
        show: (row) =>
          row.peak_bytes === undefined ? "–" : counted(Math.round(row.peak_bytes / 2 ** 20)),
      },
      ...counters,
    ],
  });
  return section("rows", "Systems", table.element);
}

const kDashes = [
  { name: "solid", dash: "" },
  { name: "dashed", dash: "7 4" },
  { name: "dotted", dash: "2 3" },
  { name: "dash-dotted", dash: "7 3 2 3" },
];

interface Measured {
  system: string;
  kernel: string;
  polygons: number;
  time: number;
  label: string;
}

function growthSections(comparison: Comparison): HTMLElement[] {
  type Growth = NonNullable<Comparison["growth"]>[number];
  const growth = comparison.growth ?? [];
  if (growth.length === 0) return [];
  const scenes = [...new Set(growth.map(({ scene }) => scene))];
  return scenes.map((scene, i) => {
    const own = growth.filter((each) => each.scene === scene);
    const measured: Measured[] = comparison.rows
      .filter((row) => row.scene === scene && row.cpu_seconds)
      .map((row) => ({
        system: row.system,
        kernel: row.kernel,
        polygons: row.polygons,
        time: (row.cpu_seconds ?? 0) * 1e3,
        label: `${row.system} on ${row.kernel}\n${counted(row.polygons)} polygons, ${duration(row.cpu_seconds ?? 0)}`,
      }));
    const systems = [...new Set(measured.map(({ system }) => system))];
    const kernels = [...new Set(measured.map(({ kernel }) => kernel))];
    const dashes = kernels.map(
      (kernel, k) => `${kernel} ${kDashes[k % kDashes.length]?.name ?? ""}`,
    );
    const table = new Table<Growth>({
      caption: "Time grows as the polygons to this power",
      rows: own,
      columns: [
        { key: "system", label: "system", value: (row) => row.system, facet: true },
        { key: "kernel", label: "kernel", value: (row) => row.kernel, facet: true },
        {
          key: "exponent",
          label: "exponent",
          value: (row) => row.exponent,
          show: (row) => rounded(row.exponent),
        },
        { key: "sizes", label: "sizes", value: (row) => row.sizes },
      ],
    });
    const label =
      `Scene ${scene}: polygons to the right, CPU time upwards, both logarithmic. ` +
      `A colour a system; lines of ${dashes.join(", of ")}.`;
    return section(
      `growth-${i + 1}`,
      `Growth: ${scene}`,
      chart({ label, height: 380 }, () => ({
        marginLeft: 60,
        marginBottom: 40,
        x: { type: "log", label: "polygons" },
        y: { type: "log", label: "CPU time, ms" },
        color: { domain: systems, range: kSeries, legend: true },
        marks: [
          gridX({ ticks: 5 }),
          gridY({ ticks: 6 }),
          axisX({ ticks: 5, tickFormat: "~s" }),
          axisY({ ticks: 6, tickFormat: "~g" }),
          ...kernels.map((kernel, k) =>
            line(
              measured.filter((each) => each.kernel === kernel),
              {
                x: "polygons",
                y: "time",
                stroke: "system",
                sort: "polygons",
                strokeDasharray: kDashes[k % kDashes.length]?.dash ?? "",
              },
            ),
          ),
          dot(measured, { x: "polygons", y: "time", fill: "system", r: 3.5 }),
          tip(measured, pointer({ x: "polygons", y: "time", title: "label" })),
        ],
      })),
      table.element,
    );
  });
}
