// SPDX-License-Identifier: GPL-3.0-or-later
// The JSON documents in a page: what schema/report.schema.json describes, as types.

export type Point = [number, number, number];
/** Bounds of a number. */
export type Enclosure = [number, number];

export interface PageHead {
  format: "gnomon-page";
  command: string;
  command_line: string;
  program: string;
  scene: string;
  files: string[];
  notes: string[];
}

export interface Witness {
  block?: string;
  light: string;
  polygon: string;
  side: string;
  error: string;
  point?: Point;
  found?: string | null;
  true?: string | null;
  caster?: string;
  width?: Enclosure;
  clearance?: number | null;
  text?: string;
}

export interface Share {
  zero: boolean;
  exact?: string;
  fraction: Enclosure;
  area: Enclosure;
}

export interface WrongSide {
  block?: string;
  light: string;
  polygon: string;
  side: string;
  fragments: number;
  regions: number;
  invented: number;
  lost: number;
  lit: Share;
  misclassified: Share;
  uncovered: Share;
  overlapping: Share;
  outside: Share;
  width: Enclosure;
  worst?: Witness;
  others?: Witness[];
}

export interface Effect {
  ended: boolean;
  changed_sides: number;
  classes: boolean | number;
}

export interface Flip {
  predicate: string;
  light: string | null;
  polygon: string | null;
  ulps: number | null;
  exact: string;
  kernel: string;
  answers: number;
  text: string;
  effect: Effect;
}

export interface Decisions {
  differing: number;
  answers: number;
  cannot_be_flipped: number;
  flipped: Flip[];
  together: Effect;
  kernel: Effect;
}

export interface Totals {
  polygons: number;
  wrong_polygons: number;
  regions: number;
  invented: number;
  lost: number;
  worst_share: number;
  misclassified: Enclosure;
  width: Enclosure;
}

export interface Run {
  candidate?: string;
  kernel?: string;
  algorithm?: string;
  exact?: boolean;
  identity?: boolean;
  thickness?: number;
  fragments: number;
  cpu_seconds?: number;
  error?: string;
  verdict?: string;
  counts?: boolean;
  reason?: string;
  excess?: string;
  tolerance?: number;
  width?: number;
  diagonal?: number;
  worst?: Witness | null;
  problems?: string[];
  notes?: string[];
  totals?: Totals;
  wrong?: WrongSide[];
  first_difference?: string;
  decisions?: Decisions;
}

export interface Certificate {
  format: "gnomon-certificate";
  scene: string;
  geometry: string;
  numbers: string;
  polygons: number;
  parts: number;
  lights: string[];
  facing_area: number;
  scene_findings: string[];
  interrupted?: boolean;
  runs: Run[];
}

export interface PlanStep {
  predicate: string;
  degree: number;
  direction_degree: number;
  bits: number;
  integers: string;
}

export interface SceneFacts {
  format: "gnomon-info";
  scene: string;
  geometry: string;
  numbers: string;
  polygons: number;
  parts: number;
  diagonal: number;
  grid_step: string;
  position_bits: number;
  direction_bits: number;
  point_light_plan?: PlanStep[];
  directional_light_plan?: PlanStep[];
  area_light_plan?: PlanStep[];
}

export interface ClassShare {
  fraction: number | string;
  area?: number;
}

export interface ResultSide {
  id: string;
  side: string;
  area: number;
  lit?: ClassShare;
  shadow?: ClassShare;
  penumbra?: ClassShare;
  umbra?: ClassShare;
  reason?: string;
}

export interface Result {
  format: "gnomon-result";
  kernel: string;
  algorithm: string;
  lights: { id: string; polygons: ResultSide[] }[];
}

export interface ViewLight {
  id: string;
  position?: Point;
  to_light?: Point;
  loop?: Point[];
}

export interface ViewLayer {
  run: string;
  light: string;
  background?: string;
  left_out?: string;
  fragments?: number;
  polygon?: string;
  side?: string;
  state?: string;
  caster?: string;
  level?: string;
  rings?: string;
  points?: string;
}

export interface View {
  format: "gnomon-view";
  states: string[];
  centre: Point;
  radius: number;
  polygons: string[];
  lights: ViewLight[];
  parts: { polygon: string; rings: string; points: string };
  layers: ViewLayer[];
}

export interface TradeoffRow {
  scene: string;
  polygons: number;
  lights: string;
  system: string;
  kernel: string;
  thickness: number | null;
  change?: string;
  end: string;
  why?: string;
  cpu_seconds?: number;
  peak_bytes?: number;
  fragments?: number;
  verdict?: string;
  wrong?: number;
  worst_share?: number;
  width?: number;
  invented?: number;
  lost?: number;
  breaks?: string;
  sides_that_differ?: number;
  differ_by_at_most?: number;
  on_front: boolean;
  command: string;
}

