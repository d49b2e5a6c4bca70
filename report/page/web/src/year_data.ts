// SPDX-License-Identifier: GPL-3.0-or-later
// A year as a page holds it: shares by time and side, and when a row is.
import { readUint16 } from "./base64";
import type { Year } from "./documents";

const kDay = 24 * 60;

export class YearData {
  readonly stepsOfDay: number;
  readonly days: number;
  private readonly year: Year;
  private readonly lit: Uint16Array | null;
  private readonly suns: Int32Array;

  constructor(year: Year) {
    this.year = year;
    this.stepsOfDay = kDay / year.step_minutes;
    this.days = Math.ceil(year.rows / this.stepsOfDay);
    this.lit = year.lit === undefined ? null : readUint16(year.lit);
    const bytes = Uint8Array.from(atob(year.suns), (c) => c.charCodeAt(0));
    this.suns = new Int32Array(bytes.buffer);
  }

  get hasShares(): boolean {
    return this.lit !== null;
  }

  /** The lit share of a side in a row; null where the page has none. */
  share(row: number, side: number): number | null {
    const { sides, units, rows } = this.year;
    if (!this.lit || row < 0 || row >= rows) return null;
    const value = this.lit[row * sides.length + side];
    return value === undefined ? null : value / units;
  }

  /** Towards the sun; null at night. */
  sun(row: number): [number, number, number] | null {
    const [x = 0, y = 0, z = 0] = this.suns.subarray(row * 3, row * 3 + 3);
    return x === 0 && y === 0 && z === 0 ? null : [x * 1e-6, y * 1e-6, z * 1e-6];
  }

  /** Shares of a side, a row a day and a column a step; NaN by night. */
  heat(side: number): Float64Array {
    const values = new Float64Array(this.days * this.stepsOfDay).fill(Number.NaN);
    for (let row = 0; row < this.year.rows; row += 1) {
      const share = this.share(row, side);
      if (share !== null && this.sun(row)) values[row] = share;
    }
    return values;
  }

  date(day: number): Date {
    const date = new Date(`${this.year.first}T00:00:00Z`);
    date.setUTCDate(date.getUTCDate() + day);
    return date;
  }

  rowAt(day: number, minute: number): number {
    return day * this.stepsOfDay + Math.floor(minute / this.year.step_minutes);
  }

  /** "21 June, 10:00 to 11:00". */
  timeText(row: number): string {
    const day = Math.floor(row / this.stepsOfDay);
    const from = (row % this.stepsOfDay) * this.year.step_minutes;
    const date = this.date(day).toLocaleDateString("en-GB", {
      day: "numeric",
      month: "long",
      timeZone: "UTC",
    });
    return `${date}, ${clock(from)} to ${clock(from + this.year.step_minutes)}`;
  }
}

export function clock(minutes: number): string {
  const two = (value: number): string => String(value).padStart(2, "0");
  return `${two(Math.floor(minutes / 60))}:${two(minutes % 60)}`;
}

/** "wall#back" is the back of wall; what is gross is of a whole wall's front. */
export function polygonOfSide(side: string): { polygon: string; kind: string } {
  const at = side.indexOf("#");
  return at < 0
    ? { polygon: side, kind: "front" }
    : { polygon: side.slice(0, at), kind: side.slice(at + 1) };
}
