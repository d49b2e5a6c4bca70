// SPDX-License-Identifier: GPL-3.0-or-later
// Bundles the page into a C++ source: node build.mjs OUTPUT.cc; or as it is: OUTPUT.html. The page
// is everything but its data; what it may weigh is a promise of docs/report.md.
import { readdirSync, readFileSync, writeFileSync } from "node:fs";
import { build } from "esbuild";

const kMostBytes = 1_000_000;
// Compilers promise to take no more in one string.
const kPieceBytes = 60_000;
const kDataMark = "<!-- data -->";

async function bundled(entry, options) {
  return build({
    entryPoints: [entry],
    bundle: true,
    minify: true,
    write: false,
    metafile: true,
    target: ["es2021"],
    charset: "ascii",
    legalComments: "none",
    logLevel: "warning",
    ...options,
  });
}

const textOf = (result) => result.outputFiles[0].text.trim();

// What is bundled is under licences that ask for their text in every copy: each once, with the
// packages that it is of.
function notices(metafile) {
  const packages = new Set();
  for (const file of Object.keys(metafile.inputs)) {
    const found = file.match(/^node_modules\/((?:@[^/]+\/)?[^/]+)\//);
    if (found) packages.add(found[1]);
  }
  const texts = new Map();
  for (const name of [...packages].sort()) {
    const folder = `node_modules/${name}`;
    const file = readdirSync(folder).find((each) => /^licen[cs]e/i.test(each));
    if (!file) throw new Error(`${name} has no licence`);
    const { version } = JSON.parse(readFileSync(`${folder}/package.json`, "utf8"));
    const text = readFileSync(`${folder}/${file}`, "utf8").trim();
    texts.set(text, [...(texts.get(text) ?? []), `${name} ${version}`]);
  }
  const parts = [...texts].map(([text, names]) => `${names.join(", ")}:\n${text}`);
  return parts.join("\n\n").replaceAll(/-{2,}/g, "-");
}

// Octal escapes, which end after three digits, for what is no plain character.
function literal(bytes) {
  let text = "";
  for (const byte of bytes) {
    if (byte === 0x0a) text += "\\n";
    else if (byte === 0x22) text += '\\"';
    else if (byte === 0x5c) text += "\\\\";
    else if (byte === 0x3f)
      text += "\\?"; // no trigraphs
    else if (byte >= 0x20 && byte < 0x7f) text += String.fromCharCode(byte);
    else text += `\\${byte.toString(8).padStart(3, "0")}`;
  }
  return `"${text}"`;
}

function pieces(text) {
  const bytes = Buffer.from(text, "utf8");
  const literals = [];
  for (let at = 0; at < bytes.length; at += kPieceBytes) {
    literals.push(`    ${literal(bytes.subarray(at, at + kPieceBytes))}sv,`);
  }
  return literals.join("\n");
}

const bundle = await bundled("src/main.ts", { format: "iife" });
const script = textOf(bundle);
const style = textOf(await bundled("src/page.css", {}));
if (/<\/script|<!--/i.test(script)) throw new Error("the script would end its own element");
const page = readFileSync("src/page.html", "utf8")
  .replace("/* style */", () => style)
  .replace("/* script */", () => script)
  .replace("<!-- notices -->", () => `<!--\n${notices(bundle.metafile)}\n-->`);
const bytes = Buffer.byteLength(page);
if (bytes > kMostBytes) throw new Error(`the page has ${bytes} bytes, more than ${kMostBytes}`);
const [before, after] = page.split(kDataMark);
const source = `// Made by report/page/web/build.mjs.
#include "report/page/page_text.h"

namespace gnomon::report {

namespace {

using namespace std::string_view_literals;

constexpr std::string_view kBefore[] = {
${pieces(before)}
};

constexpr std::string_view kAfter[] = {
${pieces(after)}
};

}  // namespace

PageText page_text() { return {kBefore, kAfter}; }

}  // namespace gnomon::report
`;
const output = process.argv[2];
writeFileSync(output, output.endsWith(".html") ? page : source);
console.log(`page: ${bytes} bytes`);
