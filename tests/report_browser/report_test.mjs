// node report_test.mjs REPORT.html ...: opens reports in headless Chromium and checks that they work, two at a time.
// Needs `npm ci` in web/, a Chromium (CHROMIUM=/path/to/it, default /usr/bin/chromium) and pdftotext (poppler-utils).
import { existsSync, readFileSync, statSync } from "node:fs";
import { createRequire } from "node:module";
import { resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { bearingReport, besideReport, everyReport, comparisonReport, machineReport, runReport, runUpReport, spectraReport, studyReport, sweepReport, modesReport } from "./checks.mjs";
import { padReport, padRunReport, padStateReport, padSweepReport } from "./pad_checks.mjs";
import { ringReport, ringSweepReport } from "./ring_checks.mjs";
import { samplingReport } from "./sampling_checks.mjs";

const flags = [
  "--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist", "--disable-quic", "--no-first-run", "--disable-background-networking",
  "--disable-component-update", "--disable-sync",
];

function giveUp(message) {
  console.error(message);
  process.exit(2);
}

function playwright() {
  try {
    return createRequire(new URL("../../web/package.json", import.meta.url))("playwright-core");
  } catch {
    return giveUp("playwright-core is missing: run `npm ci` in web/");
  }
}

function axe() {
  try {
    return readFileSync(createRequire(new URL("../../web/package.json", import.meta.url)).resolve("axe-core/axe.min.js"), "utf8");
  } catch {
    return giveUp("axe-core is missing: run `npm ci` in web/");
  }
}

const axeSource = axe();

/** What became of one report's checks, reported as a whole, since another report is tried at the same time. */
class Findings {
  passed = 0;
  failed = 0;
  lines = [];

  /** Says of what takes longer than a second how long. */
  async check(name, test) {
    const start = performance.now();
    try {
      await test();
      this.passed++;
      const seconds = (performance.now() - start) / 1000;
      this.lines.push(`  ok    ${name}${seconds > 1 ? `, ${seconds.toFixed(1)} s` : ""}`);
    } catch (error) {
      this.failed++;
      this.lines.push(`  FAIL  ${name}\n        ${error.message.split("\n").join("\n        ")}`);
    }
  }
}

/** Opens a report and notes everything a silent report must not do. */
async function open(browser, file) {
  const page = await browser.newPage({ viewport: { width: 1280, height: 900 }, colorScheme: "light" });
  page.setDefaultTimeout(20000);
  const url = pathToFileURL(file).href;
  const complaints = [];
  page.on("console", (message) => {
    if (["error", "warning"].includes(message.type())) complaints.push(`console ${message.type()}: ${message.text()}`);
  });
  page.on("pageerror", (error) => complaints.push(`uncaught: ${error.message}`));
  page.on("request", (request) => {
    const target = request.url();
    const isBeside = target.startsWith(url.replace(/\.html$/, "_fields/"));
    if (target !== url && !isBeside && !target.startsWith("data:") && !target.startsWith("blob:")) complaints.push(`request to ${target}`);
  });
  await page.goto(url);
  await page.waitForSelector("figure canvas, .svg-plot, .fault", { timeout: 15000 });
  return { page, complaints };
}

/** Axe-core's findings that keep somebody out, with all sections open. */
async function accessibilityFaults(page, { width, height, scheme, contrast }) {
  await page.setViewportSize({ width, height });
  await page.emulateMedia({ colorScheme: scheme });
  await page.evaluate(() => document.querySelectorAll("details").forEach((d) => (d.open = true)));
  await page.waitForTimeout(300); // sections draw when they open
  await page.evaluate(axeSource);
  const { violations } = await page.evaluate((options) => globalThis.axe.run(document, options), {
    resultTypes: ["violations"],
    rules: { "color-contrast": { enabled: contrast } },
  });
  return violations
    .filter(({ impact }) => impact === "serious" || impact === "critical")
    .map(({ id, nodes }) => `${id}: ${nodes.slice(0, 3).map((node) => node.target.join(" ")).join("; ")}`);
}

const controls = "button, select, summary, input, a[href], [tabindex='0']";

/** The visible controls that no press of Tab has focused yet. */
const untouched = (page) =>
  page.evaluate(
    (selector) =>
      [...document.querySelectorAll(selector)]
        .filter((e) => e.checkVisibility() && !e.disabled && e.type !== "radio" && !e.hasAttribute("data-tab"))
        .map((e) => `${e.tagName.toLowerCase()} "${(e.getAttribute("aria-label") ?? e.textContent).trim().slice(0, 40)}"`),
    controls,
  );

/** What a keyboard does not reach. Sections draw once they come into sight, and some of their controls exist only
 *  then: how many presses it takes shows on the way, up to three times what the page has in the end. */
async function keyboardFaults(page) {
  await page.evaluate(() => {
    document.activeElement?.blur();
    document.querySelectorAll("[data-tab]").forEach((e) => e.removeAttribute("data-tab"));
  });
  for (let presses = 0; ; presses += 20) {
    const left = await untouched(page);
    const count = await page.locator(controls).count();
    if (left.length === 0 || presses > 3 * count + 60) return left;
    for (let i = 0; i < 20; i++) {
      await page.keyboard.press("Tab");
      await page.evaluate(() => document.activeElement?.setAttribute("data-tab", ""));
    }
  }
}

async function testAccess(page, findings) {
  // Contrast takes most of the time and is the scheme's, hardly the width's: each scheme is tried in one width, each width in one scheme.
  const looks = [
    { width: 1366, height: 768, scheme: "light", contrast: true },
    { width: 1366, height: 768, scheme: "dark", contrast: false },
    { width: 390, height: 844, scheme: "light", contrast: false },
    { width: 390, height: 844, scheme: "dark", contrast: true },
  ];
  for (const look of looks)
    await findings.check(`axe-core finds nothing serious at ${look.width} x ${look.height}, ${look.scheme}${look.contrast ? "" : ", contrast left out"}`, async () => {
      const faults = await accessibilityFaults(page, look);
      if (faults.length > 0) throw new Error(faults.join("\n"));
    });
  await findings.check("the keyboard reaches every control", async () => {
    const faults = await keyboardFaults(page);
    if (faults.length > 0) throw new Error(faults.slice(0, 10).join("\n"));
  });
}

async function testReport(browser, file) {
  const findings = new Findings();
  let opened;
  await findings.check("opens", async () => {
    opened = await open(browser, file);
  });
  if (!opened) return findings;
  const { page, complaints } = opened;
  const isStudy = (await page.locator(".study").count()) > 0;
  const isComparison = isStudy && (await page.locator(".study h2").first().innerText()).includes("compared");
  const isBearing = (await page.locator(".solution").count()) > 0;
  const isModes = (await page.locator(".mode-player").count()) > 0;
  const isMachine = (await page.locator(".assumptions .owners").count()) > 0;
  const isRunUp = (await page.locator("h1").innerText()).startsWith("A run-up");
  const hasMore = (await page.getByRole("button", { name: /^Load all/ }).count()) > 0;
  const isSampling = (await page.locator('[data-figure="parallel"]').count()) > 0;
  const ofSimulation = { ...(isComparison ? comparisonReport : {}), ...(isStudy ? studyReport : runReport), ...(isStudy && !isComparison ? spectraReport : {}), ...everyReport };
  const isRing = (await page.locator('[data-figure="map-outer"]').count()) > 0;
  const ofBearing = isRing ? (isStudy ? ringSweepReport : ringReport) : { ...(isStudy ? sweepReport : {}), ...bearingReport };
  const isPad = (await page.locator("h1").innerText()).startsWith("A pad");
  const isState = (await page.locator(".figure.state").count()) > 0;
  const ofPad = isBearing ? { ...(isStudy ? padSweepReport : {}), ...padReport } : isState ? padStateReport : padRunReport;
  const tests = isPad ? ofPad : isSampling ? samplingReport : isRunUp ? runUpReport : hasMore ? besideReport : isModes ? modesReport : isBearing ? ofBearing : isMachine ? machineReport : ofSimulation;
  for (const [name, test] of Object.entries(tests)) await findings.check(name, () => test(page));
  await testAccess(page, findings);
  await findings.check("nothing on the console and nothing over the network", async () => {
    if (complaints.length > 0) throw new Error(complaints.join("\n"));
  });
  await page.close();
  return findings;
}

const files = process.argv.slice(2).map((file) => resolve(file));
const executablePath = process.env.CHROMIUM ?? "/usr/bin/chromium";
if (files.length === 0) giveUp("usage: node report_test.mjs REPORT.html ...");
for (const file of files) if (!existsSync(file)) giveUp(`${file}: there is no such report`);
if (!existsSync(executablePath)) giveUp(`${executablePath}: there is no Chromium; set CHROMIUM to its path`);

// A browser needs little more than one core. The largest report first: the last one to be tried is tried alone.
const waiting = files.sort((a, b) => statSync(b).size - statSync(a).size);
let passed = 0;
let failed = 0;

async function testWaiting() {
  const browser = await playwright().chromium.launch({ executablePath, args: flags });
  for (let file = waiting.shift(); file; file = waiting.shift()) {
    const start = performance.now();
    const findings = await testReport(browser, file);
    console.log([`${file}, ${((performance.now() - start) / 1000).toFixed(0)} s`, ...findings.lines].join("\n"));
    passed += findings.passed;
    failed += findings.failed;
  }
  await browser.close();
}

await Promise.all([testWaiting(), testWaiting()]);
console.log(`${passed} passed, ${failed} failed`);
process.exit(failed > 0 ? 1 : 0);
