// SPDX-License-Identifier: GPL-3.0-or-later
// Campaigns and single cases: what failed, on which scene, and the command that shows it again.
import type { Campaign, CampaignFinding, Case, CaseFailure, Result, View } from "./documents";
import { command, h, section } from "./dom";
import { counted, percent, plural, rounded } from "./numbers";
import { SceneSection } from "./scene_section";
import { Table } from "./table";

/** The scene of a finding, from the page. */
export type SceneOf = (name: string) => { view: View; result?: Result | undefined } | null;

export function campaignSections(campaign: Campaign, sceneOf: SceneOf): HTMLElement[] {
  const sections = [findingSection(campaign, sceneOf), kindSection(campaign)];
  return sections;
}

export function countsOf(campaign: Campaign, prefix: string): [string, number][] {
  return Object.entries(campaign.counts)
    .filter(([name]) => name.startsWith(prefix))
    .map(([name, count]) => [name.slice(prefix.length), count]);
}

function findingSection(campaign: Campaign, sceneOf: SceneOf): HTMLElement {
  const host = h("div", { id: "finding-scene" });
  const table = new Table<CampaignFinding>({
    caption: "Findings, one row each",
    rows: campaign.findings,
    details: (finding) => [
      h("p", {}, finding.text),
      finding.folder ? h("p", {}, "Shrunken: ", h("code", {}, finding.folder)) : null,
      h("p", {}, command(finding.replay)),
      sceneButton(finding, campaign.findings.indexOf(finding), sceneOf, host),
    ],
    columns: [
      { key: "signature", label: "failure", value: (finding) => finding.signature },
      {
        key: "scenes",
        label: "scenes",
        title: "That fail in this way",
        value: (finding) => campaign.counts[`failure:${finding.signature}`] ?? null,
      },
      { key: "case", label: "case", value: (finding) => finding.case },
      { key: "recipe", label: "made by", value: (finding) => finding.recipe },
      { key: "light", label: "light", value: (finding) => finding.light, facet: true },
      { key: "polygon", label: "polygon", value: (finding) => finding.polygon },
    ],
  });
  const held = campaign.findings.length === 0;
  return section(
    "findings",
    "Findings",
    h(
      "p",
      { class: "lead" },
      `${plural(campaign.cases, "scene")}, ${counted(campaign.failing_cases)} of them with a failure` +
        (held ? ": every property held." : "."),
    ),
    ...campaign.missing_kinds.map((kind) =>
      h("p", { class: "note" }, `No scene was of the kind ${kind}.`),
    ),
    held ? null : table.element,
    host,
  );
}

/** `place`: of the finding among all. */
function sceneButton(
  finding: CampaignFinding,
  place: number,
  sceneOf: SceneOf,
  host: HTMLElement,
): HTMLElement {
  const name = String(place);
  const buttons = [
    ["", "Show the scene"],
    ["-shrunken", "Show the shrunken scene"],
  ].map(([suffix = "", label = ""]) => {
    if (!sceneOf(name + suffix)) return null;
    return h(
      "button",
      {
        type: "button",
        onclick: () => {
          const found = sceneOf(name + suffix);
          if (!found) return;
          const scene = new SceneSection(found);
          host.replaceChildren(
            h("h3", {}, `Case ${finding.case}: ${finding.signature}`),
            scene.element,
          );
          scene.start();
          const polygon = finding.polygon.replace(/#back$/, "");
          if (polygon) scene.showPolygon(polygon);
        },
      },
      label,
    );
  });
  return h("p", { class: "controls" }, ...buttons);
}

function kindSection(campaign: Campaign): HTMLElement {
  const table = new Table<[string, number]>({
    caption: "Of which kinds the scenes were",
    rows: countsOf(campaign, "kind:"),
    sortBy: { key: "scenes", descending: true },
    pageSize: 20,
    columns: [
      { key: "kind", label: "kind", value: ([kind]) => kind },
      {
        key: "scenes",
        label: "scenes",
        value: ([, count]) => count,
        show: ([, count]) => counted(count),
      },
      {
        key: "share",
        label: "share",
        value: ([, count]) => count / Math.max(1, campaign.cases),
        show: ([, count]) => percent(count / Math.max(1, campaign.cases)),
      },
    ],
  });
  const checked = countsOf(campaign, "subject:").map(
    ([name, count]) => `${name} ${counted(count)}`,
  );
  return section(
    "kinds",
    "What was made and checked",
    h("p", { class: "lead" }, `Checked: ${checked.join(", ") || "nothing"}.`),
    h("p", { class: "lead" }, `Answers ${campaign.answers}.`),
    table.element,
  );
}

export function caseSection(found: Case): HTMLElement {
  const table = new Table<CaseFailure>({
    caption: "Failures, one row each",
    rows: found.failures,
    details: (failure) => [h("p", {}, failure.text)],
    columns: [
      { key: "property", label: "property", value: (failure) => failure.property, facet: true },
      { key: "class", label: "class", value: (failure) => failure.class, facet: true },
      { key: "subject", label: "subject", value: (failure) => failure.subject, facet: true },
      { key: "light", label: "light", value: (failure) => failure.light },
      { key: "polygon", label: "polygon", value: (failure) => failure.polygon },
      {
        key: "width",
        label: "width",
        value: (failure) => failure.width,
        show: (failure) => (failure.width === null ? "–" : rounded(failure.width)),
      },
      {
        key: "share",
        label: "wrong share",
        value: (failure) => failure.share,
        show: (failure) => rounded(failure.share),
      },
      { key: "cause", label: "cause", value: (failure) => failure.cause ?? null },
    ],
  });
  const size = `${plural(found.polygons, "polygon")}, ${plural(found.lights, "light")}`;
  const subjects = found.subjects.join(", ");
  return section(
    "failures",
    found.failures.length > 0 ? "Failures" : "Every property holds",
    h("p", { class: "lead" }, `${size}; checked: ${subjects}.`),
    found.failures.length > 0 ? table.element : null,
  );
}
