// SPDX-License-Identifier: GPL-3.0-or-later
// Pages of real runs, small enough for a test: makePages(PROGRAM, FOLDER) gives them by name.
import { spawnSync } from "node:child_process";
import { readdirSync } from "node:fs";
import { join } from "node:path";

const examples = new URL("../../../../examples/", import.meta.url).pathname;
const few = ["--algorithm", "sectors", "--algorithm", "svbsp", "--repeat", "1"];

const runs = {
  certificate: ["certify", join(examples, "courtyard.json"), "--kernel", "float"].concat([
    ...["--kernel", "double", "--kernel", "plane", "--explain", "--flips", "2"],
  ]),
  area: ["certify", join(examples, "panel-contacts.json"), "--kernel", "float"],
  tradeoff: ["tradeoff", join(examples, "room.json"), ...few].concat([
    ...["--kernel", "float", "--kernel", "double", "--kernel", "plane"],
    ...["--try", "0", "--try", "1e-12", "--try", "1e-4"],
  ]),
  extremes: ["extremes", "offset", ...few, "--steps", "5"].concat([
    ...["--kernel", "float", "--kernel", "double", "--kernel", "plane"],
  ]),
  comparison: ["compare", "city", "--size", "20", "--size", "40", ...few],
  campaign: ["fuzz", "--count", "12", "--kernel", "float", "--generator", "mix", "--keep", "1"],
  year: ["year", join(examples, "courtyard.json"), "--at=51.99,4.35", "--tz", "1"].concat([
    ...["--from", "06-19", "--to", "06-23"],
  ]),
};

function run(program, args) {
  const done = spawnSync(program, args, { encoding: "utf8", maxBuffer: 1 << 28 });
  // 1: a rounded kernel is wrong, which is what is looked at.
  if (done.status !== 0 && done.status !== 1) {
    throw new Error(`gnomon ${args.join(" ")}: status ${done.status}\n${done.stderr}`);
  }
}

export function makePages(program, folder) {
  const pages = {};
  for (const [name, args] of Object.entries(runs)) {
    const directory = join(folder, name);
    const more = name === "campaign" ? ["--findings", join(folder, "findings")] : [];
    run(program, [...args, ...more, "--report", directory]);
    pages[name] = join(directory, "index.html");
  }
  const [finding] = readdirSync(join(folder, "findings"));
  run(program, ["replay", join(folder, "findings", finding), "--report", join(folder, "case")]);
  pages.case = join(folder, "case", "index.html");
  return pages;
}
