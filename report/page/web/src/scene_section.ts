// SPDX-License-Identifier: GPL-3.0-or-later
// The scene with what is said of it: runs and lights to choose, errors to fly to, polygons to pick.
import { css, kClassColours, kUnlitColour } from "./colours";
import type { Certificate, ResultSide, Result, View } from "./documents";
import { add, field, freshId, h, section, type Child } from "./dom";
import { counted, percent, plural, rounded, sentence } from "./numbers";
import { errorInWords, errorsOf, widthOf, type RunError } from "./runs";
import { SceneView, type Mark, type Picked } from "./view3d";
import { castersOf, kNone } from "./view_data";

export interface SceneSources {
  view: View;
  result?: Result | undefined;
  certificate?: Certificate | undefined;
}

const kExact = "exact";
const kMostCasters = 12;

export class SceneSection {
  readonly element: HTMLElement;
  private readonly sources: SceneSources;
  private readonly polygonIndex = new Map<string, number>();
  private readonly errors: RunError[] = [];
  private three: SceneView | null = null;
  private readonly runSelect = h("select", { id: "scene-run" });
  private readonly lightSelect = h("select", { id: "scene-light" });
  private readonly info = h("div", { id: "scene-info", class: "info", "aria-live": "polite" });
  private readonly message = h("p", { class: "status", role: "status", id: "scene-status" });
  private readonly host = h("div", { class: "canvas" });
  private run = kExact;
  private light = "";
  /** Whose errors are marked, also while the exact answer is shown. */
  private candidate: string | null = null;
  private current: RunError | null = null;
  private picked: Picked | null = null;

  constructor(sources: SceneSources) {
    this.sources = sources;
    const { view, certificate } = sources;
    view.polygons.forEach((id, index) => this.polygonIndex.set(id, index));
    for (const run of certificate?.runs ?? []) {
      if (certificate) this.errors.push(...errorsOf(run, certificate));
    }
    this.fillSelects();
    this.element = section(
      "scene",
      "The scene",
      h("p", { class: "lead" }, this.lead()),
      this.toolbar(),
      h("div", { class: "scene" }, this.host, this.info),
      this.legend(),
      this.message,
      this.keys(),
    );
    this.candidate = this.candidates()[0] ?? null;
  }

  /** After the element is in the page: only then a canvas has a size. */
  start(): void {
    try {
      this.three = new SceneView(this.sources.view);
    } catch (problem) {
      this.host.append(
        h(
          "p",
          { class: "note" },
          `This browser cannot draw in three dimensions: ${String(problem)}`,
        ),
      );
      return;
    }
    const { three } = this;
    three.canvas.id = "scene-canvas";
    three.canvas.tabIndex = 0;
    three.canvas.setAttribute("role", "application");
    three.canvas.setAttribute("aria-label", this.lead());
    three.canvas.setAttribute("aria-describedby", "scene-keys");
    this.host.append(three.canvas);
    three.onPick = (picked) => this.pick(picked);
    three.onMark = (index) => {
      const error = this.marked()[index];
      if (error) this.showError(error);
    };
    three.canvas.addEventListener("keydown", (event) => this.key(event));
    this.showLayer();
    this.describe(null);
  }

  /** Shows a run with the light, the place and the caster of one of its errors. */
  showError(error: RunError, scroll = false): void {
    this.current = error;
    this.candidate = error.run;
    if (this.hasLayer(error.run, error.light)) this.run = error.run;
    this.light = error.light;
    this.showLayer();
    const { three } = this;
    const mark = this.markOf(error);
    const caster = error.witness.caster;
    const light = this.sources.view.lights.find(({ id }) => id === error.light);
    three?.showWitness(
      error.witness.point ?? null,
      light,
      caster === undefined ? null : (this.polygonIndex.get(caster) ?? null),
    );
    three?.highlightPolygon(mark.polygon);
    three?.flyTo(mark);
    this.describeError(error);
    if (scroll) this.element.scrollIntoView({ block: "start" });
  }

  showPolygon(id: string): void {
    const polygon = this.polygonIndex.get(id);
    if (polygon === undefined) return;
    this.pickPolygon(polygon, false);
    this.three?.flyToPolygon(polygon);
    this.element.scrollIntoView({ block: "start" });
  }

  private lead(): string {
    const { view, certificate } = this.sources;
    const lights = view.lights.length;
    const wrong = this.errors.length;
    return (
      `${plural(view.polygons.length, "polygon")} under ${plural(lights, "light")}` +
      (certificate ? `; ${plural(wrong, "place")} of error can be flown to.` : ".")
    );
  }

