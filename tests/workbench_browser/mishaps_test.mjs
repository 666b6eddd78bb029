// node mishaps_test.mjs PROGRAM [PICTURES] [ONLY]: a failing run, a read-only folder, a full disk, more tabs than a browser
// has connections: nothing is lost, and what has happened is said. See bench.mjs.
import { spawnSync } from "node:child_process";
import { chmodSync, mkdirSync, readdirSync, readFileSync, writeFileSync } from "node:fs";
import { join, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { claim, cursorLine, Findings, folderOfModels, forget, goTo, launch, open, says, serve, showFile, state, until } from "./bench.mjs";

const [program, pictures = "build/web-test/workbench", only] = process.argv.slice(2);
if (!program) {
  console.error("usage: node mishaps_test.mjs PROGRAM [PICTURES] [ONLY]");
  process.exit(2);
}
mkdirSync(pictures, { recursive: true });
const findings = new Findings(only);
const browser = await launch();
const picture = (page, name) => page.screenshot({ path: join(pictures, `${name}.png`) });
const openFile = showFile;
const button = (page, name) => page.getByRole("button", { name, exact: true });
const notice = (page, words) => page.locator(".notice", { hasText: words }).first().waitFor();
const dot = (page) => page.locator(".documents .dot");

/** A folder, the program on it and a context of the browser, gone after the journey. */
async function journey(name, how, go) {
  await findings.check(name, async () => {
    const folder = folderOfModels();
    how.prepare?.(folder);
    const server = await serve(resolve(program), folder, undefined, how.process);
    const context = await browser.newContext({ viewport: { width: 1280, height: 720 }, colorScheme: "light" });
    try {
      await go({ folder, server, context });
    } finally {
      await context.close();
      await server.stop();
      chmodSync(folder, 0o755);
      forget(folder);
    }
  });
}

const heavy = readFileSync(fileURLToPath(new URL("../cli/bearing.yaml", import.meta.url)), "utf8");

await journey("a failing run says why and where, keeps what it has found, and the page goes on", { prepare: (folder) => writeFileSync(join(folder, "heavy.yaml"), heavy.replace(/load: \d+ N/, "load: 1e9 N").replace("duration: 2 ms", "duration: 100 ms")) }, async ({ server, context }) => {
  const page = await open(context, server.address);
  await openFile(page, "heavy.yaml");
  await state(page, "Ready to run");
  await page.keyboard.press("Control+Enter");
  await page.locator(".run-state.failed").waitFor({ timeout: 30_000 });
  const said = await page.locator(".run-message").innerText();
  claim(/t = /.test(said), `it says: ${said}`);
  await page.locator(".below").getByRole("tab", { name: "Log" }).click();
  await page.waitForFunction(() => document.querySelector(".log").textContent.length > 20);
  await picture(page, "20-failing-run");
  // What it is about stands in the text, which is found in the file's present lines.
  await goTo(page, "parameters:");
  await page.keyboard.type("\n  further: 1 N");
  await openFile(page, "bearing.yaml");
  const show = page.locator(".runs").getByRole("button", { name: /^Show in the text/ });
  await show.focus();
  await page.keyboard.press("Enter");
  await until("it leads elsewhere", async () => /^ +main:/.test(await cursorLine(page)));
  claim((await page.locator('.documents .tab[aria-selected="true"]').innerText()).startsWith("heavy.yaml"), "another text is shown");
  await picture(page, "20-failing-place");
  await page.locator(".runs").getByRole("button", { name: /^Report/ }).click();
  await page.frameLocator(".report-frame:not([hidden])").locator("h1, .verdict-line").first().waitFor({ timeout: 15_000 });
  await openFile(page, "model.yaml");
  await state(page, "Ready to run");
  claim(page.complaints.length === 0, page.complaints.join("\n"));
});

const nobody = process.getuid() === 0 ? { uid: 65534, gid: 65534, env: { ...process.env, HOME: "/tmp" } } : {};
await journey("a read-only folder is shown; what cannot be written is said, and stays in the page", { process: nobody, prepare: (folder) => chmodSync(folder, 0o555) }, async ({ folder, server, context }) => {
  const before = readFileSync(join(folder, "model.yaml"), "utf8");
  const entries = readdirSync(folder).join();
  const page = await open(context, server.address, /403|409|507/);
  await openFile(page, "model.yaml");
  await state(page, "Ready to run");
  await button(page, "Run").click();
  await notice(page, "open a folder in which you may write");
  await goTo(page, "mass: 6");
  await page.keyboard.type(".5");
  await page.keyboard.press("Control+s");
  await notice(page, "is not written");
  await picture(page, "21-read-only");
  await dot(page).first().waitFor();
  await page.waitForTimeout(600); // the tab remembers after a pause of typing
  await page.reload();
  await page.waitForSelector(".cm-content");
  await says(page, "mass: 6.5 kg");
  await dot(page).first().waitFor();
  claim(readFileSync(join(folder, "model.yaml"), "utf8") === before && readdirSync(folder).join() === entries, "something has been written");
  claim(page.complaints.length === 0, page.complaints.join("\n"));
});

await journey("a full disk is said, the old file is whole, and the text is saved once there is room", {}, async ({ folder, server, context }) => {
  const file = join(folder, "model.yaml");
  const before = readFileSync(file, "utf8");
  // No file may grow beyond this: the program hears of it as of a full disk.
  const room = (size) => claim(spawnSync("prlimit", ["--pid", String(server.child.pid), `--fsize=${size}:unlimited`]).status === 0, "prlimit");
  room(2000);
  const page = await open(context, server.address, /403|507/);
  await openFile(page, "model.yaml");
  await state(page, "Ready to run");
  await goTo(page, "");
  await page.keyboard.insertText("# one line more\n");
  await page.keyboard.press("Control+s");
  await notice(page, "make room on the disk");
  await picture(page, "22-full-disk");
  await dot(page).first().waitFor();
  claim(readFileSync(file, "utf8") === before, "the old file is not whole");
  claim(readdirSync(folder).every((name) => !name.startsWith(".")), "something is left behind");
  room("unlimited");
  await page.keyboard.press("Control+s");
  await dot(page).first().waitFor({ state: "detached" });
  claim(readFileSync(file, "utf8") === `# one line more\n${before}`, "the file is not as it was saved");
  claim(page.complaints.length === 0, page.complaints.join("\n"));
});

await journey("eight tabs on one folder: each hears and is answered, also when the one with the stream is closed", {}, async ({ folder, server, context }) => {
  let streams = 0;
  context.on("request", (request) => (streams += /\/api\/events/.test(request.url()) ? 1 : 0));
  const pages = [];
  for (let i = 0; i < 8; i++) {
    const page = await open(context, server.address);
    await openFile(page, "bearing.yaml");
    await state(page, "Ready: operating point");
    pages.push(page);
  }
  claim(streams === 1, `${streams} streams are open`);
  const change = async (words, all) => {
    const file = join(folder, "bearing.yaml");
    writeFileSync(file, readFileSync(file, "utf8").replace(/^title: .*$/m, `title: ${words}`));
    for (const page of all) await says(page, `title: ${words}`);
  };
  await change("Changed once", pages);
  await pages[0].close();
  await change("Changed twice", pages.slice(1));
  await until(`${streams} streams were opened`, () => streams === 2);
  await change("Changed thrice", pages.slice(1));
  const last = pages.at(-1);
  await goTo(last, "title: Changed");
  await last.keyboard.type("\nwrong: 1");
  await state(last, "fault");
  await picture(last, "23-eight-tabs");
  for (const page of pages.slice(1)) claim(page.complaints.length === 0, page.complaints.join("\n"));
  await server.stop();
  for (const page of pages.slice(1)) await notice(page, "does not answer");
});

await browser.close();
console.log(`${findings.held} held, ${findings.failed} failed; pictures: ${pictures}`);
process.exit(findings.failed > 0 ? 1 : 0);
