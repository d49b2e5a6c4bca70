// SPDX-License-Identifier: GPL-3.0-or-later
// Head and foot: what this page is of, how it is made again, and how it is cited.
import type { Documents } from "./documents";
import { add, command, h } from "./dom";
import { planDetails } from "./share_section";

const kTitles: Record<string, string> = {
  certify: "Certificate",
  tradeoff: "Speed against accuracy",
  extremes: "Where kernels begin to fail",
  compare: "Systems beside each other",
  fuzz: "Campaign",
  replay: "One case again",
  year: "The suns of a year",
};

export function fillHead(documents: Documents): void {
  const { page } = documents;
  const title = kTitles[page.command] ?? page.command;
  document.title = page.scene ? `${title}: ${page.scene}` : title;
  const nav = h("nav", { "aria-label": "Sections" });
  document
    .getElementById("top")
    ?.append(
      h("p", { class: "brand" }, "Gnomon"),
      h("h1", {}, title, page.scene ? h("span", { class: "of" }, ` ${page.scene}`) : null),
      nav,
    );
  for (const part of document.querySelectorAll<HTMLElement>("main > section")) {
    nav.append(h("a", { href: `#${part.id}` }, part.querySelector("h2")?.textContent ?? part.id));
  }
}

export function fillFoot(documents: Documents): void {
  const { page, scene } = documents;
  const foot = document.getElementById("foot");
  if (!foot) return;
  const digest =
    documents.certificate?.geometry ?? documents.year?.geometry ?? scene?.geometry ?? null;
  const facts = h("dl");
  add(facts, [
    h("dt", {}, "command"),
    h("dd", { id: "foot-command" }, command(page.command_line)),
    h("dt", {}, "version"),
    h("dd", { id: "foot-version" }, page.program),
  ]);
  if (digest) {
    add(facts, [h("dt", {}, "scene"), h("dd", { id: "foot-digest" }, h("code", {}, digest))]);
  }
  add(facts, [
    h("dt", {}, "beside this page"),
    h(
      "dd",
      {},
      ...page.files.flatMap((file, i) => [
        i > 0 ? ", " : "",
        h("a", { href: fileLink(file) }, file),
      ]),
    ),
    h("dt", {}, "cite as"),
    h(
      "dd",
      { id: "foot-cite" },
      `${page.program}, exact shadows of polygon scenes; ${page.command_line}` +
        (digest ? `; geometry ${digest}` : ""),
    ),
  ]);
  foot.append(h("h2", { class: "off-screen" }, "About this page"), facts);
  const plan = scene ? planDetails(scene) : null;
  if (plan) foot.append(plan);
}

const fileLink = (file: string): string => encodeURIComponent(file).replaceAll("%2B", "+");
