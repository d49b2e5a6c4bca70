// SPDX-License-Identifier: GPL-3.0-or-later
// From the loops of a view to the buffers that are drawn: one for all fragments of a layer, made
// when the layer is first shown.
import { ShapeUtils, Vector2 } from "three";
import { readFloat32, readUint32, readUint8 } from "./base64";
import type { View, ViewLayer } from "./documents";

/** No caster, no polygon. */
export const kNone = 0xffffffff;
/** The share of points at either end of an axis that the first view may leave out. */
const kLeftOut = 0.05;
/** Of so few, all are looked at. */
const kFewPoints = 60;

export interface Shapes {
  /** Three numbers a point, about the centre of the scene. */
  points: Float32Array;
  /** Three points a triangle, counter-clockwise seen from the side that it is of. */
  triangles: Uint32Array;
  /** Of shape i: from firstTriangle[i] on; one more than there are shapes. */
  firstTriangle: Uint32Array;
  firstPoint: Uint32Array;
}

export interface Parts extends Shapes {
  polygon: Uint32Array;
  /** Two points a border of a polygon. */
  borders: Float32Array;
  /** Unit normals of the fronts of polygons; zero of one that was dropped. */
  normals: Float32Array;
}

export interface Fragments extends Shapes {
  polygon: Uint32Array;
  side: Uint8Array;
  state: Uint8Array;
  caster: Uint32Array;
}

type Vector = [number, number, number];

function pointAt(points: Float32Array, index: number): Vector {
  return [points[index * 3] ?? 0, points[index * 3 + 1] ?? 0, points[index * 3 + 2] ?? 0];
}

/** The area vector of a ring: twice the area, to the side from which it runs counter-clockwise. */
export function areaVector(points: Float32Array, first: number, count: number): Vector {
  // Half a million times a page: no arrays are made on the way.
  const p = points as unknown as number[];
  const o = first * 3;
  const [ox, oy, oz] = [p[o]!, p[o + 1]!, p[o + 2]!];
  let x = 0;
  let y = 0;
  let z = 0;
  for (let i = 1; i + 1 < count; i += 1) {
    const a = o + i * 3;
    const ux = p[a]! - ox;
    const uy = p[a + 1]! - oy;
    const uz = p[a + 2]! - oz;
    const vx = p[a + 3]! - ox;
    const vy = p[a + 4]! - oy;
    const vz = p[a + 5]! - oz;
    x += uy * vz - uz * vy;
    y += uz * vx - ux * vz;
    z += ux * vy - uy * vx;
  }
  return [x, y, z];
}

/** Does a ring turn one way at every corner? What rounding bends by a hair is convex enough. */
function isConvex(points: Float32Array, first: number, count: number, normal: Vector): boolean {
  if (count <= 3) return true;
  const p = points as unknown as number[];
  const [nx, ny, nz] = normal;
  const least = -1e-5 * (nx * nx + ny * ny + nz * nz);
  for (let i = 0; i < count; i += 1) {
    const a = (first + i) * 3;
    const b = (first + ((i + 1) % count)) * 3;
    const c = (first + ((i + 2) % count)) * 3;
    const ux = p[b]! - p[a]!;
    const uy = p[b + 1]! - p[a + 1]!;
    const uz = p[b + 2]! - p[a + 2]!;
    const vx = p[c]! - p[b]!;
    const vy = p[c + 1]! - p[b + 1]!;
    const vz = p[c + 2]! - p[b + 2]!;
    const turn = (uy * vz - uz * vy) * nx + (uz * vx - ux * vz) * ny + (ux * vy - uy * vx) * nz;
    if (turn < least) return false;
  }
  return true;
}

/** The points of rings in the plane of the two axes that see most of them. */
function flattened(points: Float32Array, first: number, count: number, normal: Vector): Vector2[] {
  const sizes = normal.map(Math.abs) as Vector;
  const drop = sizes.indexOf(Math.max(...sizes));
  const [u, v] = drop === 0 ? [1, 2] : drop === 1 ? [2, 0] : [0, 1];
  const flat: Vector2[] = [];
  for (let i = first; i < first + count; i += 1) {
    flat.push(new Vector2(points[i * 3 + u], points[i * 3 + v]));
  }
  return flat;
}

/** Gathers triangles without knowing how many there will be. */
class Triangles {
  private data: Uint32Array;
  size = 0;

  constructor(expected: number) {
    this.data = new Uint32Array(Math.max(3, expected));
  }
  push(a: number, b: number, c: number): void {
    if (this.size + 3 > this.data.length) {
      const larger = new Uint32Array(this.data.length * 2);
      larger.set(this.data);
      this.data = larger;
    }
    this.data[this.size] = a;
    this.data[this.size + 1] = b;
    this.data[this.size + 2] = c;
    this.size += 3;
  }
  taken(): Uint32Array {
    return this.data.subarray(0, this.size);
  }
}

/**
 * Shapes of rings: a ring's number of points times two, plus one for a hole of the shape before.
 * `towards` has the direction that a shape is to be seen from, if there is one.
 */
