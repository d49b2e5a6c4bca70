// SPDX-License-Identifier: GPL-3.0-or-later
// Plots that keep to the width of the page and have words for those who do not see them.
import { plot, type PlotOptions } from "@observablehq/plot";
import { h } from "./dom";

export interface ChartOptions {
  /** What it shows, in a sentence. */
  label: string;
  height?: number;
  /** Of a click on the plot. */
  onclick?: (value: unknown) => void;
}

/** A plot that is drawn again when its width changes. */
export function chart(options: ChartOptions, of: (width: number) => PlotOptions): HTMLElement {
  const figure = h("figure", { class: "chart", role: "group", "aria-label": options.label });
  let drawnAt = 0;
  const draw = (width: number): void => {
    if (width === 0 || width === drawnAt) return;
    drawnAt = width;
    const drawn = plot({
      width,
      height: options.height ?? 320,
      style: { background: "transparent", color: "inherit", fontSize: "12px" },
      ...of(width),
    });
    drawn.setAttribute("role", "img");
    drawn.setAttribute("aria-label", options.label);
    if (options.onclick) {
      drawn.addEventListener("click", () => {
        if (drawn.value) options.onclick?.(drawn.value);
      });
    }
    figure.replaceChildren(drawn, h("figcaption", {}, options.label));
  };
  new ResizeObserver(([entry]) => draw(Math.floor(entry?.contentRect.width ?? 0))).observe(figure);
  return figure;
}

/** Of numbers over many decades: where the decades are; zero has a place left of them. */
export function decades(values: number[]): [number, number] {
  const logs = values.filter((value) => value > 0).map((value) => Math.log10(value));
  if (logs.length === 0) return [-1, 0];
  const low = Math.floor(Math.min(...logs));
  const high = Math.ceil(Math.max(...logs));
  return [low, high > low ? high : low + 1];
}
