// Puts the built workbench where the C++ library embeds it, or with --check compares the two.
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { fileURLToPath } from "node:url";
import { gzipSync } from "node:zlib";

const built = (name) => fileURLToPath(new URL(`../dist/workbench/${name}`, import.meta.url));
const committed = (name) => fileURLToPath(new URL(`../../libs/workbench/assets/${name}`, import.meta.url));
const files = ["index.html", "workbench.js", "workbench.css", "licences.txt"];
const largest = 1.5e6; // compressed, of all

function fail(message) {
  console.error(message);
  process.exit(1);
}

const texts = files.map((name) => readFileSync(built(name), "utf8"));
if (/<script(?![^>]*\bsrc=)[^>]*>/.test(texts[0])) fail(`${built(files[0])}: it has a script of its own, which the page's policy forbids`);
if (/(?:src|href)\s*=\s*["']?(?:https?:)?\/\//i.test(texts[0])) fail(`${built(files[0])}: the page loads something from elsewhere`);
const size = texts.reduce((sum, text) => sum + gzipSync(text, { level: 9 }).length, 0);
if (size > largest) fail(`the workbench takes ${size} bytes compressed, at most ${largest} are allowed`);

if (process.argv.includes("--check")) {
  const old = files.filter((name, i) => readFileSync(committed(name), "utf8") !== texts[i]);
  if (old.length > 0) fail(`libs/workbench/assets: ${old.join(", ")} is not what web/workbench builds: run \`npm ci && npm run build:workbench\` in web/ and commit it`);
  console.log("libs/workbench/assets is fresh");
} else {
  mkdirSync(committed("."), { recursive: true });
  files.forEach((name, i) => writeFileSync(committed(name), texts[i]));
  console.log(`libs/workbench/assets: ${(size / 1024).toFixed(0)} KB compressed`);
}
