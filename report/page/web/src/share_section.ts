// SPDX-License-Identifier: GPL-3.0-or-later
// The exact shares of all polygon sides, and where the exactness comes from.
import type { PlanStep, Result, ResultSide, SceneFacts } from "./documents";
import { h, section } from "./dom";
import { counted, rounded } from "./numbers";
import { Table, type Column } from "./table";

interface ShareRow {
  light: string;
  side: ResultSide;
}

const kClasses = ["lit", "shadow", "penumbra", "umbra"] as const;

export function shareSection(result: Result, show: ((id: string) => void) | null): HTMLElement {
  const rows: ShareRow[] = result.lights.flatMap((light) =>
    light.polygons.map((side) => ({ light: light.id, side })),
  );
  const classes = kClasses.filter((name) => rows.some(({ side }) => side[name]));
  const columns: Column<ShareRow>[] = [
    { key: "polygon", label: "polygon", value: ({ side }) => side.id },
    { key: "side", label: "side", value: ({ side }) => side.side },
    { key: "light", label: "light", value: ({ light }) => light, facet: true },
    {
      key: "area",
      label: "area",
      title: "Scene units squared",
      value: ({ side }) => side.area,
      show: ({ side }) => rounded(side.area),
    },
    ...classes.map((name) => ({
      key: name,
      label: name,
      title: `Share of the side that is ${name}`,
      value: ({ side }: ShareRow) => (side[name] ? Number(side[name].fraction) : null),
      show: ({ side }: ShareRow) => (side[name] ? rounded(Number(side[name].fraction), 4) : "–"),
    })),
    { key: "reason", label: "dark because", value: ({ side }) => side.reason ?? null, facet: true },
  ];
  const table = new Table<ShareRow>({
    caption: "Exact shares of polygon sides",
    rows,
    columns,
    pageSize: 12,
    ...(show && {
      pick: ({ side }: ShareRow) => show(side.id),
      pickLabel: ({ side }: ShareRow) => `Show ${side.id} in the scene`,
    }),
  });
  return section(
    "shares",
    "Exact shares",
    h("p", { class: "lead" }, `By kernel ${result.kernel}, method ${result.algorithm}.`),
    table.element,
  );
}

/** What exact arithmetic needs on this scene. */
export function planDetails(facts: SceneFacts): HTMLElement | null {
  const plans: [string, PlanStep[] | undefined][] = [
    ["point lights", facts.point_light_plan],
    ["directional lights", facts.directional_light_plan],
    ["area lights", facts.area_light_plan],
  ];
  const rows = plans.flatMap(([lights, steps]) => (steps ?? []).map((step) => ({ lights, step })));
  if (rows.length === 0) return null;
  const most = Math.max(...rows.map(({ step }) => step.bits));
  const table = new Table<(typeof rows)[number]>({
    caption: "Bits that each predicate needs",
    rows,
    pageSize: 60,
    columns: [
      { key: "predicate", label: "predicate", value: ({ step }) => step.predicate },
      { key: "lights", label: "lights", value: ({ lights }) => lights, facet: true },
      { key: "degree", label: "degree", value: ({ step }) => step.degree },
      { key: "bits", label: "bits", value: ({ step }) => step.bits },
      { key: "integers", label: "integers", value: ({ step }) => step.integers },
    ],
  });
  return h(
    "details",
    {},
    h(
      "summary",
      {},
      `Precision plan: coordinates of ${counted(facts.position_bits)} bits on a grid of ` +
        `${facts.grid_step}, at most ${counted(most)} bits in a predicate`,
    ),
    table.element,
  );
}
