// SPDX-License-Identifier: GPL-3.0-or-later
import assert from "node:assert/strict";
import { test } from "node:test";
import type { Year } from "../src/documents";
import { clock, polygonOfSide, YearData } from "../src/year_data";

const lit = Uint16Array.from({ length: 48 * 2 }, (_, i) => (i === (24 + 12) * 2 + 1 ? 2500 : 0));
const suns = Int32Array.from({ length: 48 * 3 }, (_, i) => (i % 72 === 36 + 2 ? 1e6 : 0));
const year: Year = {
  format: "gnomon-year",
  scene: "house",
  geometry: "sha256:0",
  kernel: "plane",
  latitude: 50,
  longitude: 8,
  zone_minutes: 60,
  first: "2025-02-28",
  step_minutes: 60,
  rows: 48,
  sides: ["wall", "wall#back"],
  suns: Buffer.from(suns.buffer).toString("base64"),
  units: 10000,
  lit: Buffer.from(lit.buffer).toString("base64"),
  hours: [],
  daylight: [],
};

test("rows are days of hours", () => {
  const data = new YearData(year);
  assert.equal(data.days, 2);
  assert.equal(data.stepsOfDay, 24);
  assert.equal(data.share(36, 1), 0.25);
  assert.equal(data.share(36, 0), 0);
  assert.equal(data.share(48, 0), null);
  assert.equal(data.timeText(36), "1 March, 12:00 to 13:00");
  assert.equal(data.rowAt(1, 12 * 60 + 59), 36);
});

test("nights are empty", () => {
  const data = new YearData(year);
  const heat = data.heat(1);
  assert.equal(heat[36], 0.25);
  assert.ok(Number.isNaN(heat[0] ?? 0));
  assert.equal(data.sun(0), null);
  assert.deepEqual(data.sun(12), [0, 0, 1]);
});

test("names of sides", () => {
  assert.deepEqual(polygonOfSide("wall#back"), { polygon: "wall", kind: "back" });
  assert.deepEqual(polygonOfSide("wall"), { polygon: "wall", kind: "front" });
  assert.equal(clock(90), "01:30");
});
