// SPDX-License-Identifier: GPL-3.0-or-later
// The scene in three dimensions: classes coloured, errors marked, drawn only when something
// changes. What it holds is in a few merged buffers, whatever the scene's size.
import {
  BufferAttribute,
  BufferGeometry,
  CanvasTexture,
  Color,
  ColorManagement,
  DoubleSide,
  FrontSide,
  Group,
  LineBasicMaterial,
  LineSegments,
  LinearSRGBColorSpace,
  Mesh,
  MeshBasicMaterial,
  PerspectiveCamera,
  Points,
  PointsMaterial,
  Raycaster,
  Scene,
  Vector2,
  Vector3,
  WebGLRenderer,
} from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import {
  kCasterColour,
  kClassColours,
  kMarkColour,
  kPickColour,
  kRayColour,
  kUnlitColour,
  type Rgb,
} from "./colours";
import type { Point, View, ViewLight } from "./documents";
import { wantsStillness } from "./dom";
import {
  focusOf,
  readFragments,
  readParts,
  shapeOfTriangle,
  viewDirection,
  type Fragments,
  type Parts,
} from "./view_data";

/** A place of error to draw. */
export interface Mark {
  /** In scene units. */
  point: Point;
  polygon: number;
  back: boolean;
  /** Greatest width of the region, scene units. */
  width: number;
  /** Not the widest of its side: a dot, not a ring. */
  minor: boolean;
}

/** What a click met. */
export interface Picked {
  polygon: number;
  back: boolean;
  /** Of the layer that is shown; none on a polygon without fragments. */
  fragment: number | null;
  /** About the centre of the scene; none if it was picked by name. */
  point: Vector3 | null;
}

interface Flight {
  from: Vector3;
  to: Vector3;
  targetFrom: Vector3;
  targetTo: Vector3;
  start: number;
}

const kFlightMilliseconds = 600;
const kMarkPixels = 20;
const kDotPixels = 8;
const kManyFragments = 100_000;

export class SceneView {
  readonly canvas: HTMLCanvasElement;
  readonly parts: Parts;
  onPick: (picked: Picked | null) => void = () => {};
  onMark: (index: number) => void = () => {};
  private readonly view: View;
  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  private readonly camera: PerspectiveCamera;
  private readonly controls: OrbitControls;
  private readonly base: Mesh;
  private readonly baseColours: Uint8Array;
  private readonly markGroup = new Group();
  private readonly highlight = new Group();
  private readonly ray = new Group();
  private readonly lights = new Group();
  private readonly layers = new Map<number, { mesh: Mesh; fragments: Fragments } | null>();
  private shown: { mesh: Mesh; fragments: Fragments } | null = null;
  private marks: Mark[] = [];
  private flight: Flight | null = null;
  private wanted = false;

