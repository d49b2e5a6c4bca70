// SPDX-License-Identifier: GPL-3.0-or-later
// Puts the page together from the documents that it holds.
import { decisionSection, errorSection, verdictSection } from "./certificate_section";
import { readDocument, type Documents } from "./documents";
import { h, section } from "./dom";
import { fillFoot, fillHead } from "./foot";
import { SceneSection } from "./scene_section";
import { shareSection } from "./share_section";

function readAll(): Documents {
  const page = readDocument("page");
  if (!page) throw new Error("the page has lost its data");
  return {
    page,
    certificate: readDocument("certificate"),
    scene: readDocument("scene"),
    result: readDocument("result"),
    view: readDocument("view"),
  } as Documents;
}

function start(): void {
  const main = document.getElementById("main");
  if (!main) return;
  const documents = readAll();
  main.replaceChildren();
  const { certificate, view, result } = documents;
  const scene = view ? new SceneSection({ view, result, certificate }) : null;
  for (const note of documents.page.notes) main.append(h("p", { class: "note" }, note));
  if (certificate) {
    if (certificate.scene_findings.length > 0) {
      main.append(
        section(
          "findings",
          "A bug of Gnomon",
          ...certificate.scene_findings.map((text) => h("p", { class: "note" }, text)),
        ),
      );
    }
    main.append(verdictSection(certificate));
  }
  if (scene) main.append(scene.element);
  if (certificate) {
    const errors = errorSection(certificate, scene && ((error) => scene.showError(error, true)));
    const decisions = decisionSection(certificate);
    if (errors) main.append(errors);
    if (decisions) main.append(decisions);
  }
  if (result) main.append(shareSection(result, scene && ((id) => scene.showPolygon(id))));
  fillHead(documents);
  fillFoot(documents);
  scene?.start();
  document.documentElement.dataset["ready"] = "true";
}

start();
