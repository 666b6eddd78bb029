// node runs_test.mjs PROGRAM [PICTURES] [ONLY]: studies, runs with other values and curves of a bearing in the workbench, as
// workbench_test.mjs does it for the rest.
import { cpSync, existsSync, mkdirSync, mkdtempSync, readFileSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { accessibilityFaults, claim, Findings, folderOfModels, forget, goTo, launch, open, serve, showFile, state, textOf, until } from "./bench.mjs";

const [program, pictures = "build/web-test/workbench-runs", only] = process.argv.slice(2);
if (!program) {
  console.error("usage: node runs_test.mjs PROGRAM [PICTURES] [ONLY]");
  process.exit(2);
}
mkdirSync(pictures, { recursive: true });
const picture = (page, name) => page.screenshot({ path: join(pictures, `${name}.png`) });
const folder = folderOfModels();
const examples = fileURLToPath(new URL("../../examples", import.meta.url));
for (const [from, to] of [["model", "tolerances"], ["optimum", "optimum"]]) cpSync(join(examples, `bearing_tolerances/${from}.yaml`), join(folder, `${to}.yaml`));
// Its runs are seen one after another on fast machines, too.
const tolerances = join(folder, "tolerances.yaml");
writeFileSync(tolerances, readFileSync(tolerances, "utf8").replace("{circumferential: 60, axial: 13}", "{circumferential: 180, axial: 37}"));
cpSync(join(examples, "oil_circuit/model.yaml"), join(folder, "circuit.yaml"));
const small = fileURLToPath(new URL("../cli/bearing.yaml", import.meta.url));
cpSync(small, join(folder, "bearing_run.yaml"));
writeFileSync(join(folder, "moving.yaml"), `${readFileSync(small, "utf8").replace("duration: 2 ms", "duration: 6 s")}\nstudy:\n  plan: list\n  parameters: {load: [100 N, 200 N, 300 N]}\n  outputs: [bearings.main.moft]\n`);
const findings = new Findings(only);
const begun = performance.now();
// A machine with a cluster, as far as the page can know.
const tools = mkdtempSync(join(tmpdir(), "hersey-tools-"));
writeFileSync(join(tools, "sbatch"), "#!/bin/sh\necho 'sbatch: error: no controller' >&2\nexit 1\n", { mode: 0o755 });
process.env.PATH = `${process.env.PATH}:${tools}`;
const server = await serve(resolve(program), folder);
const browser = await launch();
const context = await browser.newContext({ viewport: { width: 1440, height: 900 }, colorScheme: "light" });
const page = await open(context, server.address, /422|409.*remove/);
const openFile = (name) => showFile(page, name);
const below = (name) => page.locator(".below").getByRole("tab", { name }).click();
const rows = page.locator(".study-table tbody tr");
const words = page.locator(".study-words");
const cells = (row) => row.locator("th, td").allInnerTexts();

await findings.check("a study is planned as a table, started, filled, stopped and resumed; its report opens inside", async () => {
  await openFile("tolerances.yaml");
  await page.getByRole("button", { name: "Study …" }).click();
  await words.filter({ hasText: "sobol: 128 runs" }).waitFor();
  claim((await rows.count()) === 128, `${await rows.count()} rows`);
  const heads = await page.locator(".study-table thead th").allInnerTexts();
  claim(heads.join().includes("clearance,width,viscosity,load,state"), `columns: ${heads}`);
  const planned = await cells(rows.nth(7));
  claim(planned[5] === "planned" && /^\d+(\.\d+)? um$/.test(planned[1]), `a row reads ${planned}`);
  await picture(page, "1-study-planned");
  // A text that is not saved is planned as it stands.
  await goTo(page, "samples: 128");
  for (let i = 0; i < 3; i++) await page.keyboard.press("Backspace");
  await page.keyboard.type("64");
  await words.filter({ hasText: "sobol: 64 runs" }).waitFor();
  claim(JSON.stringify(await cells(rows.nth(7))) === JSON.stringify(planned), "fewer points of the same seed are other ones");
  await page.keyboard.press("Control+s");
  await page.locator(".notice", { hasText: "Saved" }).waitFor();
  await page.getByLabel("Jobs").fill("1");
  await page.getByRole("button", { name: "Start study" }).click();
  // Its first runs wait for Python and what plans the study.
  await page.waitForFunction(() => document.querySelectorAll(".study-state.completed").length >= 3, null, { timeout: 60_000 });
  claim((await page.locator(".study-state.waiting").count()) > 0, "no run waits");
  await picture(page, "2-study-going-on");
  await page.locator(".study-actions").getByRole("button", { name: "Stop" }).click();
  await page.locator(".study-actions").getByRole("button", { name: "Resume" }).waitFor();
  const done = await page.locator(".study-state.completed").count();
  claim(done < 64, "it was not stopped");
  await page.reload();
  await page.waitForFunction(() => document.querySelectorAll(".study-state.missing").length > 0, null, { timeout: 60_000 });
  for (const scheme of ["dark", "light"]) {
    const faults = await accessibilityFaults(page, scheme);
    claim(faults.length === 0, faults.join("\n"));
  }
  await page.emulateMedia({ colorScheme: "light" });
  await page.locator(".study-actions").getByRole("button", { name: "Resume" }).click();
  await words.filter({ hasText: "64 of 64 runs done, completed" }).waitFor({ timeout: 180_000 });
  const id = await page.getByLabel("Which study").inputValue();
  const csv = readFileSync(join(folder, "runs", id, "runs.csv"), "utf8").trim().split("\n").map((line) => line.split(","));
  const at = csv[0].findIndex((name) => name.includes("h_min"));
  const eighth = await cells(rows.nth(7));
  claim(eighth.slice(1, 5).join() === planned.slice(1, 5).join(), "the plan was another one");
  const written = Number(csv[8][at]);
  claim(Math.abs(Number(eighth[6]) - written) < 1e-3 * written, `the table says ${eighth[6]}, runs.csv ${csv[8][at]}`); // four figures are shown
  await picture(page, "3-study-done");
  await page.locator(".study-actions").getByRole("button", { name: "Report" }).click();
  await page.frameLocator(".report-frame:not([hidden])").locator("h1").first().waitFor({ timeout: 15000 });
  await page.waitForTimeout(300);
  await picture(page, "4-study-report");
});

await findings.check("runs of a study that go on are told in its table, and lead to their plots", async () => {
  await openFile("moving.yaml");
  await page.getByRole("button", { name: "Study …" }).click();
  await words.filter({ hasText: "list: 3 runs" }).waitFor();
  await page.getByLabel("Jobs").fill("1");
  await page.getByRole("button", { name: "Start study" }).click();
  const under = page.locator(".study-state.running button");
  await under.first().waitFor({ timeout: 20_000 });
  claim((await under.count()) === 1 && (await page.locator(".study-state.waiting").count()) >= 1, "more runs go on than are done at the same time");
  const share = async () => parseInt((await under.first().innerText()).split(",")[1]);
  const first = await share();
  await until("it does not go on", async () => (await share()) > first);
  await picture(page, "5b-study-running");
  await under.first().focus();
  await page.keyboard.press("Enter");
  await page.locator('[data-plot="h_min"] canvas').waitFor();
  claim(/, run [1-3]$/.test(await page.locator(".live-title").innerText()), `it is called ${await page.locator(".live-title").innerText()}`);
  await page.locator(".live-pane select").selectOption("Power balance");
  await page.locator('[data-plot="powers_balance"] canvas').waitFor();
  await page.waitForTimeout(1500);
  await picture(page, "5c-study-run-live");
  await below("Study");
  await page.locator(".study-actions").getByRole("button", { name: "Stop" }).click();
  await page.locator(".study-actions").getByRole("button", { name: "Resume" }).waitFor();
  await until("something goes on", async () => (await under.count()) === 0);
});

await findings.check("the runs of an optimum appear as the search asks for them", async () => {
  await openFile("optimum.yaml");
  await page.getByRole("button", { name: "Study …" }).click();
  await words.filter({ hasText: "as the search asks" }).waitFor();
  await page.locator(".study-content .note", { hasText: "minimise bearings.main.power_film, bearings.main.h_min > 5 um" }).waitFor();
  claim((await rows.count()) === 0, "runs before the search has begun");
  await page.getByRole("button", { name: "Start study" }).click();
  await words.filter({ hasText: "completed" }).waitFor({ timeout: 60000 });
  const count = await rows.count();
  claim(count >= 3, `${count} rows`);
  const losses = (await Promise.all([...Array(count).keys()].map(async (i) => (await cells(rows.nth(i)))[4]))).map(Number);
  claim(losses[count - 1] < losses[0], `the loss goes from ${losses[0]} to ${losses[count - 1]}`);
  await picture(page, "5-optimum");
});

await findings.check("a study goes to the cluster where the machine has one", async () => {
  await openFile("tolerances.yaml");
  await page.getByRole("button", { name: "Study …" }).click();
  await words.filter({ hasText: "sobol" }).waitFor();
  await page.getByLabel("Where").selectOption("on the cluster (Slurm)");
  await page.getByRole("button", { name: "Start study" }).click();
  const choice = page.getByLabel("Which study");
  await until("no study is shown", async () => /-\d+$/.test(await choice.inputValue()));
  const id = await choice.inputValue();
  const { command } = JSON.parse(readFileSync(join(folder, "runs", id, "run.json"), "utf8"));
  claim(command[command.indexOf("--on") + 1] === "slurm", command.join(" "));
  // Its sbatch answers nobody: the study waits for it, or says so.
  const stop = page.locator(".study-actions").getByRole("button", { name: "Stop" });
  const ended = page.locator(`.runs li[data-run="${id}"] .run-state:not(.running)`);
  await stop.or(ended).first().waitFor();
  if (await stop.isVisible()) await stop.click();
  await ended.waitFor();
  await page.getByLabel("Which study").selectOption("");
  await page.getByLabel("Where").selectOption("on this machine");
});

await findings.check("a study's faults stand in its table, overrides fix its parameters", async () => {
  await openFile("tolerances.yaml");
  await page.getByRole("button", { name: "Study …" }).click();
  await words.filter({ hasText: "64 runs" }).waitFor();
  await page.locator(".study-starting").getByLabel("Overrides").fill("width=15.5 mm");
  await page.waitForFunction(() => !document.querySelector(".study-table thead")?.textContent.includes("width"));
  await page.locator(".study-starting").getByLabel("Overrides").fill("widht=15.5 mm");
  await page.locator(".study-fault", { hasText: "did you mean 'width'" }).waitFor();
  claim(await page.getByRole("button", { name: "Start study" }).isDisabled(), "it can be started");
  await picture(page, "6-study-fault");
  await page.locator(".study-starting").getByLabel("Overrides").fill("");
  await words.filter({ hasText: "64 runs" }).waitFor();
});

await findings.check("a run takes other values than its text has; wrong ones are told, and the list says which", async () => {
  await openFile("model.yaml");
  await state(page, "Ready to run");
  const text = await textOf(page);
  await page.getByRole("button", { name: "Run with …" }).click();
  const field = page.locator("dialog").getByLabel("Overrides");
  const run = page.locator("dialog").getByRole("button", { name: "Run", exact: true });
  await field.fill("simulation.duratoin=30 deg");
  await page.locator(".override-faults .bad", { hasText: "duration" }).waitFor();
  claim(await run.isDisabled(), "it can be started");
  await picture(page, "7-override-fault");
  await field.fill("duration");
  await page.locator(".override-faults .bad", { hasText: "NAME=VALUE" }).waitFor();
  await field.fill("simulation.duration=30 deg\nbodies.piston.mass=0.5 kg");
  await page.locator(".override-faults .good").waitFor();
  await picture(page, "8-overrides");
  await field.press("Control+Enter");
  const first = page.locator('.runs li[data-run^="model-"], .runs li[data-run^="hersey-workbench"]').first();
  await first.locator(".run-state.completed").waitFor({ timeout: 20000 });
  claim((await first.locator(".run-what").innerText()) === "duration = 30 deg, mass = 0.5 kg", await first.innerText());
  claim((await textOf(page)) === text, "the text has changed");
});

await findings.check("compared runs are called by the values in which they differ; a run is removed after a question, by keys", async () => {
  await openFile("bearing_run.yaml");
  await state(page, "Ready to run");
  const ours = page.locator('.runs li[data-run^="bearing_run-"]');
  const start = async (count) => {
    await page.locator(".bar .main-button").click();
    await page.locator("dialog").getByRole("button", { name: "Save and run" }).click({ timeout: 1500 }).catch(() => undefined);
    await until("no run completes", async () => (await ours.locator(".run-state.completed").count()) === count);
  };
  await start(1);
  await goTo(page, "load: 100");
  for (let i = 0; i < 3; i++) await page.keyboard.press("Backspace");
  await page.keyboard.type("150");
  await state(page, "Ready to run");
  await start(2);
  claim((await ours.first().locator(".run-what").innerText()) === "load = 150 N", await ours.first().innerText());
  for (const i of [0, 1]) await ours.nth(i).getByRole("checkbox").check();
  await page.getByRole("button", { name: "Compare", exact: true }).click();
  const report = page.frameLocator(".report-frame:not([hidden])");
  await report.getByText("load = 150 N").first().waitFor({ timeout: 15_000 });
  await report.getByText("load = 100 N").first().waitFor();
  await page.waitForTimeout(300);
  await picture(page, "13-named-runs");
  const id = await ours.first().getAttribute("data-run");
  const made = join(folder, "runs", id);
  await ours.first().locator(".run-name").focus();
  await page.keyboard.press("Delete");
  const question = page.locator("dialog", { hasText: `Remove` });
  await question.waitFor();
  await picture(page, "14-remove");
  await page.keyboard.press("Enter"); // the answer that keeps it is the first
  await question.waitFor({ state: "detached" });
  claim(existsSync(made) && (await ours.count()) === 2, "it is removed without a word");
  await page.keyboard.press("Delete");
  await question.getByRole("button", { name: "Remove" }).click();
  await until("it is still listed", async () => (await ours.count()) === 1);
  claim(!existsSync(made), "its folder is there");
  await until("nothing is focused", () => page.evaluate(() => document.activeElement?.classList.contains("run-name")));
  // A file that is not of the run keeps it.
  const other = join(folder, "runs", await ours.first().getAttribute("data-run"));
  writeFileSync(join(other, "notes.md"), "mine");
  await ours.first().getByRole("button", { name: /^Remove/ }).click();
  await question.getByRole("button", { name: "Remove" }).click();
  await page.locator(".notice", { hasText: "notes.md" }).waitFor();
  claim(existsSync(join(other, "results.h5")), "it is removed in part");
});

await findings.check("the Stribeck curve and its like are drawn at the sliders' point, which stays quick; coefficients stand as tables", async () => {
  await openFile("bearing.yaml");
  await page.locator(".right").getByRole("tab", { name: "Operating point" }).click();
  const thickness = page.locator('[data-figure-key="h_min"] td');
  await thickness.waitFor();
  const answers = [];
  const note = async (response) => {
    if (response.url().endsWith("/api/bearing") && response.ok()) answers.push({ asked: response.request().postDataJSON(), answer: await response.json() });
  };
  page.on("response", note);
  const drawn = () => page.waitForFunction(() => performance.getEntriesByName("hersey-curves").length > 0, null, { timeout: 60000 });
  await page.locator(".curves summary").click();
  await drawn();
  const curve = answers.filter(({ asked }) => asked.fields[0] === "none").map(({ asked, answer }) => ({
    speed: parseFloat(asked.set.find((text) => text.startsWith("speed=")).slice(6)),
    isNear: answer.started_from !== null,
    figure: (key) => answer.figures.find((f) => f.key === key).value,
  })).sort((a, b) => a.speed - b.speed);
  claim(curve.length > 20 && curve[curve.length - 1].speed / curve[0].speed > 1000, `${curve.length} points from ${curve[0].speed} to ${curve[curve.length - 1].speed} rpm`);
  claim(curve.filter(({ isNear }) => isNear).length >= curve.length - 1, "points do not start from their neighbours");
  const friction = curve.map(({ figure }) => figure("friction_journal"));
  const least = friction.indexOf(Math.min(...friction));
  claim(least > 2 && least < curve.length - 3, `the least friction is that of point ${least}`);
  const share = curve.map(({ figure }) => figure("asperity_share"));
  claim(share.every((value, i) => i === 0 || value <= share[i - 1]) && share[0] > 0.5, `asperities bear ${share}`);
  claim((await page.locator(".point-curve").evaluateAll((all) => all.map((e) => e.dataset.curve).join())) === "friction,h_min,p_max,loss,flow", "some curve is missing");
  claim(await page.locator('[data-curve="friction"] .legend-entry', { hasText: "asperities" }).isVisible(), "no share of asperities");
  await page.locator(".curves").evaluate((e) => e.scrollIntoView());
  await picture(page, "9-stribeck");
  // Over the load, and a slider that is moved meanwhile.
  await page.evaluate(() => performance.clearMarks());
  await page.getByLabel("Over", { exact: true }).selectOption("load");
  await page.waitForFunction(() => /^[3-9] of/.test(document.querySelector(".curves .note").textContent));
  const before = await thickness.innerText();
  const from = performance.now();
  await page.getByLabel("Speed", { exact: true }).fill("0.4");
  await page.waitForFunction((old) => document.querySelector('[data-figure-key="h_min"] td').textContent !== old, before);
  claim(performance.now() - from < 2000, `the slider took ${performance.now() - from} ms`);
  await drawn();
  const numbers = answers.at(-1).asked.set.map((text) => text.split("=")[0]).sort().join();
  claim(numbers === "load,speed", `a point of the second curve sets ${numbers}`);
  const matrix = page.locator(".point-coefficients .matrix", { hasText: "Stiffness k" });
  const cells = await matrix.locator("[data-quantity]").allInnerTexts();
  const last = answers.filter(({ asked }) => asked.fields[0] === "pressure").at(-1).answer.figures;
  const first = last.find((f) => f.key === "stiffness_xx").value;
  const told = Number(cells[0].replace(/[\s\u202f]/g, "").replace("−", "-").replace("·10", "e").replace(/[⁰¹²³⁴⁵⁶⁷⁸⁹]/g, (c) => "⁰¹²³⁴⁵⁶⁷⁸⁹".indexOf(c)));
  claim(cells.length === 4 && Math.abs(told / first - 1) < 5e-3, `the table says ${cells}, the program ${first}`); // three figures are shown
  await matrix.scrollIntoViewIfNeeded();
  await picture(page, "10-coefficients");
  page.off("response", note);
  await page.locator(".point-head").getByRole("button", { name: "Report" }).click();
  const report = page.frameLocator(".report-frame:not([hidden])");
  await report.getByText("minimum film thickness").first().waitFor({ timeout: 60_000 });
  await picture(page, "11-point-report");
});

await findings.check("a curve goes on beyond a point without a solution, which is tried by itself and named", async () => {
  await openFile("bearing.yaml");
  await page.locator(".right").getByRole("tab", { name: "Operating point" }).click();
  await page.locator('[data-figure-key="h_min"] td').waitFor();
  // As if there were none near 250 rpm from a neighbour, and none at all near 600 rpm.
  const asked = [];
  const [isFar, isNone] = [(speed) => speed > 200 && speed < 320, (speed) => speed > 500 && speed < 700];
  await page.route("**/api/bearing", async (route) => {
    const { fields, set, previous } = route.request().postDataJSON();
    const speed = fields[0] === "none" ? parseFloat(set.find((text) => text.startsWith("speed="))?.slice(6)) : NaN;
    asked.push({ speed, isCold: !previous });
    if (!isNone(speed) && !(isFar(speed) && previous)) return route.continue();
    const response = await route.fetch();
    await route.fulfill({ response, json: { ...(await response.json()), id: null, solved: false } });
  });
  await page.evaluate(() => performance.clearMarks());
  if (!(await page.locator(".curves").evaluate((e) => e.open))) await page.locator(".curves summary").click();
  const over = page.getByLabel("Over", { exact: true });
  if ((await over.inputValue()) !== "speed") await over.selectOption("speed");
  await page.waitForFunction(() => performance.getEntriesByName("hersey-curves").length > 0, null, { timeout: 60000 });
  const words = await page.locator(".curves .note").innerText();
  const named = (/^not found at ([\d., ]+) rpm$/.exec(words)?.[1] ?? "").split(", ").map(Number);
  claim(named.length > 0 && named.every(isNone), `it says: ${words}`);
  for (const place of [isFar, isNone]) {
    const tries = asked.filter(({ speed }) => place(speed));
    claim(tries.some(({ isCold }) => isCold) && tries.some(({ isCold }) => !isCold), `tries: ${JSON.stringify(tries)}`);
  }
  const least = Math.min(...asked.map(({ speed }) => speed).filter((speed) => speed > 0));
  claim(least < 100, `the curve ends at ${least} rpm`);
  await page.unroute("**/api/bearing");
});

await findings.check("a run shows its film's pressure and its oil circuit while it goes on", async () => {
  await openFile("circuit.yaml");
  await state(page, "Ready to run");
  await goTo(page, "duration: ");
  await page.getByRole("button", { name: "Run with …" }).click();
  await page.locator("dialog").getByLabel("Overrides").fill("simulation.duration=5 s\noutput.fields_every=2 ms");
  await page.locator(".override-faults .good").waitFor();
  await page.locator("dialog").getByRole("button", { name: "Run", exact: true }).click();
  await page.locator(".run-state.running").waitFor();
  await page.locator(".live-map canvas").waitFor({ timeout: 20000 });
  const when = () => page.locator(".live-map-title").innerText();
  const before = await when();
  claim(/stored last at .* ms/.test(before), before);
  await until("the map does not go on", async () => (await when()) !== before);
  await page.locator(".live-map").scrollIntoViewIfNeeded();
  await picture(page, "11-live-map");
  await page.locator(".live-pane select").selectOption("Oil circuit");
  const names = await page.locator('[data-plot="circuit_pressure"] .legend-entry').allInnerTexts();
  claim([...names].sort().join() === "gallery,main_1,main_2,sump", `nodes: ${names}`);
  claim((await page.locator('[data-plot="circuit_flow"] .legend-entry').count()) === 4, "not every element has its flow");
  await page.locator('[data-plot="circuit_pressure"] canvas').waitFor();
  await page.waitForTimeout(300);
  await picture(page, "12-live-circuit");
  claim(!(await page.locator(".live-map").isVisible()), "a film's map beside the circuit");
  await page.locator(".live-pane select").selectOption("Power balance");
  const sources = await page.locator('[data-plot="powers_balance"] .legend-entry').allInnerTexts();
  claim(sources.includes("films (forces)") && sources.includes("drives"), `powers: ${sources}`);
  await page.locator('[data-plot="powers_friction"] .legend-entry', { hasText: "oil films" }).waitFor();
  await page.waitForTimeout(300);
  await picture(page, "12-live-powers");
  await page.reload();
  await page.locator(".run-state.running").waitFor();
  await page.locator(".live-map canvas").waitFor({ timeout: 20000 });
  claim((await page.locator(".live-pane select option").allInnerTexts()).includes("Oil circuit"), "the circuit is not found again");
  await page.locator(".bar .stop").click();
  await page.locator('.runs li[data-run^="circuit-"] .run-state.stopped').waitFor();
});

await findings.check("the page says nothing that it must not; axe-core finds nothing in it", async () => {
  for (const scheme of ["light", "dark"]) {
    const faults = await accessibilityFaults(page, scheme);
    claim(faults.length === 0, faults.join("\n"));
  }
  await page.emulateMedia({ colorScheme: "light" });
  claim(page.complaints.length === 0, page.complaints.join("\n"));
});

await browser.close();
await server.stop();
forget(folder);
forget(tools);
console.log(`${findings.held} held, ${findings.failed} failed, ${((performance.now() - begun) / 1000).toFixed(0)} s; pictures: ${pictures}`);
process.exit(findings.failed > 0 ? 1 : 0);