  constructor(view: View) {
    this.view = view;
    // Smooth edges cost as much as all else where a picture has a million triangles.
    const most = Math.max(0, ...view.layers.map(({ fragments }) => fragments ?? 0));
    const antialias = most < kManyFragments;
    this.renderer = new WebGLRenderer({ antialias, preserveDrawingBuffer: true });
    // Colours are drawn as they are written: nothing here is lit by anything.
    ColorManagement.enabled = false;
    this.renderer.outputColorSpace = LinearSRGBColorSpace;
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.canvas = this.renderer.domElement;
    const radius = Math.max(view.radius, 1e-30);
    this.camera = new PerspectiveCamera(40, 1, radius * 1e-4, radius * 40);
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, this.canvas);
    this.controls.minDistance = radius * 1e-3;
    this.controls.maxDistance = radius * 20;
    this.controls.addEventListener("change", () => this.draw());
    this.parts = readParts(view);
    this.baseColours = new Uint8Array((this.parts.points.length / 3) * 4).fill(255);
    this.base = this.baseMesh();
    this.scene.add(this.base, this.borders());
    this.scene.add(this.markGroup, this.highlight, this.ray, this.lights);
    this.reset(false);
    this.followPointer();
    new ResizeObserver(() => this.resize()).observe(this.canvas);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.draw());
    matchMedia("print").addEventListener("change", () => this.draw());
  }

  /** Draws once, soon. */
  draw(): void {
    if (this.wanted) return;
    this.wanted = true;
    requestAnimationFrame(() => {
      this.wanted = false;
      this.drawNow();
    });
  }

  /** Shows the fragments of a layer; false if the page has none of it. */
  showLayer(index: number): boolean {
    const layer = this.view.layers[index];
    if (this.shown) this.scene.remove(this.shown.mesh);
    if (!this.layers.has(index)) this.layers.set(index, layer ? this.readLayer(index) : null);
    this.shown = this.layers.get(index) ?? null;
    if (this.shown) this.scene.add(this.shown.mesh);
    const background = layer?.background;
    this.paintBase(() => (background ? kClassColours[background] : undefined) ?? kUnlitColour);
    return this.shown !== null;
  }

  /** Colours polygons as a whole, in the place of fragments. */
  paintPolygons(colour: (polygon: number) => Rgb): void {
    if (this.shown) this.scene.remove(this.shown.mesh);
    this.shown = null;
    this.paintBase(colour);
  }

  get fragments(): Fragments | null {
    return this.shown?.fragments ?? null;
  }

  setMarks(marks: Mark[]): void {
    this.marks = marks;
    clear(this.markGroup);
    for (const minor of [true, false]) {
      const shown = marks.filter((mark) => mark.minor === minor);
      if (shown.length > 0) this.markGroup.add(this.markPoints(shown, minor));
    }
    this.draw();
  }

  private markPoints(marks: Mark[], minor: boolean): Points {
    const positions = new Float32Array(marks.flatMap(({ point }) => this.about(point).toArray()));
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(positions, 3));
    const material = new PointsMaterial({
      size: minor ? kDotPixels : kMarkPixels,
      sizeAttenuation: false,
      map: minor ? discTexture(kMarkColour, "#ffffff") : ringTexture(),
      transparent: true,
      depthTest: false,
    });
    const points = new Points(geometry, material);
    points.renderOrder = minor ? 9 : 10;
    return points;
  }

  /** Draws the light of a witness, the ray to it and the caster that it meets. */
  showWitness(point: Point | null, light: ViewLight | undefined, caster: number | null): void {
    clear(this.ray);
    if (point && light) {
      const from = this.about(point);
      const ends = this.lightEnds(light, from);
      this.ray.add(
        lines(
          ends.flatMap((end) => [from, end]),
          kRayColour,
        ),
      );
    }
    if (caster !== null) this.ray.add(...this.outline(caster, kCasterColour));
    this.draw();
  }

  showLight(light: ViewLight | undefined): void {
    clear(this.lights);
    if (light?.position) {
      const geometry = new BufferGeometry();
      geometry.setAttribute(
        "position",
        new BufferAttribute(new Float32Array(this.about(light.position).toArray()), 3),
      );
      const map = discTexture("#ffb703", "#7a5200");
      this.lights.add(
        new Points(
          geometry,
          new PointsMaterial({ size: 18, sizeAttenuation: false, map, transparent: true }),
        ),
      );
    } else if (light?.loop) {
      const corners = light.loop.map((corner) => this.about(corner));
      const sides = corners.flatMap((corner, i) => [
        corner,
        corners[(i + 1) % corners.length] ?? corner,
      ]);
      this.lights.add(lines(sides, kRayColour));
      this.lights.add(fan(corners, kRayColour, 0.6));
    } else if (light?.to_light) {
      const way = new Vector3(...light.to_light).normalize().multiplyScalar(this.view.radius);
      this.lights.add(
        lines([way.clone().multiplyScalar(1.05), way.multiplyScalar(1.5)], kRayColour),
      );
    }
    this.draw();
  }

  highlightPolygon(polygon: number | null): void {
    clear(this.highlight);
    // Without a face, which would hide the classes.
    if (polygon !== null) {
      const drawn = this.outline(polygon, kPickColour);
      this.highlight.add(...drawn.filter((each) => each instanceof LineSegments));
    }
    this.draw();
  }

  /** Flies to where a mark fills some of the view, before the side that it is on. */
  flyTo(mark: Mark): void {
    const target = this.about(mark.point);
    const at = mark.polygon * 3;
    const { normals } = this.parts;
    const way = new Vector3(normals[at], normals[at + 1], normals[at + 2]);
    if (mark.back) way.negate();
    if (way.lengthSq() === 0) way.set(0, 0, 1);
    // A little aside, so that a floor is not seen from straight above.
    way.add(this.camera.position.clone().sub(target).normalize().multiplyScalar(0.6)).normalize();
    const { radius } = this.view;
    const distance = Math.min(Math.max(mark.width * 30, radius * 0.12), radius * 2);
    this.flyFrom(target.clone().addScaledVector(way, distance), target);
  }

  flyToPolygon(polygon: number): void {
    const centre = new Vector3();
    const corners = this.cornersOf(polygon);
    if (corners.length === 0) return;
    for (const corner of corners) centre.add(corner);
    centre.divideScalar(corners.length);
    const size = Math.max(...corners.map((corner) => corner.distanceTo(centre)));
    const way = this.camera.position.clone().sub(centre).normalize();
    this.flyFrom(centre.clone().addScaledVector(way, Math.max(size * 4, 1e-6)), centre);
  }

  /** The scene from a corner above it. */
  reset(fly = true): void {
    const focus = focusOf(this.parts, this.view.radius);
    const target = new Vector3(...focus.centre);
    const way = new Vector3(...viewDirection(this.parts)).normalize();
    const position = target.clone().addScaledVector(way, Math.max(focus.radius, 1e-30) * 3);
    if (fly) {
      this.flyFrom(position, target);
    } else {
      this.camera.position.copy(position);
      this.controls.target.copy(target);
      this.controls.update();
    }
  }

  /** Radians about the vertical and across, as by the arrow keys. */
  turn(about: number, across: number): void {
    const offset = this.camera.position.clone().sub(this.controls.target);
    const size = offset.length();
    const azimuth = Math.atan2(offset.y, offset.x) + about;
    const polar = Math.acos(offset.z / size) + across;
    const height = Math.min(Math.max(polar, 0.02), Math.PI - 0.02);
    offset.set(
      size * Math.sin(height) * Math.cos(azimuth),
      size * Math.sin(height) * Math.sin(azimuth),
      size * Math.cos(height),
    );
    this.camera.position.copy(this.controls.target).add(offset);
    this.controls.update();
    this.draw();
  }

  zoom(factor: number): void {
    const offset = this.camera.position.clone().sub(this.controls.target).multiplyScalar(factor);
    this.camera.position.copy(this.controls.target).add(offset);
    this.controls.update();
    this.draw();
  }

  /** What is at a place of the canvas, in its own pixels. */
  pick(x: number, y: number): Picked | null {
    const caster = new Raycaster();
    const { clientWidth, clientHeight } = this.canvas;
    caster.setFromCamera(
      new Vector2((x / clientWidth) * 2 - 1, 1 - (y / clientHeight) * 2),
      this.camera,
    );
    const fragment = this.shown ? caster.intersectObject(this.shown.mesh)[0] : undefined;
    const part = caster.intersectObject(this.base)[0];
    const slack = this.view.radius * 1e-4;
    if (fragment && this.shown && (!part || fragment.distance <= part.distance + slack)) {
      const index = shapeOfTriangle(this.shown.fragments, fragment.faceIndex ?? 0);
      return {
        polygon: this.shown.fragments.polygon[index] ?? 0,
        back: this.shown.fragments.side[index] === 1,
        fragment: index,
        point: fragment.point,
      };
    }
    if (!part) return null;
    const index = shapeOfTriangle(this.parts, part.faceIndex ?? 0);
    const polygon = this.parts.polygon[index] ?? 0;
    const normal = new Vector3(...this.parts.normals.subarray(polygon * 3, polygon * 3 + 3));
    const back = normal.dot(caster.ray.direction) > 0;
    return { polygon, back, fragment: null, point: part.point };
  }

  /** The nearest mark within its ring. */
  private markAt(x: number, y: number): number | null {
    let best: number | null = null;
    let nearest = kMarkPixels / 2;
    const { clientWidth, clientHeight } = this.canvas;
    this.marks.forEach(({ point }, index) => {
      const at = this.about(point).project(this.camera);
      if (at.z > 1) return;
      const dx = ((at.x + 1) / 2) * clientWidth - x;
      const dy = ((1 - at.y) / 2) * clientHeight - y;
      const distance = Math.hypot(dx, dy);
      if (distance >= nearest) return;
      nearest = distance;
      best = index;
    });
    return best;
  }

  private about(point: Point): Vector3 {
    const { centre } = this.view;
    return new Vector3(point[0] - centre[0], point[1] - centre[1], point[2] - centre[2]);
  }

  private lightEnds(light: ViewLight, from: Vector3): Vector3[] {
    if (light.position) return [this.about(light.position)];
    if (light.loop) return light.loop.map((corner) => this.about(corner));
    const way = new Vector3(...(light.to_light ?? [0, 0, 1])).normalize();
    return [from.clone().addScaledVector(way, this.view.radius * 2.5)];
  }

  private cornersOf(polygon: number): Vector3[] {
    const corners: Vector3[] = [];
    const { parts } = this;
    parts.polygon.forEach((owner, part) => {
      if (owner !== polygon) return;
      for (let i = parts.firstPoint[part] ?? 0; i < (parts.firstPoint[part + 1] ?? 0); i += 1) {
        corners.push(new Vector3(...parts.points.subarray(i * 3, i * 3 + 3)));
      }
    });
    return corners;
  }

  private outline(polygon: number, colour: string): (LineSegments | Mesh)[] {
    const { parts } = this;
    const drawn: (LineSegments | Mesh)[] = [];
    parts.polygon.forEach((owner, part) => {
      if (owner !== polygon) return;
      const corners: Vector3[] = [];
      for (let i = parts.firstPoint[part] ?? 0; i < (parts.firstPoint[part + 1] ?? 0); i += 1) {
        corners.push(new Vector3(...parts.points.subarray(i * 3, i * 3 + 3)));
      }
      const sides = corners.flatMap((corner, i) => [
        corner,
        corners[(i + 1) % corners.length] ?? corner,
      ]);
      const border = lines(sides, colour);
      (border.material as LineBasicMaterial).depthTest = false;
      border.renderOrder = 8;
      drawn.push(border, fan(corners, colour, 0.35));
    });
    return drawn;
  }

  private baseMesh(): Mesh {
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(this.parts.points, 3));
    geometry.setAttribute("color", new BufferAttribute(this.baseColours, 4, true));
    geometry.setIndex(new BufferAttribute(this.parts.triangles, 1));
    const material = new MeshBasicMaterial({ vertexColors: true, side: DoubleSide });
    // Fragments lie in the polygons' planes, and are to be seen.
    material.polygonOffset = true;
    material.polygonOffsetFactor = 1;
    material.polygonOffsetUnits = 4;
    return new Mesh(geometry, material);
  }

  private borders(): LineSegments {
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(this.parts.borders, 3));
    const material = new LineBasicMaterial({ color: 0x202833, transparent: true, opacity: 0.55 });
    return new LineSegments(geometry, material);
  }

  /** Faces are a little lighter or darker by where they look, so that edges show. */
  private shaded(colour: Rgb, polygon: number, back: boolean): Rgb {
    const at = polygon * 3;
    const { normals } = this.parts;
    const turn =
      0.25 * (normals[at] ?? 0) - 0.35 * (normals[at + 1] ?? 0) + 0.9 * (normals[at + 2] ?? 0);
    const factor = 0.88 + 0.12 * (back ? -turn : turn);
    return colour.map((channel) => Math.round(channel * factor)) as Rgb;
  }

  private paintBase(colour: (polygon: number) => Rgb): void {
    const { parts, baseColours } = this;
    parts.polygon.forEach((polygon, part) => {
      const rgb = this.shaded(colour(polygon), polygon, false);
      for (let i = parts.firstPoint[part] ?? 0; i < (parts.firstPoint[part + 1] ?? 0); i += 1) {
        baseColours.set(rgb, i * 4);
      }
    });
    (this.base.geometry.getAttribute("color") as BufferAttribute).needsUpdate = true;
    this.draw();
  }

  private readLayer(index: number): { mesh: Mesh; fragments: Fragments } | null {
    const layer = this.view.layers[index];
    const fragments = layer && readFragments(layer, this.parts, this.view.radius);
    if (!fragments) return null;
    const colours = new Uint8Array((fragments.points.length / 3) * 4).fill(255);
    for (let i = 0; i < fragments.polygon.length; i += 1) {
      const state = this.view.states[fragments.state[i] ?? 0] ?? "lit";
      const rgb = this.shaded(
        kClassColours[state] ?? kUnlitColour,
        fragments.polygon[i] ?? 0,
        fragments.side[i] === 1,
      );
      for (let p = fragments.firstPoint[i] ?? 0; p < (fragments.firstPoint[i + 1] ?? 0); p += 1) {
        colours.set(rgb, p * 4);
      }
    }
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(fragments.points, 3));
    geometry.setAttribute("color", new BufferAttribute(colours, 4, true));
    geometry.setIndex(new BufferAttribute(fragments.triangles, 1));
    const mesh = new Mesh(geometry, new MeshBasicMaterial({ vertexColors: true, side: FrontSide }));
    return { mesh, fragments };
  }

  private followPointer(): void {
    let down: { x: number; y: number } | null = null;
    this.canvas.addEventListener("pointerdown", ({ offsetX, offsetY }) => {
      down = { x: offsetX, y: offsetY };
      this.flight = null;
    });
    this.canvas.addEventListener("pointerup", ({ offsetX, offsetY }) => {
      const moved = down ? Math.hypot(offsetX - down.x, offsetY - down.y) : Infinity;
      down = null;
      if (moved > 4) return;
      const mark = this.markAt(offsetX, offsetY);
      if (mark !== null) this.onMark(mark);
      else this.onPick(this.pick(offsetX, offsetY));
    });
  }

  private flyFrom(position: Vector3, target: Vector3): void {
    if (wantsStillness()) {
      this.camera.position.copy(position);
      this.controls.target.copy(target);
      this.controls.update();
      this.draw();
      return;
    }
    this.flight = {
      from: this.camera.position.clone(),
      to: position,
      targetFrom: this.controls.target.clone(),
      targetTo: target,
      start: performance.now(),
    };
    this.draw();
  }

  private advanceFlight(): void {
    const { flight } = this;
    if (!flight) return;
    const t = Math.min(1, (performance.now() - flight.start) / kFlightMilliseconds);
    const eased = t * t * (3 - 2 * t);
    this.camera.position.lerpVectors(flight.from, flight.to, eased);
    this.controls.target.lerpVectors(flight.targetFrom, flight.targetTo, eased);
    if (t === 1) this.flight = null;
    this.controls.update();
    if (this.flight) this.draw();
  }

  private resize(): void {
    const { clientWidth, clientHeight } = this.canvas;
    if (clientWidth === 0 || clientHeight === 0) return;
    this.renderer.setSize(clientWidth, clientHeight, false);
    this.camera.aspect = clientWidth / clientHeight;
    // A narrow view shows as much across as a wide one shows upwards.
    this.camera.fov = 40 / Math.min(1, Math.max(0.55, this.camera.aspect));
    this.camera.updateProjectionMatrix();
    this.draw();
  }

  private drawNow(): void {
    this.advanceFlight();
    const ground = getComputedStyle(this.canvas).getPropertyValue("--view-ground").trim();
    this.scene.background = new Color(ground || "#e9edf2");
    this.renderer.render(this.scene, this.camera);
  }
}