  private candidates(): string[] {
    const names = this.sources.view.layers.map(({ run }) => run);
    return [...new Set(names)].filter((name) => name !== kExact);
  }

  private hasLayer(run: string, light: string): boolean {
    return this.sources.view.layers.some((layer) => layer.run === run && layer.light === light);
  }

  private fillSelects(): void {
    const { view } = this.sources;
    for (const run of new Set(view.layers.map((layer) => layer.run))) {
      const text = run === kExact ? "exact answer" : run;
      this.runSelect.append(h("option", { value: run }, text));
    }
    const lights = [...new Set(view.layers.map((layer) => layer.light))];
    for (const light of lights) this.lightSelect.append(h("option", { value: light }, light));
    this.light = lights[0] ?? "";
    this.runSelect.addEventListener("change", () => {
      this.run = this.runSelect.value;
      if (this.run !== kExact) this.candidate = this.run;
      this.showLayer();
    });
    this.lightSelect.addEventListener("change", () => {
      this.light = this.lightSelect.value;
      this.leaveError();
      this.showLayer();
    });
  }

  private toolbar(): HTMLElement {
    const button = (id: string, label: string, act: () => void): HTMLElement =>
      h("button", { type: "button", id, onclick: act }, label);
    const bar = h("div", { class: "controls", role: "toolbar", "aria-label": "The scene" });
    add(bar, [
      field("scene-run", "Answer", this.runSelect),
      this.candidates().length > 0 &&
        button("scene-toggle", "Exact or candidate", () => this.toggle()),
      field("scene-light", "Light", this.lightSelect),
    ]);
    if (this.errors.length > 0) {
      add(bar, [
        button("scene-previous", "Previous error", () => this.step(-1)),
        button("scene-next", "Next error", () => this.step(1)),
      ]);
    }
    add(bar, [button("scene-reset", "Whole scene", () => this.wholeScene())]);
    return bar;
  }

  private legend(): HTMLElement {
    const item = (name: string, colour: string): HTMLElement =>
      h("li", {}, h("span", { class: "swatch", style: `background: ${colour}` }), name);
    const area = this.sources.view.lights.some(({ loop }) => loop !== undefined);
    const other = this.sources.view.lights.some(({ loop }) => loop === undefined);
    const names = ["lit", ...(other ? ["shadow"] : []), ...(area ? ["penumbra", "umbra"] : [])];
    const list = h("ul", { class: "legend", "aria-label": "Colours" });
    for (const name of names) {
      list.append(item(name, css(kClassColours[name] ?? kUnlitColour)));
    }
    list.append(item("not asked about: backs", css(kUnlitColour)));
    if (this.errors.length > 0) {
      list.append(h("li", {}, h("span", { class: "swatch ring" }), "place of error"));
      list.append(h("li", {}, h("span", { class: "swatch caster" }), "caster of its witness"));
    }
    list.append(h("li", {}, h("span", { class: "swatch picked" }), "picked"));
    return list;
  }

  private keys(): HTMLElement {
    return h(
      "p",
      { class: "keys", id: "scene-keys" },
      "Drag to turn, wheel to zoom, click to pick. With the picture focused: arrow keys turn, ",
      h("kbd", {}, "+"),
      " and ",
      h("kbd", {}, "-"),
      " zoom, ",
      h("kbd", {}, "T"),
      " toggles exact and candidate, ",
      h("kbd", {}, "N"),
      " and ",
      h("kbd", {}, "P"),
      " go to the next and previous error, ",
      h("kbd", {}, "L"),
      " changes the light, ",
      h("kbd", {}, "Enter"),
      " picks what is in the middle, ",
      h("kbd", {}, "Home"),
      " shows the whole scene, ",
      h("kbd", {}, "Esc"),
      " lets go. Positions are drawn to single precision; numbers are exact to the digits shown.",
    );
  }

  private key(event: KeyboardEvent): void {
    const { three } = this;
    if (!three || event.ctrlKey || event.metaKey || event.altKey) return;
    const actions: Record<string, () => void> = {
      ArrowLeft: () => three.turn(-0.1, 0),
      ArrowRight: () => three.turn(0.1, 0),
      ArrowUp: () => three.turn(0, -0.1),
      ArrowDown: () => three.turn(0, 0.1),
      "+": () => three.zoom(0.85),
      "=": () => three.zoom(0.85),
      "-": () => three.zoom(1 / 0.85),
      t: () => this.toggle(),
      n: () => this.step(1),
      p: () => this.step(-1),
      l: () => this.nextLight(),
      Home: () => this.wholeScene(),
      Escape: () => this.leaveError(),
      Enter: () => {
        const { clientWidth, clientHeight } = three.canvas;
        this.pick(three.pick(clientWidth / 2, clientHeight / 2));
      },
    };
    const act = actions[event.key.length === 1 ? event.key.toLowerCase() : event.key];
    if (!act) return;
    event.preventDefault();
    act();
  }

