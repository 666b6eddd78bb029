// What the journeys stand on: a folder of models, the program that serves it, a browser, and what became of each claim.
import { spawn } from "node:child_process";
import { cpSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath } from "node:url";

const require = createRequire(new URL("../../web/package.json", import.meta.url));
const root = fileURLToPath(new URL("../..", import.meta.url));
const flags = [
  "--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist", "--disable-quic", "--no-first-run", "--disable-background-networking",
  "--disable-component-update", "--disable-sync",
];

export const axeSource = readFileSync(require.resolve("axe-core/axe.min.js"), "utf8");

export function launch() {
  return require("playwright-core").chromium.launch({ executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium", args: flags });
}

/** A folder with the slider-crank, its table, a four-bar linkage, bearings by themselves and a mesh. */
export function folderOfModels() {
  const folder = mkdtempSync(join(tmpdir(), "hersey-workbench-"));
  for (const name of ["model.yaml", "gas_pressure.csv"]) cpSync(join(root, "examples/slider_crank", name), join(folder, name));
  cpSync(join(root, "examples/four_bar/model.yaml"), join(folder, "four_bar.yaml"));
  cpSync(join(root, "examples/bearing_alone/model.yaml"), join(folder, "bearing.yaml"));
  // A groove whose place is no multiple of what a key moves it by.
  const groove = readFileSync(join(root, "examples/hot_bearing/model.yaml"), "utf8").replace("angle: 90 deg, arc: 20 deg, length: 45 mm", "angle: 90.5 deg, z: 1.2 mm, arc: 20 deg, length: 20 mm");
  writeFileSync(join(folder, "groove.yaml"), groove);
  cpSync(join(root, "examples/meshes/conrod.msh"), join(folder, "conrod.msh"));
  return folder;
}

/** The text of a chain of bodies that hinges join and springs hold. */
export function chainOfBodies(count) {
  const numbers = [...Array(count).keys()];
  const body = (i) => `  link_${i}:
    mass: 0.5 kg
    centre_of_mass: 25 0 0 mm
    inertia: {xx: 1e-5 kg.m^2, yy: 2e-4 kg.m^2, zz: 2e-4 kg.m^2}
    frames: {end: {origin: 50 0 0 mm}}
    shapes: {bar: {shape: capsule, to: 50 0 0 mm, diameter: 8 mm}}
`;
  const hinge = (i) => `  hinge_${i}: {type: revolute, between: [${i === 0 ? "ground" : `link_${i - 1}.end`}, link_${i}], axis: z}\n`;
  const spring = (i) => `  spring_${i}: {type: spring_damper, between: [ground.anchor, link_${i}.end], stiffness: 10 N/m, damping: 1 N.s/m, free_length: 100 mm}\n`;
  return `hersey: 1
title: Chain of ${count} bodies
gravity: 0 -9.81 0 m/s^2
bodies:
  ground: {frames: {anchor: {origin: 0 1000 0 mm}}}
${numbers.map(body).join("")}joints:
${numbers.map(hinge).join("")}forces:
${numbers.map(spring).join("")}simulation:
  duration: 10 ms
  step: 1 ms
`;
}

export const forget = (folder) => rmSync(folder, { recursive: true, force: true });

/** `hersey open`, once it has printed its address. @param how  further options of the process, such as its user */
export function serve(program, folder, port, how = {}) {
  return new Promise((resolve, reject) => {
    const child = spawn(program, ["open", folder, "--no-browser", ...(port ? ["--port", String(port)] : [])], { stdio: ["ignore", "pipe", "pipe"], ...how });
    let said = "";
    const hear = (text) => {
      said += text;
      const found = /http:\/\/127\.0\.0\.1:(\d+)\/#token=([0-9a-f]+)/.exec(said);
      if (found) resolve({ address: found[0], port: Number(found[1]), token: found[2], child, stop: () => stop(child) });
    };
    child.stdout.on("data", hear);
    child.stderr.on("data", hear);
    child.on("exit", (code) => reject(new Error(`hersey open ended with ${code}: ${said}`)));
  });
}

function stop(child) {
  return new Promise((resolve) => {
    if (child.exitCode !== null || child.signalCode !== null) return resolve();
    child.on("exit", resolve);
    child.kill("SIGKILL");
  });
}

/** Said of each claim, with how long it took where that is more than a second. */
export class Findings {
  held = 0;
  failed = 0;

  constructor(only = "") {
    this.only = only;
  }

  async check(name, test) {
    if (this.only && !new RegExp(this.only).test(name)) return;
    const start = performance.now();
    try {
      await test();
      this.held++;
      const seconds = (performance.now() - start) / 1000;
      console.log(`  ok    ${name}${seconds > 1 ? `, ${seconds.toFixed(1)} s` : ""}`);
    } catch (error) {
      this.failed++;
      console.log(`  FAIL  ${name}\n        ${String(error.message).split("\n").slice(0, 12).join("\n        ")}`);
    }
  }
}

export function claim(is, words) {
  if (!is) throw new Error(words);
}

/** Opens the workbench and notes what a page must not say; `known` answers of the server are part of a journey. */
export async function open(context, address, known = /$^/) {
  const page = await context.newPage();
  page.setDefaultTimeout(30_000); // of machines that do much else
  page.complaints = [];
  page.on("console", (message) => {
    if (["error", "warning"].includes(message.type()) && !known.test(`${message.text()} ${message.location().url}`)) page.complaints.push(`${message.type()}: ${message.text()} ${message.location().url}`);
  });
  page.on("pageerror", (error) => page.complaints.push(`uncaught: ${error.stack}`));
  page.on("request", (request) => {
    if (!/^(http:\/\/127\.0\.0\.1|data:|blob:)/.test(request.url())) page.complaints.push(`request to ${request.url()}`);
    if (/token/.test(request.url()) || /token/.test(request.headers().referer ?? "")) page.complaints.push(`the token leaves with ${request.url()}`);
  });
  await page.goto(address);
  await page.waitForSelector(".bench, .token-page");
  return page;
}

/** The text in the editor, all of it. */
export const textOf = (page) =>
  page.evaluate(() => {
    const content = document.querySelector(".cm-content");
    return (content.cmTile ?? content.cmView).view.state.doc.toString();
  });

/** Waits until the text has some words, or no longer has them. */
export async function says(page, words, has = true) {
  for (let i = 0; i < 600; i++) {
    if ((await textOf(page)).includes(words) === has) return;
    await page.waitForTimeout(50);
  }
  throw new Error(`the text ${has ? "does not say" : "still says"} ${words}`);
}

/** Opens a file of the list; a text is the one shown when this returns. */
export const showFile = async (page, name) => {
  const file = `.file[data-path="${name}"]`;
  await page.locator(file).click();
  if (/\.(yaml|csv)$/.test(name)) await page.locator(`${file}[aria-current="true"]`).waitFor();
};

/** What the top bar says of the model, once it begins so. */
export const state = (page, words) => page.locator(".check-state", { hasText: words }).waitFor();

/** Requests of the page to `address` wait until the function that this gives is called. */
export async function delayed(page, address) {
  let go;
  const gate = new Promise((resolve) => (go = resolve));
  const waiting = [];
  await page.route(address, (route) => {
    const going = gate.then(() => route.continue());
    waiting.push(going);
    return going;
  });
  return async () => {
    go();
    for (const going of waiting) await going;
    await page.unroute(address);
  };
}

/** Waits until a condition is true. */
export async function until(words, condition) {
  for (let i = 0; i < 600; i++) {
    if (await condition()) return;
    await new Promise((resolve) => setTimeout(resolve, 50));
  }
  throw new Error(words);
}

/** Puts the cursor behind the first place of some words. */
export async function goTo(page, words) {
  await page.evaluate((t) => {
    const content = document.querySelector(".cm-content");
    const { view } = content.cmTile ?? content.cmView;
    const at = view.state.doc.toString().indexOf(t);
    if (at < 0) throw new Error(`the text does not say ${t}`);
    view.dispatch({ selection: { anchor: at + t.length }, scrollIntoView: true });
    view.focus();
  }, words);
}

/** Line of the cursor, as text. */
export const cursorLine = (page) =>
  page.evaluate(() => {
    const content = document.querySelector(".cm-content");
    const { state } = (content.cmTile ?? content.cmView).view;
    return state.doc.lineAt(state.selection.main.head).text;
  });

/** Axe-core's findings; in the second scheme of colours those of contrast alone, since all others are the same. */
export async function accessibilityFaults(page, scheme) {
  await page.emulateMedia({ colorScheme: scheme });
  await page.waitForTimeout(100);
  await page.evaluate(axeSource);
  const rules = scheme === "dark" ? { runOnly: ["color-contrast"] } : {};
  const { violations } = await page.evaluate((options) => globalThis.axe.run(document, options), { resultTypes: ["violations"], iframes: false, ...rules });
  return violations.map(({ id, impact, nodes }) => `${impact} ${id}: ${nodes.slice(0, 3).map((node) => `${node.target.join(" ")} ${node.any[0]?.message ?? ""}`).join("; ")}`);
}
