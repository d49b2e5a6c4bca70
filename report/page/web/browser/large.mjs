// SPDX-License-Identifier: GPL-3.0-or-later
// A page of a city that nobody waits for in a test: 3,000 houses of 5 polygons, so many fragments.
import { execFileSync } from "node:child_process";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";

const base64 = (numbers) =>
  Buffer.from(numbers.buffer, numbers.byteOffset, numbers.byteLength).toString("base64");

/** The corners of the five faces of a house. */
function faces(x, y, height) {
  const [a, b] = [x + 0.7, y + 0.7];
  const low = [
    [x, y, 0],
    [a, y, 0],
    [a, b, 0],
    [x, b, 0],
  ];
  const high = low.map(([u, v]) => [u, v, height]);
  const walls = low.map((corner, i) => {
    const next = (i + 1) % 4;
    return [corner, low[next], high[next], high[i]];
  });
  return [...walls, high];
}

function city(fragmentsEach) {
  const side = 55;
  const polygons = [];
  for (let i = 0; i < 3000; i += 1) {
    const height = 0.5 + ((i * 7919) % 13) / 6;
    polygons.push(...faces((i % side) - side / 2, Math.floor(i / side) - side / 2, height));
  }
  const points = new Float32Array(polygons.length * 12);
  polygons.forEach((loop, i) => points.set(loop.flat(), i * 12));
  const owner = Uint32Array.from(polygons, (_, i) => i);
  const rings = new Uint32Array(polygons.length).fill(8);
  const layer = {
    polygon: new Uint32Array(polygons.length * fragmentsEach),
    side: new Uint8Array(polygons.length * fragmentsEach),
    state: new Uint8Array(polygons.length * fragmentsEach),
    caster: new Uint32Array(polygons.length * fragmentsEach),
    rings: new Uint32Array(polygons.length * fragmentsEach).fill(8),
    points: new Float32Array(polygons.length * fragmentsEach * 12),
  };
  let at = 0;
  polygons.forEach(([p, q, , s], polygon) => {
    for (let k = 0; k < fragmentsEach; k += 1) {
      const corner = (t, up) =>
        [0, 1, 2].map((i) => p[i] + t * (q[i] - p[i]) + (up ? s[i] - p[i] : 0));
      const [from, to] = [k / fragmentsEach, (k + 1) / fragmentsEach];
      const loop = [corner(from, 0), corner(to, 0), corner(to, 1), corner(from, 1)];
      layer.points.set(loop.flat(), at * 12);
      layer.polygon[at] = polygon;
      layer.state[at] = k % 2;
      layer.caster[at] = (polygon + 5) % polygons.length;
      at += 1;
    }
  });
  return {
    format: "gnomon-view",
    version: 1,
    states: ["lit", "shadow", "penumbra", "umbra"],
    centre: [0, 0, 0],
    radius: 39,
    polygons: polygons.map((_, i) => `house${Math.floor(i / 5)}.${i % 5}`),
    lights: [{ id: "sun", to_light: [1, 2, 3] }],
    parts: { polygon: base64(owner), rings: base64(rings), points: base64(points) },
    layers: ["exact", "double"].map((run) => ({
      run,
      light: "sun",
      fragments: at,
      ...Object.fromEntries(Object.entries(layer).map(([name, data]) => [name, base64(data)])),
    })),
  };
}

function year(sides) {
  const rows = 8760;
  const suns = new Int32Array(rows * 3);
  const lit = new Uint16Array(rows * sides);
  for (let row = 0; row < rows; row += 1) {
    const hour = row % 24;
    if (hour < 6 || hour > 18) continue;
    suns.set([500000, 400000, 700000], row * 3);
    for (let side = 0; side < sides; side += 1) lit[row * sides + side] = (row * side) % 10001;
  }
  return {
    format: "gnomon-year",
    version: 1,
    scene: "offices",
    geometry: "sha256:0",
    kernel: "plane",
    latitude: 50,
    longitude: 8,
    zone_minutes: 60,
    first: "2025-01-01",
    step_minutes: 60,
    rows,
    sides: Array.from({ length: sides }, (_, i) => `house${Math.floor(i / 5)}.${i % 5}`),
    suns: base64(suns),
    units: 10000,
    lit: base64(lit),
    hours: Array.from({ length: sides }, (_, i) => Array.from({ length: 12 }, (__, m) => i + m)),
    daylight: new Array(12).fill(395),
  };
}

function write(page, file, documents) {
  const data = Object.entries(documents).map(
    ([name, document]) =>
      `<script type="application/json" id="gnomon-data-${name}">\n${JSON.stringify(document)}\n</script>\n`,
  );
  const [before, after] = page.split("<!-- data -->");
  writeFileSync(file, before + data.join("") + after);
  return file;
}

/** Pages of a city with 34 fragments a polygon, 510,000 in all, and of a year of 300 sides. */
export function makeLargePages(folder) {
  const bare = join(folder, "bare.html");
  const cwd = new URL("..", import.meta.url).pathname;
  execFileSync(process.execPath, ["build.mjs", bare], { cwd });
  const page = readFileSync(bare, "utf8");
  const head = (command) => ({
    format: "gnomon-page",
    version: 1,
    command,
    command_line: `gnomon ${command} city.json`,
    program: "gnomon",
    scene: "city",
    files: [],
    notes: [],
  });
  const view = city(34);
  return {
    city: write(page, join(folder, "city.html"), { page: head("certify"), view }),
    year: write(page, join(folder, "large-year.html"), {
      page: head("year"),
      year: year(300),
      view: { ...view, layers: [] },
    }),
  };
}
