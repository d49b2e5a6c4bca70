// SPDX-License-Identifier: GPL-3.0-or-later
// A year: a heat map of day and hour for one side, all sides at one time in the scene, hours by
// month.
import { axisX, axisY, raster } from "@observablehq/plot";
import { chart } from "./charts";
import { css, kUnlitColour, litColour } from "./colours";
import type { View, Year } from "./documents";
import { field, h, section } from "./dom";
import { counted, percent, plural, rounded } from "./numbers";
import { Table } from "./table";
import { SceneView } from "./view3d";
import { clock, polygonOfSide, YearData } from "./year_data";

const kMonths = [
  "Jan",
  "Feb",
  "Mar",
  "Apr",
  "May",
  "Jun",
  "Jul",
  "Aug",
  "Sep",
  "Oct",
  "Nov",
  "Dec",
];

interface SideRow {
  side: string;
  index: number;
  months: number[];
  all: number;
}

export class YearSection {
  readonly elements: HTMLElement[];
  private readonly year: Year;
  private readonly view: View | undefined;
  private readonly data: YearData;
  private readonly sideSelect = h("select", { id: "year-side" });
  private readonly heatHost = h("div", { id: "year-heat" });
  private readonly readout = h("p", { class: "status", role: "status", id: "year-readout" });
  private readonly daySlider: HTMLInputElement;
  private readonly hourSlider: HTMLInputElement;
  private readonly host = h("div", { class: "canvas" });
  private readonly sceneStatus = h("p", { class: "status", role: "status", id: "year-status" });
  private readonly info = h("div", { class: "info", id: "year-info", "aria-live": "polite" });
  private readonly sidesOfPolygon = new Map<string, number[]>();
  private readonly table: Table<SideRow>;
  private readonly rows: SideRow[];
  private three: SceneView | null = null;
  private side = 0;

  constructor(year: Year, view: View | undefined) {
    this.year = year;
    this.view = view;
    this.data = new YearData(year);
    const slider = (id: string, max: number, value: number): HTMLInputElement =>
      h("input", { id, type: "range", min: 0, max, step: 1, value, oninput: () => this.paint() });
    this.daySlider = slider("year-day", this.data.days - 1, this.usualDay());
    this.hourSlider = slider("year-hour", this.data.stepsOfDay - 1, this.data.stepsOfDay / 2);
    year.sides.forEach((side, index) => {
      const { polygon } = polygonOfSide(side);
      this.sidesOfPolygon.set(polygon, [...(this.sidesOfPolygon.get(polygon) ?? []), index]);
    });
    this.rows = year.sides.map((side, index) => {
      const months = year.hours[index] ?? [];
      return { side, index, months, all: months.reduce((sum, hours) => sum + hours, 0) };
    });
    this.side = this.firstSide();
    this.table = this.hourTable();
    this.elements = [
      this.heatSection(),
      ...(view ? [this.sceneSection()] : []),
      this.hourSection(),
    ];
  }