export function shapesOf(
  points: Float32Array,
  rings: Uint32Array,
  towards: (shape: number) => Vector | null,
): Shapes {
  const triangles = new Triangles(points.length * 2);
  const firstTriangle: number[] = [];
  const firstPoint: number[] = [];
  let first = 0;
  for (let ring = 0; ring < rings.length; ) {
    const sizes = [(rings[ring] ?? 0) >> 1];
    for (ring += 1; ring < rings.length && ((rings[ring] ?? 0) & 1) === 1; ring += 1) {
      sizes.push((rings[ring] ?? 0) >> 1);
    }
    const wanted = towards(firstTriangle.length);
    firstTriangle.push(triangles.size / 3);
    firstPoint.push(first);
    addShape(triangles, points, first, sizes, wanted);
    first += sizes.reduce((sum, size) => sum + size, 0);
  }
  firstTriangle.push(triangles.size / 3);
  firstPoint.push(first);
  return {
    points,
    triangles: triangles.taken(),
    firstTriangle: Uint32Array.from(firstTriangle),
    firstPoint: Uint32Array.from(firstPoint),
  };
}

function addShape(
  triangles: Triangles,
  points: Float32Array,
  first: number,
  sizes: number[],
  towards: Vector | null,
): void {
  const count = sizes[0] ?? 0;
  if (count < 3) return;
  const normal = areaVector(points, first, count);
  const flip =
    towards !== null &&
    normal[0] * towards[0] + normal[1] * towards[1] + normal[2] * towards[2] < 0;
  const push = (a: number, b: number, c: number): void =>
    flip ? triangles.push(a, c, b) : triangles.push(a, b, c);
  if (sizes.length === 1 && isConvex(points, first, count, normal)) {
    for (let i = 1; i + 1 < count; i += 1) push(first, first + i, first + i + 1);
    return;
  }
  const holes: Vector2[][] = [];
  let at = first + count;
  for (const size of sizes.slice(1)) {
    holes.push(flattened(points, at, size, normal));
    at += size;
  }
  const contour = flattened(points, first, count, normal);
  // The triangulation turns as the axes do; the normal turns with the ring.
  for (const [a = 0, b = 0, c = 0] of ShapeUtils.triangulateShape(contour, holes)) {
    const turn = triangleTurn(points, first + a, first + b, first + c, normal);
    if (turn >= 0) push(first + a, first + b, first + c);
    else push(first + a, first + c, first + b);
  }
}

function triangleTurn(
  points: Float32Array,
  a: number,
  b: number,
  c: number,
  normal: Vector,
): number {
  const p = pointAt(points, a);
  const q = pointAt(points, b);
  const r = pointAt(points, c);
  const u = [q[0] - p[0], q[1] - p[1], q[2] - p[2]] as const;
  const v = [r[0] - p[0], r[1] - p[1], r[2] - p[2]] as const;
  return (
    (u[1] * v[2] - u[2] * v[1]) * normal[0] +
    (u[2] * v[0] - u[0] * v[2]) * normal[1] +
    (u[0] * v[1] - u[1] * v[0]) * normal[2]
  );
}

/** What two parts of one polygon share is no border of it. */
function bordersOf(shapes: Shapes, polygon: Uint32Array): Float32Array {
  const { points, firstPoint } = shapes;
  const edges = new Map<string, [number, number]>();
  const name = (i: number): string => pointAt(points, i).join(" ");
  const cut = new Set<number>();
  for (let part = 1; part < polygon.length; part += 1) {
    if (polygon[part] === polygon[part - 1]) cut.add(polygon[part] ?? kNone);
  }
  const lines: number[] = [];
  const draw = (a: number, b: number): void => {
    lines.push(...pointAt(points, a), ...pointAt(points, b));
  };
  for (let part = 0; part < polygon.length; part += 1) {
    const first = firstPoint[part] ?? 0;
    const count = (firstPoint[part + 1] ?? 0) - first;
    const owner = polygon[part] ?? kNone;
    for (let i = 0; i < count; i += 1) {
      const a = first + i;
      const b = first + ((i + 1) % count);
      if (!cut.has(owner)) {
        draw(a, b);
        continue;
      }
      const back = `${owner} ${name(b)} ${name(a)}`;
      if (!edges.delete(back)) edges.set(`${owner} ${name(a)} ${name(b)}`, [a, b]);
    }
  }
  for (const [a, b] of edges.values()) draw(a, b);
  return Float32Array.from(lines);
}

export function readParts(view: View): Parts {
  const points = readFloat32(view.parts.points);
  const polygon = readUint32(view.parts.polygon);
  const shapes = shapesOf(points, readUint32(view.parts.rings), () => null);
  const normals = new Float32Array(view.polygons.length * 3);
  for (let part = 0; part < polygon.length; part += 1) {
    const first = shapes.firstPoint[part] ?? 0;
    const normal = areaVector(points, first, (shapes.firstPoint[part + 1] ?? 0) - first);
    const size = Math.hypot(...normal) || 1;
    const at = (polygon[part] ?? 0) * 3;
    normals.set(
      normal.map((x) => x / size),
      at,
    );
  }
  return { ...shapes, polygon, borders: bordersOf(shapes, polygon), normals };
}

