// SPDX-License-Identifier: GPL-3.0-or-later
// The corpus: a matrix of kinds or files by subjects.
import type { Corpus } from "./documents";
import { h, section } from "./dom";
import { plural } from "./numbers";
import { Table, type Column } from "./table";

type File = Corpus["files"][number];

/** What is recorded and not scored is no failure. */
export function isScored(file: File, exact: boolean): boolean {
  return exact || file.expected !== "inform";
}

const kLetters: Record<string, string> = {
  pass: "✓",
  differ: "differ",
  rejected: "rejected",
  crash: "crash",
  timeout: "timeout",
};

export function corpusSections(corpus: Corpus): HTMLElement[] {
  const subjects = new Table<Corpus["subjects"][number]>({
    caption: "Subjects, one row each",
    rows: corpus.subjects,
    columns: [
      { key: "name", label: "subject", value: ({ name }) => name },
      { key: "exact", label: "exact", value: ({ exact }) => (exact ? "yes" : "no"), facet: true },
      {
        key: "failures",
        label: "failures",
        value: ({ failures }) => failures,
        tone: ({ failures }) => (failures > 0 ? "bad" : "good"),
        show: ({ failures }) => String(failures),
      },
    ],
  });
  const columns: Column<File>[] = corpus.subjects.map(({ name, exact }) => ({
    key: `subject-${name}`,
    label: name,
    value: (file) => file.outcomes[name] ?? null,
    show: (file) => kLetters[file.outcomes[name] ?? ""] ?? "–",
    tone: (file) => {
      const outcome = file.outcomes[name];
      if (outcome === "pass") return "good";
      if (outcome === undefined || outcome === "not asked") return "none";
      return isScored(file, exact) ? "bad" : "fine";
    },
  }));
  const matrix = new Table<File>({
    caption: "Files by subjects",
    rows: corpus.files,
    details: (file) => [
      file.oracle ? h("p", { class: "note" }, `The oracle: ${file.oracle}`) : null,
      ...Object.entries(file.reasons).map(([name, why]) =>
        h("p", {}, h("b", {}, name), `: ${why}`),
      ),
    ],
    columns: [
      { key: "name", label: "file", value: ({ name }) => name },
      { key: "kind", label: "kind", value: ({ kind }) => kind, facet: true },
      { key: "expected", label: "expected", value: ({ expected }) => expected, facet: true },
      ...columns,
    ],
  });
  return [
    section(
      "subjects",
      "Kernels and programs",
      h(
        "p",
        { class: "lead" },
        `${plural(corpus.files.length, "file")}, ${plural(corpus.subjects.length, "subject")}, ` +
          `tolerance ${corpus.tolerance}.`,
      ),
      subjects.element,
    ),
    section(
      "matrix",
      "The matrix",
      h("p", { class: "lead" }, "Blue: recorded, and not scored. Red: it must pass."),
      matrix.element,
    ),
  ];
}