  private toggle(): void {
    if (this.candidate === null) return;
    this.run = this.run === kExact ? this.candidate : kExact;
    this.showLayer();
  }

  private nextLight(): void {
    const { options, selectedIndex } = this.lightSelect;
    this.light = options[(selectedIndex + 1) % options.length]?.value ?? this.light;
    this.leaveError();
    this.showLayer();
  }

  private step(by: number): void {
    const errors = this.errors.filter(({ run }) => run === this.candidate);
    const list = errors.length > 0 ? errors : this.errors;
    if (list.length === 0) return;
    const at = this.current ? list.indexOf(this.current) : by > 0 ? -1 : 0;
    const next = list[(at + by + list.length) % list.length];
    if (next) this.showError(next);
  }

  private wholeScene(): void {
    this.leaveError();
    this.three?.reset();
  }

  private leaveError(): void {
    this.current = null;
    this.picked = null;
    this.three?.showWitness(null, undefined, null);
    this.three?.highlightPolygon(null);
    this.describe(null);
  }

  private showLayer(): void {
    this.runSelect.value = this.run;
    this.lightSelect.value = this.light;
    const { view } = this.sources;
    const index = view.layers.findIndex(
      (layer) => layer.run === this.run && layer.light === this.light,
    );
    const layer = view.layers[index];
    const drawn = this.three?.showLayer(index) ?? false;
    const name = this.run === kExact ? "the exact answer" : this.run;
    if (!layer) this.message.textContent = `${name} tells nothing of light ${this.light}.`;
    else if (layer.left_out !== undefined) {
      this.message.textContent = `The fragments of ${name} are not in this page: ${layer.left_out}.`;
    } else if (drawn) {
      const count = plural(layer.fragments ?? 0, "fragment");
      this.message.textContent = `Shown: ${name} under light ${this.light}, ${count}.`;
    }
    if (layer?.left_out !== undefined) this.paintShares();
    this.three?.showLight(view.lights.find(({ id }) => id === this.light));
    this.three?.setMarks(this.marked().map((error) => this.markOf(error)));
    if (this.picked) this.describe(this.picked);
  }

  /** In the place of fragments: each polygon by how much of it is lit. */
  private paintShares(): void {
    const lit = new Map<number, number>();
    for (const side of this.sidesOf(this.light)) {
      const polygon = this.polygonIndex.get(side.id);
      if (polygon !== undefined && side.lit) lit.set(polygon, Number(side.lit.fraction));
    }
    const bright = kClassColours["lit"] ?? kUnlitColour;
    const dark = kClassColours["shadow"] ?? kUnlitColour;
    this.three?.paintPolygons((polygon) => {
      const share = lit.get(polygon);
      if (share === undefined || Number.isNaN(share)) return kUnlitColour;
      const mix = (i: 0 | 1 | 2): number => dark[i] + share * (bright[i] - dark[i]);
      return [mix(0), mix(1), mix(2)];
    });
  }

  private marked(): RunError[] {
    return this.errors.filter(({ run, light }) => run === this.candidate && light === this.light);
  }

  private markOf(error: RunError): Mark {
    return {
      point: error.witness.point ?? [0, 0, 0],
      polygon: this.polygonIndex.get(error.polygon) ?? 0,
      back: error.side === "back",
      width: widthOf(error.witness),
      minor: error.witness !== error.wrong.worst,
    };
  }

  private sidesOf(light: string): ResultSide[] {
    return this.sources.result?.lights.find(({ id }) => id === light)?.polygons ?? [];
  }

  private pick(picked: Picked | null): void {
    if (!picked) {
      this.leaveError();
      return;
    }
    this.pickPolygon(picked.polygon, picked.back, picked);
  }

  private pickPolygon(polygon: number, back: boolean, picked?: Picked): void {
    this.current = null;
    const { three } = this;
    this.picked = picked ?? { polygon, back, fragment: null, point: null };
    three?.highlightPolygon(polygon);
    const caster = picked?.fragment !== null && picked !== undefined ? this.casterAt(picked) : null;
    const light = this.sources.view.lights.find(({ id }) => id === this.light);
    const { centre } = this.sources.view;
    const at = picked?.point;
    three?.showWitness(
      at && caster !== null ? [at.x + centre[0], at.y + centre[1], at.z + centre[2]] : null,
      light,
      caster,
    );
    if (this.picked) this.describe(this.picked);
  }

