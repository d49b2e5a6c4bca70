// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers as text: three digits where they are measured, all of them where they are counted.

const kDigits = 3;

/** A measured number: "0", "1.46e-14", "0.848", "1,850". */
export function rounded(value: number, digits = kDigits): string {
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size >= 1e-3 && size < 1e6) {
    const whole = Math.floor(Math.log10(size)) + 1;
    if (whole >= digits) return counted(Math.round(value));
    return String(Number(value.toPrecision(digits)));
  }
  return value
    .toExponential(digits - 1)
    .replace(/\.?0+e/, "e")
    .replace("e+", "e");
}

/** A counted number, in groups of three digits. */
export function counted(value: number): string {
  return String(value).replace(/\B(?=(\d{3})+(?!\d))/g, ",");
}

/** A share as a percentage that is never 0 % or 100 % unless it is. */
export function percent(share: number): string {
  if (share === 0) return "0 %";
  if (share === 1) return "100 %";
  if (share > 0.9995 && share < 1) return "> 99.9 %";
  if (share > 0 && share < 0.0005) return "< 0.1 %";
  return `${(share * 100).toFixed(1)} %`;
}

/** Seconds in the unit that people would use. */
export function duration(seconds: number): string {
  if (seconds < 1e-3) return `${rounded(seconds * 1e6)} µs`;
  if (seconds < 1) return `${rounded(seconds * 1e3)} ms`;
  return `${rounded(seconds)} s`;
}

export function plural(count: number, one: string, many = `${one}s`): string {
  return `${counted(count)} ${count === 1 ? one : many}`;
}

/** A text that ends as a sentence does. */
export function sentence(text: string): string {
  return /[.!?]$/.test(text) ? text : `${text}.`;
}