function clear(group: Group): void {
  for (const child of [...group.children]) {
    group.remove(child);
    if (child instanceof Mesh || child instanceof LineSegments || child instanceof Points) {
      (child.geometry as BufferGeometry).dispose();
    }
  }
}

function lines(points: Vector3[], colour: string): LineSegments {
  return new LineSegments(
    new BufferGeometry().setFromPoints(points),
    new LineBasicMaterial({ color: colour }),
  );
}

function fan(corners: Vector3[], colour: string, opacity: number): Mesh {
  const points: Vector3[] = [];
  const first = corners[0];
  for (let i = 1; first && i + 1 < corners.length; i += 1) {
    points.push(first, corners[i] ?? first, corners[i + 1] ?? first);
  }
  const material = new MeshBasicMaterial({
    color: colour,
    transparent: true,
    opacity,
    side: DoubleSide,
    depthWrite: false,
    polygonOffset: true,
    polygonOffsetFactor: -1,
    polygonOffsetUnits: -4,
  });
  return new Mesh(new BufferGeometry().setFromPoints(points), material);
}

function drawnTexture(draw: (context: CanvasRenderingContext2D, size: number) => void) {
  const size = 64;
  const canvas = document.createElement("canvas");
  canvas.width = size;
  canvas.height = size;
  const context = canvas.getContext("2d");
  if (context) draw(context, size);
  return new CanvasTexture(canvas);
}

function ringTexture(): CanvasTexture {
  return drawnTexture((context, size) => {
    for (const [colour, width] of [
      ["#ffffff", 14],
      [kMarkColour, 8],
    ] as const) {
      context.strokeStyle = colour;
      context.lineWidth = width;
      context.beginPath();
      context.arc(size / 2, size / 2, size / 2 - 9, 0, 2 * Math.PI);
      context.stroke();
    }
    context.fillStyle = kMarkColour;
    context.beginPath();
    context.arc(size / 2, size / 2, 5, 0, 2 * Math.PI);
    context.fill();
  });
}

function discTexture(fill: string, border: string): CanvasTexture {
  return drawnTexture((context, size) => {
    context.fillStyle = fill;
    context.strokeStyle = border;
    context.lineWidth = 5;
    context.beginPath();
    context.arc(size / 2, size / 2, size / 2 - 6, 0, 2 * Math.PI);
    context.fill();
    context.stroke();
  });
}