export interface Tradeoff {
  format: "gnomon-tradeoff";
  interrupted: boolean;
  contradictions: string[];
  rows: TradeoffRow[];
  thickness: {
    scene: string;
    lights: string;
    system: string;
    kernel: string;
    tried: number;
    judged: number;
    right: [number, number][];
  }[];
}

export interface CurveStep {
  k: number;
  failure: string;
  worst_share: number | null;
  width: number | null;
  cpu_seconds: number;
  command: string;
}

export interface Curve {
  axis: string;
  value: string;
  system: string;
  kernel: string;
  thickness: number | null;
  first_failure: number | null;
  last_right: number | null;
  steps: CurveStep[];
}

export interface Extremes {
  format: "gnomon-extremes";
  interrupted: boolean;
  contradictions: string[];
  curves: Curve[];
}

export interface ComparisonRow {
  scene: string;
  size: number | null;
  polygons: number;
  system: string;
  kernel: string;
  end: string;
  why?: string;
  verdict?: string;
  wrong?: number;
  breaks?: string;
  reason?: string;
  fragments?: number;
  work?: Record<string, number>;
  checksum?: string;
  cpu_seconds?: number;
  peak_bytes?: number;
  ratio?: number | null;
  command: string;
}

export interface Comparison {
  format: "gnomon-comparison";
  interrupted: boolean;
  contradictions: string[];
  rows: ComparisonRow[];
  growth?: { scene: string; system: string; kernel: string; exponent: number; sizes: number }[];
}

export interface CampaignFinding {
  signature: string;
  case: number;
  seed: string;
  generator: string;
  recipe: string;
  light: string;
  polygon: string;
  text: string;
  folder: string;
  replay: string;
}

export interface Campaign {
  format: "gnomon-campaign";
  plan: string;
  cases: number;
  failing_cases: number;
  answers: string;
  interrupted?: boolean;
  counts: Record<string, number>;
  missing_kinds: string[];
  findings: CampaignFinding[];
}

export interface CaseFailure {
  property: string;
  class: string;
  subject: string;
  light: string;
  polygon: string;
  text: string;
  width: number | null;
  share: number;
  cause?: string;
}

export interface Case {
  format: "gnomon-case";
  name: string;
  polygons: number;
  lights: number;
  subjects: string[];
  failures: CaseFailure[];
}

export interface Corpus {
  format: "gnomon-corpus-report";
  tolerance: number;
  subjects: { name: string; exact: boolean; failures: number }[];
  files: {
    name: string;
    kind: string;
    expected: string;
    oracle?: string;
    outcomes: Record<string, string>;
    reasons: Record<string, string>;
  }[];
}

export interface Year {
  format: "gnomon-year";
  scene: string;
  geometry: string;
  kernel: string;
  latitude: number;
  longitude: number;
  zone_minutes: number;
  first: string;
  step_minutes: number;
  rows: number;
  sides: string[];
  /** Millionths of x, y and up, three int32 a row; 0, 0, 0 by night. */
  suns: string;
  units: number;
  left_out?: string;
  /** uint16 by row and side, in units of 1 / `units`. */
  lit?: string;
  /** Hours of sun by side and month. */
  hours: number[][];
  daylight: number[];
}

export interface WrongCounts {
  all: number;
  value: number;
  night: number;
  range: number;
}

/** A certificate of tables: its runs tell shares and no places. */
export interface Tables {
  format: "gnomon-certificate";
  scene: string;
  geometry: string;
  runs: {
    candidate: string;
    verdict: string;
    reason: string;
    told_shares: number;
    wrong: WrongCounts;
    worst: {
      polygon: string;
      time: string;
      error: string;
      found: number;
      found_text: string;
      true: number;
      off: number | null;
      casters?: { polygon: string; share: number }[];
    }[];
    surfaces: { polygon: string; side: string; gross?: boolean; wrong: WrongCounts }[];
  }[];
}

export interface Documents {
  page: PageHead;
  certificate?: Certificate;
  scene?: SceneFacts;
  result?: Result;
  view?: View;
  tradeoff?: Tradeoff;
  extremes?: Extremes;
  comparison?: Comparison;
  campaign?: Campaign;
  case?: Case;
  corpus?: Corpus;
  year?: Year;
  tables?: Tables;
}

/** Reads one document from its element; a page holds those that its command wrote. */
export function readDocument<Type>(name: string): Type | undefined {
  const element = document.getElementById(`gnomon-data-${name}`);
  return element ? (JSON.parse(element.textContent ?? "") as Type) : undefined;
}
