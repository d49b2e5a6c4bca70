// SPDX-License-Identifier: GPL-3.0-or-later
// Pages of real runs in a real browser: node browser/run.mjs PROGRAM [FOLDER FOR PICTURES].
// Without Chromium (GNOMON_CHROMIUM, or /usr/bin/chromium) it ends with 77: left out.
import assert from "node:assert/strict";
import { existsSync, mkdirSync, mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { chromium } from "playwright-core";
import { documentsOf, schemaErrors } from "./documents.mjs";
import { coloursOf, columnOf, lowContrast, withoutLabels } from "./inspect.mjs";
import { makeLargePages } from "./large.mjs";
import { makePages } from "./pages.mjs";

const [, , program, pictures] = process.argv;
const executablePath = process.env.GNOMON_CHROMIUM ?? "/usr/bin/chromium";
if (!program) {
  console.error("usage: node browser/run.mjs PROGRAM [FOLDER FOR PICTURES]");
  process.exit(2);
}
if (!existsSync(executablePath)) {
  console.log(`there is no ${executablePath}: left out`);
  process.exit(77);
}

const folder = mkdtempSync(join(tmpdir(), "gnomon-pages-"));
if (pictures) mkdirSync(pictures, { recursive: true });
const pages = makePages(program, folder);
let browser;

before(async () => {
  browser = await chromium.launch({
    executablePath,
    args: [
      "--no-sandbox",
      "--use-gl=angle",
      "--use-angle=swiftshader",
      "--enable-unsafe-swiftshader",
      "--ignore-gpu-blocklist",
    ],
  });
});

after(async () => {
  await browser?.close();
  rmSync(folder, { recursive: true, force: true });
});

/** A page that must say nothing on the console and ask for nothing but itself. */
async function open(file, { width = 1400, colorScheme = "light", measured } = {}) {
  const page = await browser.newPage({
    viewport: { width, height: 900 },
    colorScheme,
    reducedMotion: "reduce",
  });
  page.complaints = [];
  page.on("console", (message) => {
    // The software renderer of the test remarks on reading pictures back.
    if (!/GPU stall|GL Driver Message/.test(message.text())) page.complaints.push(message.text());
  });
  page.on("pageerror", (error) => page.complaints.push(error.stack ?? error.message));
  page.on("request", (request) => {
    const url = request.url();
    if (!/^(data|blob):/.test(url) && url !== `file://${file}`) page.complaints.push(url);
  });
  page.setDefaultTimeout(120_000);
  if (measured) {
    page.session = await page.context().newCDPSession(page);
    await page.session.send("Performance.enable", { timeDomain: "threadTicks" });
  }
  await page.goto(`file://${file}`);
  await page.waitForFunction(() => document.documentElement.dataset.ready === "true");
  return page;
}

async function settle(page) {
  await page.evaluate(() => new Promise((done) => setTimeout(done, 100)));
  await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => done())));
}

async function pictureOf(page, selector) {
  await settle(page);
  const bytes = await page.locator(selector).screenshot();
  return `data:image/png;base64,${bytes.toString("base64")}`;
}

async function close(page) {
  assert.deepEqual(page.complaints, []);
  await page.close();
}

const column = (page, section, key) => page.evaluate(columnOf, { section, key });
const texts = (values) =>
  values.map((value) => (value === null || value === undefined ? "" : String(value)));

test("what pages hold is what the schema says, and the schema says something", () => {
  for (const [name, file] of Object.entries(pages)) {
    assert.deepEqual(schemaErrors(documentsOf(file)), [], name);
  }
  const broken = documentsOf(pages.certificate);
  broken.certificate.runs[0].verdict = "fine";
  delete broken.view.parts.rings;
  assert.equal(schemaErrors(broken).length > 1, true);
});

