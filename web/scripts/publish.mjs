// Puts the built page where the C++ library embeds it, or with --check compares the two.
import { copyFileSync, readFileSync, statSync, writeFileSync } from "node:fs";
import { fileURLToPath } from "node:url";

const built = fileURLToPath(new URL("../dist/index.html", import.meta.url));
const committed = fileURLToPath(new URL("../../libs/report/assets/report.html", import.meta.url));
const notices = fileURLToPath(new URL("../dist/licences.txt", import.meta.url));
const committedNotices = fileURLToPath(new URL("../../libs/report/assets/licences.txt", import.meta.url));
const slot = '<script id="hersey-data" type="application/json"></script>';
const largest = 800 * 1024; // three.js is 500 kB of it

function fail(message) {
  console.error(message);
  process.exit(1);
}

const page = readFileSync(built, "utf8");
if (page.split(slot).length !== 2) fail(`${built}: the page must have exactly one place for data: ${slot}`);
if (/(?:src|href)\s*=\s*["']?(?:https?:)?\/\//i.test(page)) fail(`${built}: the page loads something from elsewhere`);
if (statSync(built).size > largest) fail(`${built}: ${statSync(built).size} bytes, at most ${largest} are allowed`);

if (process.argv.includes("--check")) {
  if (readFileSync(committed, "utf8") !== page || readFileSync(committedNotices, "utf8") !== readFileSync(notices, "utf8"))
    fail("libs/report/assets is not what web/ builds: run `npm ci && npm run build` in web/ and commit it");
  console.log("libs/report/assets/report.html is fresh");
} else {
  writeFileSync(committed, page);
  copyFileSync(notices, committedNotices);
  console.log(`libs/report/assets/report.html: ${(page.length / 1024).toFixed(0)} KB`);
}
