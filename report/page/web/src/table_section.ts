// SPDX-License-Identifier: GPL-3.0-or-later
// Tables of shares that energy engines wrote, judged surface by surface.
import type { Tables } from "./documents";
import { h, section } from "./dom";
import { counted, rounded } from "./numbers";
import { Table } from "./table";

type Run = Tables["runs"][number];

export function tableSections(tables: Tables): HTMLElement[] {
  return tables.runs.map((run, i) => runSection(run, `table-${i + 1}`));
}

function runSection(run: Run, id: string): HTMLElement {
  const surfaces = new Table<Run["surfaces"][number]>({
    caption: "Surfaces, one row each",
    rows: run.surfaces,
    sortBy: { key: "wrong", descending: true },
    columns: [
      {
        key: "polygon",
        label: "surface",
        value: (row) => row.polygon + (row.gross ? " (whole wall)" : ""),
      },
      { key: "side", label: "side", value: (row) => row.side, facet: true },
      {
        key: "wrong",
        label: "wrong values",
        value: (row) => row.wrong.all,
        show: (row) => counted(row.wrong.all),
        tone: (row) => (row.wrong.all > 0 ? "bad" : "good"),
      },
      { key: "night", label: "of them at night", value: (row) => row.wrong.night },
      { key: "range", label: "no share", value: (row) => row.wrong.range },
    ],
  });
  const worst = new Table<Run["worst"][number]>({
    caption: "Values that are furthest off",
    rows: run.worst,
    details: (row) =>
      (row.casters ?? []).map(({ polygon, share }) =>
        h("p", {}, `${polygon} hides ${rounded(share)} of it`),
      ),
    columns: [
      { key: "polygon", label: "surface", value: (row) => row.polygon },
      { key: "time", label: "time", value: (row) => row.time },
      { key: "found", label: "found", value: (row) => row.found, show: (row) => row.found_text },
      { key: "true", label: "true", value: (row) => row.true, show: (row) => rounded(row.true, 6) },
      {
        key: "off",
        label: "off by",
        value: (row) => row.off,
        show: (row) => rounded(row.off ?? 0),
      },
      { key: "error", label: "error", value: (row) => row.error, facet: true },
    ],
  });
  const verdict = h(
    "span",
    { class: `tone ${run.verdict === "failed" ? "bad" : "fine"}` },
    run.verdict,
  );
  return section(
    id,
    run.candidate,
    h(
      "p",
      { class: "lead" },
      verdict,
      ` ${counted(run.told_shares)} values, ${counted(run.wrong.all)} of them wrong.`,
    ),
    surfaces.element,
    run.worst.length > 0 && h("h3", {}, "Furthest off"),
    run.worst.length > 0 && worst.element,
  );
}
