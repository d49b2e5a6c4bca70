// SPDX-License-Identifier: GPL-3.0-or-later
import assert from "node:assert/strict";
import { test } from "node:test";
import type { View } from "../src/documents";
import {
  areaVector,
  castersOf,
  focusOf,
  kNone,
  readFragments,
  readParts,
  shapeOfTriangle,
  shapesOf,
} from "../src/view_data";

const text = (numbers: Uint8Array | Uint32Array | Float32Array): string =>
  Buffer.from(numbers.buffer).toString("base64");
const f32 = (...numbers: number[]): string => text(Float32Array.from(numbers));
const u32 = (...numbers: number[]): string => text(Uint32Array.from(numbers));
const u8 = (...numbers: number[]): string => text(Uint8Array.from(numbers));

const kSquare = [0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0];

/** The signed area of a shape's triangles along z. */
function areaOf(points: Float32Array, triangles: Uint32Array): number {
  let area = 0;
  for (let i = 0; i < triangles.length; i += 3) {
    const corners = [0, 1, 2].map((k) => (triangles[i + k] ?? 0) * 3);
    const flat = Float32Array.from(corners.flatMap((at) => [...points.subarray(at, at + 3)]));
    area += areaVector(flat, 0, 3)[2] / 2;
  }
  return area;
}

test("a convex loop is a fan, turned to the side that it is of", () => {
  const points = Float32Array.from(kSquare);
  const rings = Uint32Array.from([8]);
  const up = shapesOf(points, rings, () => [0, 0, 1]);
  assert.equal(up.triangles.length, 6);
  assert.equal(areaOf(points, up.triangles), 1);
  const down = shapesOf(points, rings, () => [0, 0, -1]);
  assert.equal(areaOf(points, down.triangles), -1);
});

test("a loop that is not convex keeps its area", () => {
  // An L of area 3.
  const points = Float32Array.from([0, 0, 0, 2, 0, 0, 2, 1, 0, 1, 1, 0, 1, 2, 0, 0, 2, 0]);
  const shapes = shapesOf(points, Uint32Array.from([12]), () => [0, 0, 1]);
  assert.equal(areaOf(points, shapes.triangles), 3);
});

test("a hole is cut out, whichever plane and turn it has", () => {
  const outer = [0, 0, 4, 0, 4, 4, 0, 4];
  const hole = [1, 1, 3, 1, 3, 3, 1, 3];
  for (const swap of [false, true]) {
    const flat = [...outer, ...hole];
    const points = new Float32Array(24);
    for (let i = 0; i < 8; i += 1) {
      const [x = 0, y = 0] = flat.slice(i * 2, i * 2 + 2);
      points.set(swap ? [y, x, 0] : [x, y, 0], i * 3);
    }
    const shapes = shapesOf(points, Uint32Array.from([8, 9]), () => [0, 0, 1]);
    assert.equal(areaOf(points, shapes.triangles), 12);
  }
});

const view: View = {
  format: "gnomon-view",
  states: ["lit", "shadow", "penumbra", "umbra"],
  centre: [0, 0, 0],
  radius: 1,
  polygons: ["floor", "table"],
  lights: [],
  // The floor in two parts.
  parts: {
    polygon: u32(0, 0, 1),
    rings: u32(6, 6, 8),
    points: f32(
      ...[0, 0, 0, 1, 0, 0, 1, 1, 0],
      ...[0, 0, 0, 1, 1, 0, 0, 1, 0],
      ...kSquare.map((x, i) => (i % 3 === 2 ? 1 : x)),
    ),
  },
  layers: [
    {
      run: "exact",
      light: "sun",
      fragments: 3,
      polygon: u32(0, 0, 1),
      side: u8(0, 0, 1),
      state: u8(0, 1, 1),
      caster: u32(kNone, 1, kNone),
      rings: u32(6, 6, 8),
      points: f32(
        ...[0, 0, 0, 1, 0, 0, 1, 1, 0],
        ...[0, 0, 0, 1, 1, 0, 0, 1, 0],
        ...kSquare.map((x, i) => (i % 3 === 2 ? 1 : x)),
      ),
    },
    { run: "double", light: "sun", left_out: "too much" },
  ],
};

test("what two parts of a polygon share is no border", () => {
  const parts = readParts(view);
  assert.equal(parts.borders.length, (4 + 4) * 6);
  assert.deepEqual([...parts.normals], [0, 0, 1, 0, 0, 1]);
});

test("fragments are read when they are asked for, and turned to their side", () => {
  const parts = readParts(view);
  const [exact, missing] = view.layers;
  assert.ok(exact && missing);
  const fragments = readFragments(exact, parts, view.radius);
  assert.ok(fragments);
  assert.equal(shapeOfTriangle(fragments, 0), 0);
  assert.equal(shapeOfTriangle(fragments, 1), 1);
  assert.equal(shapeOfTriangle(fragments, 3), 2);
  assert.equal(areaOf(fragments.points, fragments.triangles.subarray(6)), -1);
  assert.deepEqual(castersOf(fragments, 0), [[1, 1]]);
  assert.deepEqual(castersOf(fragments, 1), []);
  assert.equal(readFragments(missing, parts, view.radius), null);
});

test("a large ground does not make the first view small", () => {
  const house = Array.from({ length: 100 }, (_, i) => [5 + (i % 10) * 0.1, 5 + i * 0.01, i % 3]);
  const points = Float32Array.from([-50, -50, 0, 50, -50, 0, 50, 50, 0, ...house.flat()]);
  const focus = focusOf({ points } as never, 70);
  assert.ok(focus.radius < 12);
  assert.ok(Math.abs(focus.centre[0] - 5.45) < 0.5);
});
