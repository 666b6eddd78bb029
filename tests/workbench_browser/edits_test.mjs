// node edits_test.mjs PROGRAM [PICTURES] [ONLY]: texts that are changed by hand in pictures and forms, and mended where they
// are wrong; reports of the folder. See bench.mjs.
import { cpSync, mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { join, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { accessibilityFaults, claim, cursorLine, Findings, folderOfModels, forget, goTo, launch, open, says, serve, state, textOf, until } from "./bench.mjs";

const [program, pictures = "build/web-test/workbench", only] = process.argv.slice(2);
if (!program) {
  console.error("usage: node edits_test.mjs PROGRAM [PICTURES] [ONLY]");
  process.exit(2);
}
mkdirSync(pictures, { recursive: true });
const root = fileURLToPath(new URL("../..", import.meta.url));
const picture = (page, name) => page.screenshot({ path: join(pictures, `${name}.png`) });
const folder = folderOfModels();
cpSync(join(root, "examples/lobed_bores/partial_arc.yaml"), join(folder, "arc.yaml"));
cpSync(join(root, "examples/lobed_bores/model.yaml"), join(folder, "lobes.yaml"));
const small = readFileSync(join(root, "tests/cli/bearing.yaml"), "utf8");
writeFileSync(join(folder, "small.yaml"), small);
const findings = new Findings(only);
const begun = performance.now();
const server = await serve(resolve(program), folder);
const browser = await launch();
const context = await browser.newContext({ viewport: { width: 1280, height: 720 }, colorScheme: "light" });
const page = await open(context, server.address);
const openFile = async (name) => {
  await page.locator(`.file[data-path="${name}"]`).click();
  await page.locator('.documents .tab[aria-selected="true"]', { hasText: name }).waitFor();
};
const rightTab = (name) => page.locator(".right").getByRole("tab", { name }).click();
const undo = async (text) => {
  await page.locator(".cm-content").focus();
  for (let i = 0; i < 30 && (await textOf(page)) !== text; i++) await page.keyboard.press("Control+z");
  claim((await textOf(page)) === text, "undo does not give the first text");
};
/** Arc of the text: where it begins and ends [deg]. */
const ends = async () => {
  const [, middle, arc] = /middle: (-?[\d.]+) deg, arc: ([\d.]+) deg/.exec(await textOf(page)).map(Number);
  return [middle - arc / 2, middle + arc / 2];
};

await findings.check("an arc's start and end are moved by the mouse and by keys; the other end stays", async () => {
  await openFile("arc.yaml");
  await state(page, "Ready");
  const original = await textOf(page);
  await rightTab("Bearing");
  const end = page.locator('.unwrapped .handle[data-feature="arc below to"]');
  await end.waitFor();
  await end.focus();
  await page.keyboard.press("ArrowRight");
  await until("the end has not moved by a degree", async () => (await ends()).join() === "-140,-19");
  await page.locator('.unwrapped .handle[data-feature="arc below to"][aria-label*="-19°"], .unwrapped .handle[data-feature="arc below to"][aria-label*="−19°"]').waitFor();
  claim((await page.evaluate(() => document.activeElement?.getAttribute("data-feature"))) === "arc below to", "the end is no longer focused");
  await page.keyboard.press("Shift+ArrowLeft");
  await until("the end has not moved by ten degrees", async () => (await ends()).join() === "-140,-29");
  await picture(page, "30-arc");
  const line = page.locator('.unwrapped .handle[data-feature="arc below from"] .touch');
  const { x, y, scale } = await line.evaluate((e) => {
    const box = e.getBoundingClientRect();
    const drawing = e.ownerSVGElement;
    return { x: box.x + box.width / 2, y: box.y + box.height / 2, scale: (drawing.getBoundingClientRect().width / drawing.viewBox.baseVal.width) * (540 / 360) };
  });
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x - 10 * scale, y, { steps: 4 });
  await page.mouse.move(x - 20 * scale, y, { steps: 4 });
  await page.mouse.up();
  await until("the start has not followed the mouse", async () => Math.abs((await ends())[0] + 160) < 1.5); // a pixel is a degree
  claim(Math.abs((await ends())[1] + 29) < 1e-9, `the end is at ${(await ends())[1]}`); // decimal digits of the text
  await undo(original);
});

await findings.check("the grooves between the arcs of a bore follow an end of any of them, evenly", async () => {
  await openFile("lobes.yaml");
  await state(page, "Ready");
  const original = await textOf(page);
  await rightTab("Bearing");
  const handle = page.locator('.unwrapped .handle[data-feature="arc 2 from"]');
  await handle.waitFor();
  claim((await page.locator(".unwrapped .arc-end").count()) === 6, "three arcs have six ends");
  await handle.focus();
  await page.keyboard.press("ArrowLeft"); // the arc grows at both ends, its groove shrinks by twice as much
  await says(page, "groove: 18 deg");
  await picture(page, "31-bore");
  for (const scheme of ["light", "dark"]) {
    const faults = await accessibilityFaults(page, scheme);
    claim(faults.length === 0, faults.join("\n"));
  }
  await page.emulateMedia({ colorScheme: "light" });
  await undo(original);
});

await findings.check("a group of keys is added by its form, which asks for what it needs", async () => {
  await openFile("small.yaml");
  await state(page, "Ready to run");
  const original = await textOf(page);
  await rightTab("Bearing");
  const add = page.getByLabel("Add: bearings.main", { exact: true });
  await add.selectOption("thermal");
  const form = page.locator(".group-form");
  const supply = form.locator('[data-group-key="supply_temperature"]');
  claim((await form.locator('[data-group-key="model"]').inputValue()) === "film", "the kind that needs something is not the first choice");
  claim(await supply.evaluate((e) => e.required), "what is needed is not asked for");
  await form.getByRole("button", { name: "Add thermal" }).click();
  claim((await textOf(page)) === original, "it is written without what it needs");
  await supply.fill("50 degC");
  await form.locator('[data-group-key="layers"]').fill("3");
  await picture(page, "32-group-form");
  await supply.press("Enter");
  await says(page, "thermal: {model: film, supply_temperature: 50 degC, layers: 3}");
  await page.locator('[data-key="bearings.main.thermal.layers"]').waitFor();
  await add.selectOption("asperities");
  await form.locator('[data-group-key="model"]').selectOption("greenwood_tripp");
  for (const [key, value] of [["roughness", "0.5 um"], ["composite_modulus", "100 GPa"]]) await form.locator(`[data-group-key="${key}"]`).fill(value);
  await form.getByRole("button", { name: "Add asperities" }).click();
  await says(page, "asperities: {model: greenwood_tripp, roughness: 0.5 um, composite_modulus: 100 GPa}");
  await undo(original);
});

await findings.check("a wrong indentation is told with what is allowed, and a click mends it", async () => {
  await openFile("small.yaml");
  await state(page, "Ready to run");
  const original = await textOf(page);
  await goTo(page, "diameter: 45 mm\n");
  await page.keyboard.type(" ");
  await state(page, "1 fault");
  const said = await page.locator(".problem-text").first().innerText();
  claim(/'width' indented by 5 spaces/.test(said) && /4 spaces, as 'diameter' in line/.test(said), `the fault reads: ${said}`);
  await picture(page, "33-indentation");
  await page.locator(".repair").first().click();
  await state(page, "Ready to run");
  claim((await textOf(page)) === original, "the line is not as it was");
});

await findings.check("one key that is spelled wrongly is one fault; a wrong unit of a parameter leads to its line", async () => {
  await openFile("small.yaml");
  await state(page, "Ready to run");
  const original = await textOf(page);
  await goTo(page, "bodies");
  await page.keyboard.press("Backspace");
  await page.keyboard.press("Backspace");
  await page.keyboard.type("se"); // bodise
  await state(page, "1 fault");
  claim(/did you mean 'bodies'/.test(await page.locator(".problem-text").first().innerText()), "it is another fault");
  await page.locator(".repair").first().click();
  await state(page, "Ready to run");
  claim((await textOf(page)) === original, "the key is not as it was");
  await goTo(page, "load: 100 N");
  await page.keyboard.press("Backspace");
  await page.keyboard.type("mm");
  await state(page, "1 fault");
  await page.locator(".problem").first().click();
  await until("it leads elsewhere", async () => (await cursorLine(page)).trim() === "load: 100 mm");
  await undo(original);
});

await findings.check("a report of the folder opens as a report, in the colours of the page", async () => {
  await openFile("small.yaml");
  await state(page, "Ready to run");
  await page.keyboard.press("Control+Enter");
  await page.locator(".run-state.completed").first().waitFor({ timeout: 20_000 });
  const run = await page.locator(".runs li[data-run]").first().getAttribute("data-run");
  cpSync(join(folder, "runs", run, "report.html"), join(folder, "old report.html"));
  await page.locator('.file[data-path="old report.html"]').waitFor();
  await openFile("old report.html");
  const report = page.frameLocator(".report-frame:not([hidden])");
  await report.locator("h1").first().waitFor({ timeout: 15_000 });
  claim((await page.locator('.documents .tab[aria-selected="true"]').innerText()).startsWith("old report.html"), "its tab has another name");
  const theme = (is) => report.locator(`html[data-theme="${is}"]`).waitFor({ state: "attached" });
  await theme("light");
  await page.locator(".bar").getByRole("button", { name: "Dark" }).click();
  await theme("dark");
  await picture(page, "34-dark-report");
  // One that is opened then is dark from the beginning.
  await page.locator(".runs").getByRole("button", { name: /^Report/ }).first().click();
  await report.locator("h1").first().waitFor({ timeout: 15_000 });
  await theme("dark");
  await page.locator(".bar").getByRole("button", { name: "Light" }).click();
  await theme("light");
});

await findings.check("the page says nothing that it must not", async () => claim(page.complaints.length === 0, page.complaints.join("\n")));

await browser.close();
await server.stop();
forget(folder);
console.log(`${findings.held} held, ${findings.failed} failed, ${((performance.now() - begun) / 1000).toFixed(0)} s; pictures: ${pictures}`);
process.exit(findings.failed > 0 ? 1 : 0);