  private casterAt(picked: Picked): number | null {
    const caster = this.three?.fragments?.caster[picked.fragment ?? 0] ?? kNone;
    return caster === kNone ? null : caster;
  }

  private describe(picked: Picked | null): void {
    this.info.replaceChildren();
    if (!picked) {
      const text =
        "Pick a polygon to see its shares and what casts shadow on it" +
        (this.errors.length > 0 ? ", or a ring to see an error." : ".");
      this.info.append(h("p", { class: "hint" }, text));
      return;
    }
    const id = this.sources.view.polygons[picked.polygon] ?? "?";
    this.info.append(h("h3", {}, id), this.sharesOf(id), ...this.castersText(picked));
    const wrong = this.errors.filter(
      ({ run, polygon }) => run === this.candidate && polygon === id,
    );
    if (wrong.length > 0) this.info.append(this.errorList(wrong));
  }

  private sharesOf(id: string): HTMLElement {
    const body = h("tbody");
    const classes = ["lit", "shadow", "penumbra", "umbra"] as const;
    for (const light of this.sources.result?.lights ?? []) {
      for (const side of light.polygons.filter((each) => each.id === id)) {
        const told = classes
          .filter((name) => side[name])
          .map((name) => `${name} ${percent(Number(side[name]?.fraction))}`);
        const lit = side.lit ? String(side.lit.fraction) : "";
        const why = side.reason ? ` (${side.reason})` : "";
        body.append(
          h(
            "tr",
            { "data-light": light.id, "data-lit": lit },
            h("th", { scope: "row" }, light.id),
            h("td", {}, side.side),
            h("td", { title: told.length > 0 ? `lit: ${lit}` : undefined }, told.join(", ") + why),
          ),
        );
      }
    }
    if (body.children.length === 0) return h("p", {}, "No light was asked about it.");
    return h("table", { class: "shares" }, h("caption", {}, "Exact shares"), body);
  }

  private castersText(picked: Picked): Node[] {
    const fragments = this.three?.fragments;
    if (!fragments) return [];
    const casters = castersOf(fragments, picked.polygon);
    if (casters.length === 0) return [h("p", {}, `Nothing casts on it from light ${this.light}.`)];
    const list = h("ul", { class: "casters", id: freshId("casters") });
    for (const [caster, count] of casters.slice(0, kMostCasters)) {
      const name = this.sources.view.polygons[caster] ?? "?";
      list.append(
        h(
          "li",
          {},
          h(
            "button",
            {
              type: "button",
              class: "link",
              onclick: () => this.three?.showWitness(null, undefined, caster),
            },
            name,
          ),
          ` ${plural(count, "fragment")}`,
        ),
      );
    }
    if (casters.length > kMostCasters) {
      list.append(h("li", {}, `and ${counted(casters.length - kMostCasters)} more`));
    }
    return [h("h4", {}, `Casters from light ${this.light}`), list];
  }

  private errorList(errors: RunError[]): HTMLElement {
    const list = h("ul", { class: "casters" });
    for (const error of errors.slice(0, kMostCasters)) {
      const text = `${error.light}, ${error.side}: ${errorInWords(error.witness)}`;
      list.append(
        h(
          "li",
          {},
          h(
            "button",
            { type: "button", class: "link", onclick: () => this.showError(error) },
            text,
          ),
        ),
      );
    }
    return h("div", {}, h("h4", {}, `Errors of ${this.candidate ?? ""}`), list);
  }

  private describeError(error: RunError): void {
    const { witness, wrong } = error;
    const width = widthOf(witness);
    const facts: [string, Child][] = [
      ["run", error.run],
      ["light", error.light],
      ["polygon", `${error.polygon} (${error.side})`],
      ["found", witness.found ?? "nothing"],
      ["true", witness.true ?? "nothing"],
      ["caster", witness.caster ?? "–"],
      ["place", witness.point ? witness.point.map((x) => rounded(x, 6)).join(", ") : "–"],
      ["width", `${rounded(width)} scene units`],
      ["wrong share", rounded(wrong.misclassified.fraction[1])],
      ["regions", counted(wrong.regions)],
    ];
    if (witness.clearance !== null && witness.clearance !== undefined) {
      facts.push(["undone by", `moving one vertex by ${rounded(witness.clearance)}`]);
    }
    const list = h("dl");
    for (const [name, value] of facts) {
      list.append(h("dt", {}, name), h("dd", { "data-fact": name }, value));
    }
    this.info.replaceChildren(h("h3", {}, "A place of error"), list);
    if (witness.text) this.info.append(h("p", {}, sentence(witness.text)));
    this.picked = null;
  }
}