  start(): void {
    this.showSide(this.side);
    if (!this.view) return;
    try {
      this.three = new SceneView(this.view);
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
    three.canvas.id = "year-canvas";
    three.canvas.tabIndex = 0;
    three.canvas.setAttribute("role", "application");
    three.canvas.setAttribute("aria-label", "The scene, coloured by the lit share of each polygon");
    three.canvas.setAttribute("aria-describedby", "year-keys");
    three.canvas.addEventListener("keydown", (event) => this.key(event));
    three.onPick = (picked) => {
      if (picked) this.pickPolygon(picked.polygon, picked.back);
    };
    this.host.append(three.canvas);
    this.info.append(h("p", { class: "hint" }, "Pick a polygon to see its sides at this time."));
    this.paint();
  }

  /** The longest day of what is there, or the middle. */
  private usualDay(): number {
    for (let day = 0; day < this.data.days; day += 1) {
      const date = this.data.date(day);
      if (date.getUTCMonth() === 5 && date.getUTCDate() === 21) return day;
    }
    return Math.floor(this.data.days / 2);
  }

  /** One that has sun and shade. */
  private firstSide(): number {
    const daylight = this.year.daylight.reduce((sum, hours) => sum + hours, 0);
    const off = ({ all }: SideRow): number => Math.abs(all - daylight * 0.3);
    return [...this.rows].sort((a, b) => off(a) - off(b))[0]?.index ?? 0;
  }

  private heatSection(): HTMLElement {
    for (const [index, side] of this.year.sides.entries()) {
      this.sideSelect.append(h("option", { value: index }, side));
    }
    this.sideSelect.addEventListener("change", () => this.showSide(Number(this.sideSelect.value)));
    const { year } = this;
    return section(
      "heat",
      "Day by hour",
      h(
        "p",
        { class: "lead" },
        `${plural(year.sides.length, "side")}, ${counted(year.rows)} times of ${year.step_minutes} minutes, ` +
          `at ${year.latitude}, ${year.longitude}; kernel ${year.kernel}.`,
      ),
      h("div", { class: "controls" }, field("year-side", "Side", this.sideSelect)),
      this.heatHost,
      scale(),
      this.readout,
    );
  }

  private sceneSection(): HTMLElement {
    return section(
      "scene",
      "The scene at one time",
      h(
        "div",
        { class: "controls" },
        field("year-day", "Day", this.daySlider),
        field("year-hour", "Hour", this.hourSlider),
        h("button", { type: "button", onclick: () => this.three?.reset() }, "Whole scene"),
      ),
      this.sceneStatus,
      h("div", { class: "scene" }, this.host, this.info),
      h(
        "p",
        { class: "keys", id: "year-keys" },
        "Drag to turn, wheel to zoom, click a polygon for its heat map. Arrow keys turn, + and - " +
          "zoom, Home shows the whole scene, Enter picks what is in the middle. Of a polygon with two " +
          "sides the lighter one is shown.",
      ),
    );
  }

  private hourTable(): Table<SideRow> {
    const daylight = this.year.daylight.reduce((sum, hours) => sum + hours, 0);
    return new Table<SideRow>({
      caption: "Hours of sun, one row a side",
      rows: this.rows,
      pageSize: 20,
      pick: (row) => {
        this.showSide(row.index);
        this.heatHost.closest("section")?.scrollIntoView({ block: "start" });
      },
      pickLabel: (row) => `Show the heat map of ${row.side}`,
      columns: [
        { key: "side", label: "side", value: ({ side }) => side },
        {
          key: "all",
          label: "all",
          title: `Of ${rounded(daylight)} hours of daylight`,
          value: ({ all }) => all,
          show: ({ all }) => rounded(all, 4),
        },
        ...kMonths.map((month, i) => ({
          key: month,
          label: month,
          value: ({ months }: SideRow) => months[i] ?? null,
          show: ({ months }: SideRow) => rounded(months[i] ?? 0),
        })),
      ],
    });
  }

  private hourSection(): HTMLElement {
    const daylight = this.year.daylight.reduce((sum, hours) => sum + hours, 0);
    return section(
      "hours",
      "Hours of sun",
      h("p", { class: "lead" }, `The sun is up for ${counted(Math.round(daylight))} hours.`),
      this.table.element,
    );
  }

  private showSide(side: number): void {
    this.side = side;
    this.sideSelect.value = String(side);
    const row = this.rows[side];
    if (row) this.table.select(row);
    if (!this.data.hasShares) {
      const why = this.year.left_out ?? "the page has no shares";
      this.heatHost.replaceChildren(
        h("p", { class: "note" }, `There is no heat map: ${why}. Hours by month are below.`),
      );
      return;
    }
    this.heatHost.replaceChildren(this.heatMap());
    this.read(this.data.rowAt(Number(this.daySlider.value), 12 * 60));
  }

  private heatMap(): HTMLElement {
    const { data } = this;
    const values = data.heat(this.side);
    const { days, stepsOfDay } = data;
    // A picture's rows run down, its columns right: hours and days.
    const turned = new Float64Array(values.length);
    for (let day = 0; day < days; day += 1) {
      for (let step = 0; step < stepsOfDay; step += 1) {
        turned[step * days + day] = values[day * stepsOfDay + step] ?? Number.NaN;
      }
    }
    const name = this.year.sides[this.side] ?? "?";
    const months = Array.from({ length: days }, (_, day) => day).filter(
      (day) => data.date(day).getUTCDate() === 1 || (days < 40 && day % 7 === 0),
    );
    const label = `Lit share of ${name}: days to the right, hours upwards; nights are empty.`;
    const figure = chart({ label, height: 300 }, () => ({
      marginLeft: 44,
      marginBottom: 30,
      x: { domain: [0, days], label: null },
      y: { domain: [0, 24], label: "hour" },
      color: {
        type: "linear",
        domain: [0, 1],
        interpolate: (t: number) => css(litColour(t)),
      },
      marks: [
        raster(turned, {
          width: days,
          height: stepsOfDay,
          x1: 0,
          x2: days,
          y1: 0,
          y2: 24,
          imageRendering: "pixelated",
        } as never),
        axisX(months, { tickFormat: (day: number) => this.dayLabel(day) }),
        axisY([0, 6, 12, 18, 24], {}),
      ],
    }));
    figure.addEventListener("pointermove", (event) => this.followPointer(figure, event));
    figure.addEventListener("click", (event) => {
      const row = this.followPointer(figure, event);
      if (row === null) return;
      this.daySlider.value = String(Math.floor(row / stepsOfDay));
      this.hourSlider.value = String(row % stepsOfDay);
      this.paint();
    });
    return figure;
  }

  private dayLabel(day: number): string {
    const date = this.data.date(day);
    const month = kMonths[date.getUTCMonth()] ?? "";
    return date.getUTCDate() === 1 ? month : `${date.getUTCDate()} ${month}`;
  }

  /** Tells the cell below the pointer, and which row it is. */
  private followPointer(figure: HTMLElement, event: MouseEvent): number | null {
    const image = figure.querySelector("image");
    if (!image) return null;
    const box = image.getBoundingClientRect();
    const x = (event.clientX - box.left) / box.width;
    const y = 1 - (event.clientY - box.top) / box.height;
    if (x < 0 || x >= 1 || y < 0 || y >= 1) return null;
    const row = this.data.rowAt(Math.floor(x * this.data.days), y * 24 * 60);
    this.read(row);
    return row;
  }

  private read(row: number): void {
    const name = this.year.sides[this.side] ?? "?";
    const share = this.data.share(row, this.side);
    const night = this.data.sun(row) === null;
    const told = night ? "night" : share === null ? "unknown" : `${percent(share)} lit`;
    this.readout.textContent = `${name}, ${this.data.timeText(row)}: ${told}`;
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
      "-": () => three.zoom(1 / 0.85),
      Home: () => three.reset(),
      Enter: () => {
        const { clientWidth, clientHeight } = three.canvas;
        const picked = three.pick(clientWidth / 2, clientHeight / 2);
        if (picked) this.pickPolygon(picked.polygon, picked.back);
      },
    };
    const act = actions[event.key];
    if (!act) return;
    event.preventDefault();
    act();
  }

