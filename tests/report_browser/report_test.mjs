// node report_test.mjs REPORT.html ...: opens reports in headless Chromium and checks that they work.
// Needs `npm ci` in web/ and a Chromium (CHROMIUM=/path/to/it, default /usr/bin/chromium).
import { existsSync } from "node:fs";
import { createRequire } from "node:module";
import { resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { bearingReport, everyReport, comparisonReport, machineReport, studyReport, sweepReport, modesReport } from "./checks.mjs";

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

let passed = 0;
let failed = 0;

async function check(name, test) {
  try {
    await test();
    passed++;
    console.log(`  ok    ${name}`);
  } catch (error) {
    failed++;
    console.log(`  FAIL  ${name}\n        ${error.message.split("\n").join("\n        ")}`);
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
    if (target !== url && !target.startsWith("data:") && !target.startsWith("blob:")) complaints.push(`request to ${target}`);
  });
  await page.goto(url);
  await page.waitForSelector("figure canvas, .fault", { timeout: 15000 });
  return { page, complaints };
}

async function testReport(browser, file) {
  console.log(file);
  let opened;
  await check("opens", async () => {
    opened = await open(browser, file);
  });
  if (!opened) return;
  const { page, complaints } = opened;
  const isStudy = (await page.locator(".study").count()) > 0;
  const isComparison = isStudy && (await page.locator(".study h2").first().innerText()).includes("compared");
  const isBearing = (await page.locator(".solution").count()) > 0;
  const isModes = (await page.locator(".mode-player").count()) > 0;
  const isMachine = (await page.locator(".assumptions .owners").count()) > 0;
  const tests = isModes
    ? modesReport
    : isBearing
      ? { ...(isStudy ? sweepReport : {}), ...bearingReport }
      : isMachine
        ? machineReport
        : { ...(isComparison ? comparisonReport : {}), ...(isStudy ? studyReport : {}), ...everyReport };
  for (const [name, test] of Object.entries(tests)) await check(name, () => test(page));
  await check("nothing on the console and nothing over the network", async () => {
    if (complaints.length > 0) throw new Error(complaints.join("\n"));
  });
  await page.close();
}

const files = process.argv.slice(2).map((file) => resolve(file));
const executablePath = process.env.CHROMIUM ?? "/usr/bin/chromium";
if (files.length === 0) giveUp("usage: node report_test.mjs REPORT.html ...");
for (const file of files) if (!existsSync(file)) giveUp(`${file}: there is no such report`);
if (!existsSync(executablePath)) giveUp(`${executablePath}: there is no Chromium; set CHROMIUM to its path`);

const browser = await playwright().chromium.launch({ executablePath, args: flags });
for (const file of files) await testReport(browser, file);
await browser.close();
console.log(`${passed} passed, ${failed} failed`);
process.exit(failed > 0 ? 1 : 0);
