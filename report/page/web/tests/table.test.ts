// SPDX-License-Identifier: GPL-3.0-or-later
import assert from "node:assert/strict";
import { test } from "node:test";
import { compareCells, hasWords, sortedRows, type Column } from "../src/table";

interface Row {
  name: string;
  size: number | null;
}

const name: Column<Row> = { key: "name", label: "name", value: (row) => row.name };
const size: Column<Row> = { key: "size", label: "size", value: (row) => row.size };
const rows: Row[] = [
  { name: "b10", size: 2 },
  { name: "b9", size: null },
  { name: "a", size: 10 },
  { name: "c", size: 2 },
];
const names = (of: Row[]): string => of.map((row) => row.name).join(" ");

test("numbers sort as numbers, nothing comes last either way, equals keep their order", () => {
  assert.equal(names(sortedRows(rows, size, false)), "b10 c a b9");
  assert.equal(names(sortedRows(rows, size, true)), "a b10 c b9");
});

test("texts sort as people sort them", () => {
  assert.equal(names(sortedRows(rows, name, false)), "a b9 b10 c");
  assert.equal(compareCells("x2", "x10") < 0, true);
  assert.equal(compareCells(null, null), 0);
});

test("a filter wants all words, in any column", () => {
  const found = (text: string): string =>
    names(rows.filter((row) => hasWords(row, [name, size], text.split(" ").filter(Boolean))));
  assert.equal(found(""), "b10 b9 a c");
  assert.equal(found("b"), "b10 b9");
  assert.equal(found("b 2"), "b10");
  assert.equal(found("nothing"), "");
});