/**
 * From where most can be seen: of the eight corners about a scene the usual one, unless another
 * sees far more of what polygons have before them.
 */
export function viewDirection(parts: Parts): Vector {
  const usual: Vector = [0.55, -0.75, 0.6];
  const corners: Vector[] = [];
  for (const z of [1, -1]) {
    for (const y of [1, -1]) {
      for (const x of [1, -1]) corners.push([usual[0] * x, usual[1] * y, usual[2] * z]);
    }
  }
  const seen = corners.map(() => 0);
  for (let part = 0; part + 1 < parts.firstPoint.length; part += 1) {
    const first = parts.firstPoint[part] ?? 0;
    const [x, y, z] = areaVector(parts.points, first, (parts.firstPoint[part + 1] ?? 0) - first);
    corners.forEach(([cx, cy, cz], i) => {
      seen[i] = (seen[i] ?? 0) + Math.max(0, x * cx + y * cy + z * cz);
    });
  }
  const best = seen.indexOf(Math.max(...seen));
  return (seen[best] ?? 0) > 1.5 * (seen[0] ?? 0) ? (corners[best] ?? usual) : usual;
}

/** The fragments of a layer; null where the page has none of it. */
export function readFragments(layer: ViewLayer, parts: Parts, radius: number): Fragments | null {
  if (layer.rings === undefined || layer.points === undefined) return null;
  const polygon = readUint32(layer.polygon ?? "");
  const side = readUint8(layer.side ?? "");
  const points = readFloat32(layer.points);
  const shapes = shapesOf(points, readUint32(layer.rings), (shape) => {
    const at = (polygon[shape] ?? 0) * 3;
    const sign = side[shape] === 1 ? -1 : 1;
    const { normals } = parts;
    return [
      sign * (normals[at] ?? 0),
      sign * (normals[at + 1] ?? 0),
      sign * (normals[at + 2] ?? 0),
    ];
  });
  const fragments = {
    ...shapes,
    polygon,
    side,
    state: readUint8(layer.state ?? ""),
    caster: readUint32(layer.caster ?? ""),
  };
  if (layer.level !== undefined) liftByLevel(fragments, readUint32(layer.level), parts, radius);
  return fragments;
}

/** What is painted over something else lies a hair above it. */
function liftByLevel(fragments: Fragments, level: Uint32Array, parts: Parts, radius: number): void {
  const step = radius * 2e-5;
  for (let i = 0; i < level.length; i += 1) {
    const at = (fragments.polygon[i] ?? 0) * 3;
    const lift = (fragments.side[i] === 1 ? -1 : 1) * step * (level[i] ?? 0);
    for (let p = fragments.firstPoint[i] ?? 0; p < (fragments.firstPoint[i + 1] ?? 0); p += 1) {
      for (let axis = 0; axis < 3; axis += 1) {
        const place = p * 3 + axis;
        fragments.points[place] =
          (fragments.points[place] ?? 0) + lift * (parts.normals[at + axis] ?? 0);
      }
    }
  }
}

/** The shape that a triangle is of. */
export function shapeOfTriangle(shapes: Shapes, triangle: number): number {
  let low = 0;
  let high = shapes.firstTriangle.length - 1;
  while (low + 1 < high) {
    const middle = (low + high) >> 1;
    if ((shapes.firstTriangle[middle] ?? 0) <= triangle) low = middle;
    else high = middle;
  }
  return low;
}

/** Whose shadow lies on a polygon, with how many fragments, most first. */
export function castersOf(fragments: Fragments, polygon: number): [number, number][] {
  const counts = new Map<number, number>();
  for (let i = 0; i < fragments.polygon.length; i += 1) {
    const caster = fragments.caster[i] ?? kNone;
    if (fragments.polygon[i] !== polygon || caster === kNone) continue;
    counts.set(caster, (counts.get(caster) ?? 0) + 1);
  }
  return [...counts].sort((a, b) => b[1] - a[1] || a[0] - b[0]);
}

/**
 * Where to look first: the box of most of the points, since a ground plane can be ten times as large
 * as the house on it. Its centre, and the radius of a ball about it.
 */
export function focusOf(parts: Parts, radius: number): { centre: Vector; radius: number } {
  const { points } = parts;
  const count = points.length / 3;
  const leftOut = count < kFewPoints ? 0 : kLeftOut;
  const centre: Vector = [0, 0, 0];
  let size = 0;
  for (let axis = 0; axis < 3; axis += 1) {
    const values = Float32Array.from({ length: count }, (_, i) => points[i * 3 + axis] ?? 0).sort();
    const low = values[Math.floor(count * leftOut)] ?? 0;
    const high = values[Math.min(count - 1, Math.ceil(count * (1 - leftOut)))] ?? 0;
    centre[axis] = (low + high) / 2;
    size = Math.hypot(size, (high - low) / 2);
  }
  return { centre, radius: Math.min(radius, Math.max(size * 1.15, radius * 0.15)) };
}