for (const name of Object.keys(pages)) {
  for (const colorScheme of ["light", "dark"]) {
    for (const width of [1400, 400]) {
      test(`${name}, ${colorScheme}, ${width} pixels`, async () => {
        const page = await open(pages[name], { width, colorScheme });
        await settle(page);
        assert.deepEqual(await page.evaluate(lowContrast), []);
        assert.deepEqual(await page.evaluate(withoutLabels), []);
        const wide = await page.evaluate(() => document.documentElement.scrollWidth);
        assert.equal(wide <= width, true, `${wide} pixels wide`);
        const picture = pictures && join(pictures, `${name}-${colorScheme}-${width}.png`);
        const bytes = await page.screenshot({ ...(picture && { path: picture }) });
        const url = `data:image/png;base64,${bytes.toString("base64")}`;
        assert.equal((await page.evaluate(coloursOf, url)) > 8, true, "a blank page");
        const canvas = page.locator("canvas");
        if ((await canvas.count()) > 0) {
          const drawn = await pictureOf(page, "canvas");
          assert.equal((await page.evaluate(coloursOf, drawn)) >= 4, true, "a blank scene");
        }
        await close(page);
      });
    }
  }
}

test("the numbers of a certificate are those of its JSON", async () => {
  const { certificate, result } = documentsOf(pages.certificate);
  const page = await open(pages.certificate);
  const of = (get) => texts(certificate.runs.map(get));
  assert.deepEqual(
    await column(page, "verdicts", "verdict"),
    of((run) => run.verdict),
  );
  assert.deepEqual(
    await column(page, "verdicts", "worst_share"),
    of((run) => run.totals.worst_share),
  );
  assert.deepEqual(
    await column(page, "verdicts", "width"),
    of((run) => run.totals.width[1]),
  );
  assert.deepEqual(
    await column(page, "verdicts", "cpu_seconds"),
    of((run) => run.cpu_seconds),
  );
  const lit = result.lights.flatMap(({ polygons }) => polygons.map((side) => side.lit.fraction));
  assert.deepEqual(await column(page, "shares", "lit"), texts(lit.slice(0, 12)));
  assert.equal(await page.locator("#foot-digest").innerText(), certificate.geometry);
  const command = await page.locator("#foot-command code").innerText();
  assert.match(command, /^gnomon certify .*courtyard\.json --kernel float/);
  assert.match(await page.locator("#foot-cite").innerText(), /gnomon \d.*sha256/);
  await close(page);
});

test("tables sort by mouse and by keyboard, and filter by words and by value", async () => {
  const page = await open(pages.certificate);
  const header = page.locator('#shares th[data-key="area"]');
  await header.locator("button").click();
  const up = (await column(page, "shares", "area")).map(Number);
  assert.deepEqual(
    up,
    [...up].sort((a, b) => a - b),
  );
  assert.equal(await header.getAttribute("aria-sort"), "ascending");
  await header.locator("button").focus();
  await page.keyboard.press("Enter");
  const down = (await column(page, "shares", "area")).map(Number);
  assert.deepEqual(
    down,
    [...down].sort((a, b) => b - a),
  );
  assert.equal(await header.getAttribute("aria-sort"), "descending");
  await page.locator("#shares input[type=search]").fill("window0 fin");
  const names = await column(page, "shares", "polygon");
  assert.equal(names.length > 0, true);
  for (const each of names) assert.match(each, /window0.*fin/);
  await page.locator("#verdicts select").last().selectOption("failed");
  assert.deepEqual(await column(page, "verdicts", "verdict"), ["failed"]);
  assert.equal(await page.locator("#verdicts .status").innerText(), "1 of 3 rows");
  await close(page);
});

test("an error is picked: the light, the place and the caster are told and drawn", async () => {
  const { certificate } = documentsOf(pages.certificate);
  const page = await open(pages.certificate);
  const before = await pictureOf(page, "#scene-canvas");
  await page.locator("#errors tbody button.pick").first().click();
  const after = await pictureOf(page, "#scene-canvas");
  assert.notEqual(before, after);
  const widest = certificate.runs
    .flatMap((run) => run.wrong)
    .flatMap((side) => [side.worst, ...(side.others ?? [])])
    .filter((witness) => witness?.point)
    .sort((a, b) => b.width[1] - a.width[1])[0];
  const fact = (name) => page.locator(`#scene-info dd[data-fact="${name}"]`).innerText();
  assert.equal(await fact("light"), widest.light);
  assert.equal(await fact("polygon"), `${widest.polygon} (${widest.side})`);
  assert.equal(await fact("found"), widest.found);
  assert.equal(await fact("true"), widest.true);
  assert.equal(await fact("caster"), widest.caster ?? "–");
  assert.equal(await page.locator("#scene-run").inputValue(), "float");
  await close(page);
});

