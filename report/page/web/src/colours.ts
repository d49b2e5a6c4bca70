// SPDX-License-Identifier: GPL-3.0-or-later
// One set of colours for pictures and plots, chosen to be told apart by all eyes and on both
// grounds. Verdicts have a word besides, never a colour alone.

export type Rgb = [number, number, number];

/** Of a class of fragments. */
export const kClassColours: Record<string, Rgb> = {
  lit: [246, 222, 150],
  shadow: [82, 98, 140],
  penumbra: [158, 140, 170],
  umbra: [52, 58, 96],
};
/** Of what no light was asked about: backs, and polygons without fragments. */
export const kUnlitColour: Rgb = [150, 152, 156];
export const kMarkColour = "#d1345b";
export const kCasterColour = "#e07a1f";
export const kPickColour = "#1b9e77";
export const kRayColour = "#d99000";

/** Kernels and runs, by their place in a list. */
export const kSeries = [
  "#1f77b4",
  "#d95f02",
  "#1b9e77",
  "#c2458f",
  "#8a6d00",
  "#6a51a3",
  "#5e6a71",
  "#a6321c",
  "#2b8cbe",
];

export const css = ([r, g, b]: Rgb): string => `rgb(${r}, ${g}, ${b})`;

/** From shade to sun, for shares that are lit. */
export function litColour(share: number): Rgb {
  const dark: Rgb = [52, 58, 96];
  const middle: Rgb = [190, 120, 110];
  const light: Rgb = [253, 231, 150];
  const [a, b, t] = share < 0.5 ? [dark, middle, share * 2] : [middle, light, share * 2 - 1];
  return [0, 1, 2].map((i) => Math.round((a[i] ?? 0) + t * ((b[i] ?? 0) - (a[i] ?? 0)))) as Rgb;
}

/** The tone of a verdict or of how a run ended: a class of the style sheet. */
export function toneOf(verdict: string | undefined): string {
  switch (verdict) {
    case "identical":
    case "pass":
    case "right":
      return "good";
    case "within tolerance":
    case "shares agree":
      return "fine";
    case undefined:
    case "":
    case "not judged":
    case "not asked":
    case "-":
      return "none";
    default:
      return "bad";
  }
}