  private get row(): number {
    return Number(this.daySlider.value) * this.data.stepsOfDay + Number(this.hourSlider.value);
  }

  /** Colours the scene by the time of the sliders. */
  private paint(): void {
    const { row, data, view, three } = this;
    this.daySlider.setAttribute("aria-valuetext", this.dayLabel(Number(this.daySlider.value)));
    this.hourSlider.setAttribute(
      "aria-valuetext",
      clock(Number(this.hourSlider.value) * this.year.step_minutes),
    );
    const sun = data.sun(row);
    this.sceneStatus.textContent = data.timeText(row) + (sun ? "" : ": night");
    if (!view || !three) return;
    const shares = view.polygons.map((polygon) => {
      const sides = this.sidesOfPolygon.get(polygon) ?? [];
      const told = sides
        .filter((side) => polygonOfSide(this.year.sides[side] ?? "").kind !== "gross")
        .map((side) => data.share(row, side))
        .filter((share): share is number => share !== null);
      return told.length > 0 ? Math.max(...told) : null;
    });
    three.paintPolygons((polygon) => {
      const share = shares[polygon];
      return typeof share === "number" ? litColour(sun ? share : 0) : kUnlitColour;
    });
    three.showLight(sun ? { id: "sun", to_light: sun } : undefined);
  }

  private pickPolygon(polygon: number, back: boolean): void {
    const id = this.view?.polygons[polygon] ?? "?";
    const sides = this.sidesOfPolygon.get(id) ?? [];
    this.three?.highlightPolygon(polygon);
    const wanted = sides.find(
      (side) => polygonOfSide(this.year.sides[side] ?? "").kind === (back ? "back" : "front"),
    );
    const side = wanted ?? sides[0];
    const list = h("ul", { class: "casters" });
    for (const each of sides) {
      const name = this.year.sides[each] ?? "?";
      const share = this.data.share(this.row, each);
      list.append(
        h(
          "li",
          {},
          h("button", { type: "button", class: "link", onclick: () => this.showSide(each) }, name),
          share === null ? "" : ` ${percent(share)} lit`,
        ),
      );
    }
    this.info.replaceChildren(h("h3", {}, id), h("p", {}, this.data.timeText(this.row)), list);
    if (side !== undefined) this.showSide(side);
  }
}

function scale(): HTMLElement {
  const steps = [0, 0.25, 0.5, 0.75, 1];
  return h(
    "ul",
    { class: "legend", "aria-label": "Colours" },
    ...steps.map((share) =>
      h(
        "li",
        {},
        h("span", { class: "swatch", style: `background: ${css(litColour(share))}` }),
        percent(share),
      ),
    ),
  );
}
