// SPDX-License-Identifier: GPL-3.0-or-later
// Speed against accuracy: time to the right, error upwards, the front drawn.
import { axisX, axisY, dot, gridX, line, text, tip, pointer } from "@observablehq/plot";
import { chart, decades } from "./charts";
import { kSeries, toneOf } from "./colours";
import type { Tradeoff, TradeoffRow } from "./documents";
import { command, h, section, type Child } from "./dom";
import { counted, duration, plural, rounded } from "./numbers";
import { Table } from "./table";

/** Rows of one scene, lights and size, which are on one plot. */
export function groupsOf(rows: TradeoffRow[]): Map<string, TradeoffRow[]> {
  const groups = new Map<string, TradeoffRow[]>();
  for (const row of rows) {
    const lights = row.lights === "area" ? " (area lights)" : "";
    const scene = row.scene.slice(row.scene.lastIndexOf("/") + 1);
    const name = `${scene}${lights}, ${plural(row.polygons, "polygon")}`;
    groups.set(name, [...(groups.get(name) ?? []), row]);
  }
  return groups;
}

/** What is measured and judged, and so has a place on the plot. */
export function isPlotted(row: TradeoffRow): boolean {
  return row.cpu_seconds !== undefined && row.cpu_seconds > 0 && row.worst_share !== undefined;
}

export function errorOf(row: TradeoffRow): number {
  return row.verdict === "identical" ? 0 : (row.worst_share ?? 0);
}

/** "0", "1e-6": a thickness. */
export const powerText = (value: number): string =>
  value === 0 ? "0" : value.toExponential().replace("e+", "e");

export function nameOf(row: TradeoffRow): string {
  const thickness = row.thickness === null ? "" : `, thickness ${powerText(row.thickness)}`;
  return `${row.kernel}/${row.system}${thickness}`;
}

export function tradeoffSections(tradeoff: Tradeoff): HTMLElement[] {
  const sections = [...groupsOf(tradeoff.rows)].map(([name, rows], i) =>
    frontSection(`front-${i + 1}`, name, rows),
  );
  sections.push(rowSection(tradeoff));
  if (tradeoff.thickness.some(({ tried }) => tried > 1)) sections.push(thicknessSection(tradeoff));
  if (tradeoff.contradictions.length > 0) sections.unshift(contradictions(tradeoff.contradictions));
  return sections;
}

export function contradictions(texts: string[]): HTMLElement {
  return section(
    "contradictions",
    "A bug of Gnomon",
    ...texts.map((text) => h("p", { class: "note" }, text)),
  );
}

function frontSection(id: string, name: string, rows: TradeoffRow[]): HTMLElement {
  const plotted = rows.filter(isPlotted);
  const chosen = h("div", { class: "chosen", "aria-live": "polite" });
  if (plotted.length === 0) {
    return section(id, name, h("p", {}, "Nothing here was both measured and judged."));
  }
  const show = (row: TradeoffRow): void => chosen.replaceChildren(...rowCard(row));
  const front = plotted.filter(({ on_front }) => on_front);
  const figure = frontChart(plotted, show);
  const buttons = front.map((row) =>
    h(
      "li",
      {},
      h("button", { type: "button", class: "link", onclick: () => show(row) }, nameOf(row)),
    ),
  );
  return section(
    id,
    `${name}`,
    h(
      "p",
      { class: "lead" },
      `${plural(plotted.length, "run")}, ${plural(front.length, "of them is", "of them are")} on the front: ` +
        "nothing is both as fast and as accurate, and better in one of the two.",
    ),
    figure,
    h("h3", {}, "On the front"),
    h("ul", { class: "front" }, ...buttons),
    chosen,
  );
}

interface Placed {
  row: TradeoffRow;
  time: number;
  error: number;
  front: boolean;
  kernel: string;
  label: string;
}

function frontChart(rows: TradeoffRow[], show: (row: TradeoffRow) => void): HTMLElement {
  const [low, high] = decades(rows.map(errorOf));
  const zero = low - 1.5;
  const placed: Placed[] = rows.map((row) => {
    const error = errorOf(row);
    return {
      row,
      time: (row.cpu_seconds ?? 0) * 1e3,
      error: error > 0 ? Math.log10(error) : zero,
      front: row.on_front,
      kernel: row.kernel,
      label: `${nameOf(row)}\n${duration(row.cpu_seconds ?? 0)}, worst share ${rounded(error)}\n${row.verdict ?? ""}`,
    };
  });
  const front = placed.filter((place) => place.front).sort((a, b) => a.time - b.time);
  const kernels = [...new Set(rows.map(({ kernel }) => kernel))];
  const ticks = [zero];
  for (let k = low; k <= high; k += Math.max(1, Math.round((high - low) / 8))) ticks.push(k);
  const label =
    "Time to the right, greatest wrong share of a polygon upwards, both logarithmic; " +
    "the front is drawn through, what is dominated is grey. A click shows the command.";
  return chart(
    { label, height: 400, onclick: (value) => show((value as Placed).row) },
    (width) => ({
      marginLeft: 60,
      marginBottom: 40,
      marginRight: 30,
      x: { type: "log", label: "CPU time, ms" },
      y: { domain: [zero - 0.4, high], label: "worst share" },
      color: { domain: kernels, range: kSeries, legend: true },
      marks: [
        gridX({ ticks: 6 }),
        axisX({ ticks: 6, tickFormat: "~g" }),
        axisY(ticks, { tickFormat: (k: number) => (k === zero ? "0" : `1e${k}`) }),
        line(front, { x: "time", y: "error", curve: "step-after", strokeOpacity: 0.5 }),
        dot(
          placed.filter((place) => !place.front),
          { x: "time", y: "error", fill: "#8b93a1", fillOpacity: 0.55, r: 3.5 },
        ),
        dot(front, { x: "time", y: "error", fill: "kernel", r: 6, stroke: "currentColor" }),
        text(labelled(front, width), {
          x: "time",
          y: "error",
          text: (place: Placed) => nameOf(place.row),
          dy: -12,
          dx: 6,
          textAnchor: "start",
          lineAnchor: "bottom",
        }),
        tip(placed, pointer({ x: "time", y: "error", title: "label" })),
      ],
    }),
  );
}