test("toggling, the next error, the light, turning and letting go by keyboard", async () => {
  const page = await open(pages.certificate);
  const run = page.locator("#scene-run");
  await page.locator("#scene-canvas").focus();
  assert.equal(await run.inputValue(), "exact");
  await page.keyboard.press("t");
  assert.equal(await run.inputValue(), "float");
  assert.match(await page.locator("#scene-status").innerText(), /^Shown: float under light/);
  await page.keyboard.press("t");
  assert.equal(await run.inputValue(), "exact");
  await page.locator("#scene-toggle").click();
  assert.equal(await run.inputValue(), "float");
  await page.locator("#scene-canvas").focus();
  const start = await pictureOf(page, "#scene-canvas");
  await page.keyboard.press("ArrowLeft");
  await page.keyboard.press("+");
  const turned = await pictureOf(page, "#scene-canvas");
  assert.notEqual(start, turned);
  await page.keyboard.press("n");
  const first = await page.locator('#scene-info dd[data-fact="place"]').innerText();
  await page.keyboard.press("n");
  assert.notEqual(await page.locator('#scene-info dd[data-fact="place"]').innerText(), first);
  await page.keyboard.press("p");
  assert.equal(await page.locator('#scene-info dd[data-fact="place"]').innerText(), first);
  await page.keyboard.press("Escape");
  assert.match(await page.locator("#scene-info").innerText(), /^Pick a polygon/);
  const light = await page.locator("#scene-light").inputValue();
  await page.keyboard.press("l");
  assert.notEqual(await page.locator("#scene-light").inputValue(), light);
  await page.keyboard.press("Home");
  await close(page);
});

test("a polygon is picked: its shares are those of the JSON", async () => {
  const { result } = documentsOf(pages.certificate);
  const page = await open(pages.certificate);
  const canvas = page.locator("#scene-canvas");
  await canvas.scrollIntoViewIfNeeded();
  await settle(page);
  const box = await canvas.boundingBox();
  // Away from rings: the ground, at the lower edge.
  await page.mouse.click(box.x + box.width / 2, box.y + box.height * 0.97);
  const picked = await page.locator("#scene-info h3").innerText();
  assert.equal(picked, "ground");
  for (const { id, polygons } of result.lights) {
    const side = polygons.find((each) => each.id === picked);
    const row = page.locator(`#scene-info tr[data-light="${id}"]`).first();
    assert.equal(await row.getAttribute("data-lit"), String(side.lit.fraction));
  }
  await canvas.focus();
  await page.keyboard.press("Enter");
  assert.notEqual(await page.locator("#scene-info h3").innerText(), "");
  await close(page);
});

test("area lights have a penumbra", async () => {
  const page = await open(pages.area);
  assert.match(await page.locator("#scene .legend").innerText(), /penumbra/);
  assert.equal(
    (await column(page, "shares", "penumbra")).some((share) => Number(share) > 0),
    true,
  );
  await close(page);
});

test("a trade front has its rows, its front and the command of each", async () => {
  const { tradeoff } = documentsOf(pages.tradeoff);
  const page = await open(pages.tradeoff);
  assert.deepEqual(
    await column(page, "rows", "worst_share"),
    texts(tradeoff.rows.map((row) => row.worst_share)),
  );
  const front = tradeoff.rows.filter(({ on_front }) => on_front);
  assert.equal(await page.locator(".front button").count(), front.length);
  await page.locator(".front button").first().click();
  const command = await page.locator(".chosen code").first().innerText();
  assert.equal(
    front.some((row) => row.command === command),
    true,
  );
  await close(page);
});

