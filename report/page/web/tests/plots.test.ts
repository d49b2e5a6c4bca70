// SPDX-License-Identifier: GPL-3.0-or-later
import assert from "node:assert/strict";
import { test } from "node:test";
import { decades } from "../src/charts";
import { litColour, toneOf } from "../src/colours";
import type { Certificate, TradeoffRow } from "../src/documents";
import { errorsOf, nameOfRun, wrongShare } from "../src/runs";
import { errorOf, groupsOf, isPlotted } from "../src/tradeoff_section";

test("decades hold all values, and zero none", () => {
  assert.deepEqual(decades([0, 2e-14, 3e-6]), [-14, -5]);
  assert.deepEqual(decades([1]), [0, 1]);
  assert.deepEqual(decades([0]), [-1, 0]);
});

test("verdicts have tones", () => {
  assert.equal(toneOf("identical"), "good");
  assert.equal(toneOf("within tolerance"), "fine");
  assert.equal(toneOf("failed"), "bad");
  assert.equal(toneOf("crashed"), "bad");
  assert.equal(toneOf(undefined), "none");
  assert.deepEqual(litColour(1), [253, 231, 150]);
});

const certificate = {
  facing_area: 10,
  runs: [
    { kernel: "double", algorithm: "sectors" },
    {
      kernel: "double",
      algorithm: "svbsp",
      totals: { misclassified: [0.9, 1] },
      wrong: [
        { light: "sun", polygon: "a", side: "front", worst: { point: [0, 0, 0], width: [1, 2] } },
        { light: "sun", polygon: "b", side: "front", worst: { point: [0, 0, 0], width: [3, 4] } },
        { light: "sun", polygon: "c", side: "front", worst: { text: "no place" } },
      ],
    },
    { kernel: "plane", algorithm: "svbsp" },
  ],
} as unknown as Certificate;

test("runs are called as the command calls them, and errors are widest first", () => {
  const [, svbsp, plane] = certificate.runs;
  assert.ok(svbsp && plane);
  assert.equal(nameOfRun(svbsp, certificate), "double/svbsp");
  assert.equal(nameOfRun(plane, certificate), "plane");
  assert.deepEqual(
    errorsOf(svbsp, certificate).map(({ polygon }) => polygon),
    ["b", "a"],
  );
  assert.equal(wrongShare(svbsp, certificate), 0.1);
  assert.equal(wrongShare(plane, certificate), null);
});

test("only what was measured and judged is plotted; identical is zero", () => {
  const row = { scene: "s", lights: "area", polygons: 3, cpu_seconds: 1 } as TradeoffRow;
  assert.equal(isPlotted(row), false);
  assert.equal(isPlotted({ ...row, worst_share: 0.5 }), true);
  assert.equal(errorOf({ ...row, worst_share: 1e-300, verdict: "identical" }), 0);
  assert.deepEqual([...groupsOf([row]).keys()], ["s (area lights), 3 polygons"]);
});