/** Labels that would lie on each other are left out: the buttons below name all. */
function labelled(front: Placed[], width: number): Placed[] {
  if (width < 600) return [];
  const kept: Placed[] = [];
  for (const place of front) {
    const close = kept.some(
      (other) =>
        Math.abs(other.error - place.error) < 0.6 &&
        Math.abs(Math.log10(other.time / place.time)) < 0.6,
    );
    if (!close) kept.push(place);
  }
  return kept;
}

function rowCard(row: TradeoffRow): Child[] & Node[] {
  return [
    h("h3", {}, nameOf(row)),
    h(
      "p",
      {},
      `${duration(row.cpu_seconds ?? 0)}, worst share ${rounded(errorOf(row))}, ${row.verdict ?? row.end}` +
        (row.breaks ? `; ${row.breaks}` : ""),
    ),
    h("p", {}, command(row.command)),
  ] as Child[] & Node[];
}

function rowSection(tradeoff: Tradeoff): HTMLElement {
  const changes = tradeoff.rows.some(({ change }) => change !== undefined);
  const table = new Table<TradeoffRow>({
    caption: "All runs",
    rows: tradeoff.rows,
    details: (row) => [
      row.why && h("p", {}, row.why),
      row.breaks && h("p", {}, row.breaks),
      h("p", {}, command(row.command)),
    ],
    columns: [
      { key: "scene", label: "scene", value: (row) => row.scene, facet: true },
      { key: "lights", label: "lights", value: (row) => row.lights, facet: true },
      { key: "system", label: "system", value: (row) => row.system, facet: true },
      { key: "kernel", label: "kernel", value: (row) => row.kernel, facet: true },
      {
        key: "thickness",
        label: "thickness",
        value: (row) => row.thickness,
        show: (row) => (row.thickness === null ? "–" : powerText(row.thickness)),
      },
      ...(changes
        ? [
            { key: "change", label: "change", value: (row: TradeoffRow) => row.change ?? null },
            {
              key: "differ",
              label: "sides that differ",
              value: (row: TradeoffRow) => row.sides_that_differ ?? null,
            },
          ]
        : []),
      {
        key: "verdict",
        label: "verdict",
        value: (row) => row.verdict ?? (row.end === "measured" ? "not judged" : row.end),
        tone: (row) => toneOf(row.verdict ?? (row.end === "measured" ? "not judged" : row.end)),
        facet: true,
      },
      {
        key: "worst_share",
        label: "worst share",
        value: (row) => row.worst_share ?? null,
        show: (row) => (row.worst_share === undefined ? "–" : rounded(row.worst_share)),
      },
      {
        key: "cpu_seconds",
        label: "CPU time",
        value: (row) => row.cpu_seconds ?? null,
        show: (row) => (row.cpu_seconds === undefined ? "–" : duration(row.cpu_seconds)),
      },
      {
        key: "peak_bytes",
        label: "MB",
        value: (row) => row.peak_bytes ?? null,
        show: (row) =>
          row.peak_bytes === undefined ? "–" : counted(Math.round(row.peak_bytes / 2 ** 20)),
      },
      {
        key: "fragments",
        label: "fragments",
        value: (row) => row.fragments ?? null,
        show: (row) => (row.fragments === undefined ? "–" : counted(row.fragments)),
      },
      { key: "front", label: "front", value: (row) => (row.on_front ? "yes" : "no"), facet: true },
    ],
  });
  return section("rows", "All runs", table.element);
}

function thicknessSection(tradeoff: Tradeoff): HTMLElement {
  type Row = Tradeoff["thickness"][number];
  const table = new Table<Row>({
    caption: "With which thicknesses a kernel is right",
    rows: tradeoff.thickness.filter(({ tried }) => tried > 1),
    columns: [
      { key: "scene", label: "scene", value: (row) => row.scene },
      { key: "system", label: "system", value: (row) => row.system, facet: true },
      { key: "kernel", label: "kernel", value: (row) => row.kernel, facet: true },
      { key: "tried", label: "tried", value: (row) => row.tried },
      {
        key: "right",
        label: "right with",
        value: (row) =>
          row.right
            .map(([from, to]) =>
              from === to ? powerText(from) : `${powerText(from)} to ${powerText(to)}`,
            )
            .join(", ") || (row.judged === 0 ? "not judged" : "none"),
      },
    ],
  });
  return section("thickness", "Thicknesses", table.element);
}