test("thresholds and growth are those of the JSON", async () => {
  const { extremes } = documentsOf(pages.extremes);
  const curves = await open(pages.extremes);
  assert.deepEqual(
    await column(curves, "thresholds", "first_failure"),
    texts(extremes.curves.map((curve) => curve.first_failure)),
  );
  await close(curves);
  const { comparison } = documentsOf(pages.comparison);
  const page = await open(pages.comparison);
  assert.deepEqual(
    await column(page, "rows", "ratio"),
    texts(comparison.rows.map((row) => row.ratio)),
  );
  assert.deepEqual(
    await column(page, "growth-1", "exponent"),
    texts(comparison.growth.map((row) => row.exponent)),
  );
  await close(page);
});

test("a finding shows its text, its command and its scene", async () => {
  const { campaign } = documentsOf(pages.campaign);
  const page = await open(pages.campaign);
  assert.deepEqual(
    await column(page, "findings", "signature"),
    campaign.findings.map(({ signature }) => signature),
  );
  await page.locator("#findings .opener").first().click();
  const details = page.locator("#findings tr.details:not([hidden])");
  assert.match(await details.innerText(), /gnomon replay/);
  await details.getByRole("button", { name: "Show the scene" }).click();
  const drawn = await pictureOf(page, "#scene-canvas");
  assert.equal((await page.evaluate(coloursOf, drawn)) >= 3, true);
  await close(page);
});

test("a year: hours of the JSON, a heat map, and the scene at another hour", async () => {
  const { year } = documentsOf(pages.year);
  const page = await open(pages.year);
  const hours = year.hours.map((months) => months.reduce((sum, each) => sum + each, 0));
  assert.deepEqual(await column(page, "hours", "all"), texts(hours.slice(0, 20)));
  const heat = await pictureOf(page, "#year-heat image");
  assert.equal((await page.evaluate(coloursOf, heat)) >= 4, true);
  const noon = await pictureOf(page, "#year-canvas");
  await page.locator("#year-hour").focus();
  for (let i = 0; i < 5; i += 1) await page.keyboard.press("ArrowRight");
  assert.match(await page.locator("#year-status").innerText(), /^21 June, 17:00 to 18:00/);
  assert.notEqual(await pictureOf(page, "#year-canvas"), noon);
  await close(page);
});

test("printed, a page has its tables and no controls", async () => {
  const page = await open(pages.certificate, { colorScheme: "dark" });
  await page.emulateMedia({ media: "print", colorScheme: "light" });
  assert.equal(await page.locator("nav").isVisible(), false);
  assert.equal(await page.locator("#verdicts .controls").isVisible(), false);
  assert.equal(await page.locator("#verdicts table").isVisible(), true);
  assert.equal(await page.locator("#scene-canvas").isVisible(), true);
  assert.deepEqual(await page.evaluate(lowContrast), []);
  await page.close();
});

/** CPU seconds of the page's own thread so far: what others do on the machine does not count. */
async function threadSeconds(session) {
  const { metrics } = await session.send("Performance.getMetrics");
  return metrics.find(({ name }) => name === "ThreadTime").value;
}

test("half a million fragments, and a year of 300 sides, open in time and turn", async () => {
  for (const [name, file] of Object.entries(makeLargePages(folder))) {
    const page = await open(file, { measured: true });
    await settle(page);
    const opened = await threadSeconds(page.session);
    const turns = 10;
    await page.evaluate(async (count) => {
      const canvas = document.querySelector("canvas");
      for (let i = 0; i < count; i += 1) {
        canvas.dispatchEvent(new KeyboardEvent("keydown", { key: "ArrowLeft", bubbles: true }));
        await new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)));
      }
    }, turns);
    const turned = ((await threadSeconds(page.session)) - opened) / turns;
    console.log(
      `# ${name}: opens in ${opened.toFixed(2)} s, turns in ${turned.toFixed(3)} s of CPU`,
    );
    assert.equal(opened < 5, true, `${name}: ${opened} s to open`);
    // Fifteen pictures a second, less what the graphics chip takes.
    assert.equal(turned < 1 / 15, true, `${name}: ${turned} s to turn`);
    await close(page);
  }
});
