// SPDX-License-Identifier: GPL-3.0-or-later
// Puts the page together from the documents that it holds.
import { campaignSections, caseSection, type SceneOf } from "./case_section";
import { decisionSection, errorSection, verdictSection } from "./certificate_section";
import { comparisonSections } from "./comparison_section";
import { corpusSections } from "./corpus_section";
import { readDocument, type Documents, type Result, type View } from "./documents";
import { add, h, section } from "./dom";
import { extremesSections } from "./extremes_section";
import { fillFoot, fillHead } from "./foot";
import { SceneSection } from "./scene_section";
import { shareSection } from "./share_section";
import { tableSections } from "./table_section";
import { tradeoffSections } from "./tradeoff_section";
import { YearSection } from "./year_section";

const kNames = [
  "certificate",
  "scene",
  "result",
  "view",
  "tradeoff",
  "extremes",
  "comparison",
  "campaign",
  "case",
  "corpus",
  "year",
  "tables",
] as const;

function readAll(): Documents {
  const page = readDocument<Documents["page"]>("page");
  if (!page) throw new Error("the page has lost its data");
  const documents: Record<string, unknown> = { page };
  for (const name of kNames) {
    const found = readDocument(name);
    if (found !== undefined) documents[name] = found;
  }
  return documents as unknown as Documents;
}

/** The parts of a page in order, and what is to be done once they are in it. */
function partsOf(documents: Documents): { parts: (HTMLElement | null)[]; start: () => void } {
  const { certificate, view, result, year } = documents;
  if (year) {
    const shown = new YearSection(year, view);
    return { parts: shown.elements, start: () => shown.start() };
  }
  const scene = view ? new SceneSection({ view, result, certificate }) : null;
  const parts: (HTMLElement | null)[] = [];
  if (documents.tables) parts.push(...tableSections(documents.tables));
  if (documents.tradeoff) parts.push(...tradeoffSections(documents.tradeoff));
  if (documents.extremes) parts.push(...extremesSections(documents.extremes));
  if (documents.comparison) parts.push(...comparisonSections(documents.comparison));
  if (documents.corpus) parts.push(...corpusSections(documents.corpus));
  if (documents.campaign) parts.push(...campaignSections(documents.campaign, sceneOf));
  if (documents.case) parts.push(caseSection(documents.case));
  if (certificate) {
    if (certificate.scene_findings.length > 0) {
      const texts = certificate.scene_findings.map((text) => h("p", { class: "note" }, text));
      parts.push(section("bugs", "A bug of Gnomon", ...texts));
    }
    parts.push(verdictSection(certificate));
  }
  if (scene) parts.push(scene.element);
  if (certificate) {
    parts.push(
      errorSection(certificate, scene && ((error) => scene.showError(error, true))),
      decisionSection(certificate),
    );
  }
  if (result) parts.push(shareSection(result, scene && ((id) => scene.showPolygon(id))));
  return { parts, start: () => scene?.start() };
}

const sceneOf: SceneOf = (name) => {
  const view = readDocument<View>(`view-${name}`);
  return view ? { view, result: readDocument<Result>(`result-${name}`) } : null;
};

function start(): void {
  const main = document.getElementById("main");
  if (!main) return;
  const documents = readAll();
  const { parts, start: startParts } = partsOf(documents);
  main.replaceChildren();
  add(
    main,
    documents.page.notes.map((note) => h("p", { class: "remark" }, note)),
  );
  add(main, parts);
  fillHead(documents);
  fillFoot(documents);
  startParts();
  document.documentElement.dataset["ready"] = "true";
}

start();
