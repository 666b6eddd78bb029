// node picture_test.mjs PROGRAM [PICTURES] [ONLY]: what the workbench shows of a model beside its text, in headless
// Chromium: forces, frames and the oil circuit; joints moved; templates and examples; CAD files; tables. See bench.mjs.
import { chmodSync, cpSync, existsSync, mkdirSync, mkdtempSync, readFileSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { delimiter, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { accessibilityFaults, claim, cursorLine, Findings, folderOfModels, forget, goTo, launch, open, says, serve, showFile, state, textOf, until } from "./bench.mjs";

const [program, pictures = "build/web-test/workbench", only] = process.argv.slice(2);
if (!program) {
  console.error("usage: node picture_test.mjs PROGRAM [PICTURES] [ONLY]");
  process.exit(2);
}
mkdirSync(pictures, { recursive: true });
const root = fileURLToPath(new URL("../..", import.meta.url));
const picture = (page, name) => page.screenshot({ path: join(pictures, `${name}.png`) });
const size = { width: 1280, height: 720 };
const folder = folderOfModels();
cpSync(join(root, "examples/oil_circuit/model.yaml"), join(folder, "circuit.yaml"));
cpSync(join(root, "examples/cam_follower/cam.stl"), join(folder, "cam.stl"));
cpSync(join(root, "examples/cam_follower/model.yaml"), join(folder, "cam.yaml"));
const findings = new Findings(only);
const begun = performance.now();
const server = await serve(resolve(program), folder);
const browser = await launch();
const context = await browser.newContext({ viewport: size, colorScheme: "light" });
const page = await open(context, server.address);
const button = (name) => page.getByRole("button", { name, exact: true });
const openFile = (name) => showFile(page, name);
const parts = page.getByLabel("Choose a part");

await findings.check("forces, gravity and frames are drawn, chosen from the text and lead to it", async () => {
  await openFile("model.yaml");
  await state(page, "Ready to run");
  await page.waitForSelector(".machine-space canvas");
  const names = await page.locator(".machine-names .load").allInnerTexts();
  claim(names.length === 1 && /gas, .*N/.test(names[0]), `loads: ${names}`);
  await parts.selectOption("/forces/gas");
  claim((await cursorLine(page)).trim() === "gas:", `the cursor is at ${await cursorLine(page)}`);
  const pixels = () => page.evaluate(() => document.querySelector(".machine-space canvas").toDataURL());
  const drawn = await pixels();
  await button("Loads").click();
  claim((await pixels()) !== drawn, "without loads the picture is the same");
  await button("Loads").click();
  const plain = await pixels();
  await button("Frames").click();
  claim((await pixels()) !== plain, "with frames the picture is the same");
  await parts.selectOption("/bodies/rod/frames/big_end");
  claim((await cursorLine(page)).trim().startsWith("big_end: {origin"), `the cursor is at ${await cursorLine(page)}`);
  await picture(page, "20-forces-and-frames");
  await button("Frames").click();
  await goTo(page, "direction: 0 -1 0");
  await page.waitForFunction(() => document.querySelector('select[aria-label="Choose a part"]').value === "/forces/gas");
  // A changed direction is seen.
  const before = await pixels();
  await page.keyboard.press("Backspace");
  await page.keyboard.type("1");
  await until("the arrow has not turned", async () => (await pixels()) !== before);
  await page.locator(".cm-content").focus();
  for (let i = 0; i < 4; i++) await page.keyboard.press("Control+z");
});

await findings.check("springs are drawn as coils between their bodies, and follow the text and the joints", async () => {
  await openFile("cam.yaml");
  await state(page, "Ready to run");
  claim((await parts.locator("option").evaluateAll((all) => all.map((o) => o.value))).includes("/forces/spring"), "the spring is not listed");
  await parts.selectOption("/forces/spring");
  claim((await cursorLine(page)).trim().startsWith("spring:"), `the cursor is at ${await cursorLine(page)}`);
  const pixels = () => page.evaluate(() => document.querySelector(".machine-space canvas").toDataURL());
  const before = await pixels();
  await page.locator(".joints summary").click();
  const slider = page.locator(".joint-sliders input").first();
  await slider.evaluate((e) => {
    e.value = Number(e.value) + 0.3;
    e.dispatchEvent(new Event("input"));
  });
  await until("the picture does not move", async () => (await pixels()) !== before);
  await picture(page, "20b-spring");
  await page.locator(".joints summary").click();
  // One on a joint is an arrow around its axis.
  await goTo(page, "forces:");
  await page.keyboard.insertText("\n  wind: {type: torsion_spring, joint: shaft, stiffness: 10 N.m/rad}");
  await state(page, "Ready to run");
  await parts.selectOption("/bodies/follower");
  const wound = await pixels();
  await parts.selectOption("/forces/wind");
  await until("the arrow does not glow", async () => (await pixels()) !== wound);
  await picture(page, "20c-torsion-spring");
  await page.locator(".cm-content").focus();
  for (let i = 0; i < 10 && (await textOf(page)).includes("wind:"); i++) await page.keyboard.press("Control+z");
  claim(page.complaints.length === 0, page.complaints.join("\n"));
});

await findings.check("the oil circuit is drawn; what is clicked in it is found in the text, and back", async () => {
  await openFile("circuit.yaml");
  await state(page, "Ready to run");
  const plan = page.locator(".circuit-plan");
  await plan.locator("svg").waitFor();
  const words = await plan.innerText();
  claim(/sump/.test(words) && /0 bar/.test(words) && /relief valve/.test(words) && !/l\/min/.test(words), `the drawing says ${words}`);
  await plan.locator('[data-node="gallery"]').click();
  claim((await cursorLine(page)).trim().startsWith("gallery:"), `the cursor is at ${await cursorLine(page)}`);
  await page.mouse.click(...(await middleOf(plan.locator('.circuit-touch[data-element="jet"]'))));
  claim((await cursorLine(page)).trim().startsWith("jet:"), `the cursor is at ${await cursorLine(page)}`);
  await goTo(page, "drilling: {type");
  await plan.locator('.chosen[data-element="drilling"]').first().waitFor();
  claim((await parts.inputValue()) === "/circuit/elements/drilling", "the list of parts does not follow");
  await picture(page, "21-circuit");
  const faults = [...(await accessibilityFaults(page, "light")), ...(await accessibilityFaults(page, "dark"))];
  await page.emulateMedia({ colorScheme: "light" });
  claim(faults.length === 0, faults.join("\n"));
});

/** The middle of a line, on the page. */
async function middleOf(line) {
  return line.evaluate((path) => {
    const at = path.getPointAtLength(0.5 * path.getTotalLength());
    path.scrollIntoView({ block: "center" });
    const { x, y } = new DOMPoint(at.x, at.y).matrixTransform(path.getScreenCTM());
    return [x, y];
  });
}

await findings.check("a crank moved by its slider takes the rod along that a film joins to it", async () => {
  await openFile("model.yaml");
  await state(page, "Ready to run");
  await page.locator(".joints summary", { hasText: "Joints" }).click();
  const slider = page.getByLabel("main, rotation");
  const [answer] = await Promise.all([
    page.waitForResponse((response) => response.url().endsWith("/api/move")),
    slider.evaluate((e) => {
      e.value = 1; // [rad]
      e.dispatchEvent(new Event("input"));
    }),
  ]);
  const { bodies } = await answer.json();
  const at = ({ position, orientation: [c, , , s] }, x, y) => [position[0] + x * (c * c - s * s) - 2 * c * s * y, position[1] + 2 * c * s * x + y * (c * c - s * s)];
  const [pin, eye] = [at(bodies.crank, 0, 0.04), at(bodies.rod, 0, -0.14)];
  claim(Math.hypot(pin[0] - eye[0], pin[1] - eye[1]) < 1e-9, `pin ${pin}, big end ${eye}`); // assembled to round-off of metres
  await page.waitForTimeout(100);
  await picture(page, "22-crank-moved");
  await page.getByLabel("main: As the model says").click();
  await page.locator(".joints summary", { hasText: "Joints" }).click();
});

await findings.check("an empty folder shows templates and examples with pictures; an example is copied with what it reads", async () => {
  const empty = mkdtempSync(join(tmpdir(), "hersey-empty-"));
  const other = await serve(resolve(program), empty);
  const begin = await open(await browser.newContext({ viewport: size, colorScheme: "light" }), other.address);
  await begin.locator("dialog.templates").waitFor();
  const drawn = () => begin.locator(".card img[src]").count();
  await until("no pictures appear", async () => (await drawn()) >= 6);
  claim((await begin.locator(".cards").count()) === 2, "no examples");
  await begin.waitForTimeout(1500);
  await picture(begin, "23-templates");
  const faults = [...(await accessibilityFaults(begin, "light")), ...(await accessibilityFaults(begin, "dark"))];
  await begin.emulateMedia({ colorScheme: "light" });
  claim(faults.length === 0, faults.join("\n"));
  // Arrow keys walk through the cards.
  await begin.locator(".card input").first().focus();
  await begin.keyboard.press("ArrowDown");
  claim((await begin.locator("#template-path").inputValue()) === "hydrostatic.yaml", `the next is ${await begin.locator("#template-path").inputValue()}`);
  await begin.locator('.card input[value="example conrod_pressure/model.yaml"]').check();
  await begin.waitForTimeout(1500);
  await picture(begin, "24-examples");
  claim((await begin.locator("#template-path").inputValue()) === "conrod_pressure/model.yaml", "the name is another one");
  await begin.locator("#template-path").fill("mine/rod.yaml");
  await begin.getByRole("button", { name: "Create", exact: true }).click();
  await begin.locator(".documents .tab", { hasText: "rod.yaml" }).waitFor();
  await state(begin, "Ready");
  const from = (name) => readFileSync(join(root, "examples", name));
  claim(readFileSync(join(empty, "mine/rod.yaml")).equals(from("conrod_pressure/model.yaml")), "the copy is another text");
  claim(readFileSync(join(empty, "meshes/conrod.msh")).equals(from("meshes/conrod.msh")), "its mesh is another one");
  claim(begin.complaints.length === 0, begin.complaints.join("\n"));
  await begin.context().close();
  await other.stop();
  forget(empty);
});

await findings.check("a frame is placed by keys and by dragging; an expression is left as it is", async () => {
  await openFile("model.yaml");
  await state(page, "Ready to run");
  const first = await textOf(page);
  await button("Frames").click();
  await parts.selectOption("/bodies/rod/frames/big_end");
  await page.locator(".machine-space").focus();
  await page.keyboard.press("Alt+ArrowRight");
  await says(page, "big_end: {origin: 1 -140 0 mm}");
  await page.locator(".machine-space").focus();
  await page.keyboard.press("Alt+ArrowLeft");
  await says(page, "big_end: {origin: 0 -140 0 mm}");
  claim((await textOf(page)) === first, "there and back is another text");
  // Wherever the mark is drawn: the first place at which a click chooses the frame.
  const box = await page.locator(".machine-space canvas").boundingBox();
  await parts.selectOption("/bodies/piston");
  let found = null;
  for (let i = 4; i < 36 && !found; i++)
    for (let j = -2; j <= 2 && !found; j++) {
      const at = [box.x + box.width / 2 + 6 * j, box.y + (box.height * i) / 40];
      await page.mouse.click(...at);
      if ((await parts.inputValue()) === "/bodies/rod/frames/big_end") found = at;
    }
  claim(found !== null, "the frame is nowhere in the picture");
  await page.mouse.move(...found);
  await page.mouse.down();
  await page.mouse.move(found[0] + 30, found[1], { steps: 3 });
  await page.mouse.up();
  await says(page, "big_end: {origin: 0 -140 0 mm}", false);
  const [, x, y, z] = /big_end: \{origin: (\S+) (\S+) (\S+) mm\}/.exec(await textOf(page)) ?? [];
  claim(Number(x) > 5 && Math.abs(Number(y) + 140) < 8 && z === "0", `it is at ${x} ${y} ${z}`);
  await picture(page, "29-frame-placed");
  await page.locator(".cm-content").focus();
  for (let i = 0; i < 20 && (await textOf(page)) !== first; i++) await page.keyboard.press("Control+z");
  claim((await textOf(page)) === first, "undo does not give the first text");
  await goTo(page, "origin: 0 -140 0 mm");
  await page.evaluate(() => {
    const content = document.querySelector(".cm-content");
    const { view } = content.cmTile ?? content.cmView;
    const { head } = view.state.selection.main;
    const words = "origin: 0 -140 0 mm";
    view.dispatch({ changes: { from: head - words.length, to: head, insert: 'origin: [0, "-140 mm", 0]' } });
  });
  await state(page, "Ready to run");
  await parts.selectOption("/bodies/rod/frames/big_end");
  await page.locator(".machine-space").focus();
  await page.keyboard.press("Alt+ArrowRight");
  await page.getByText("big_end is not moved").waitFor();
  await page.locator(".cm-content").focus();
  for (let i = 0; i < 20 && (await textOf(page)) !== first; i++) await page.keyboard.press("Control+z");
  await button("Frames").click();
});

await findings.check("a hole that a template brings is moved for its own bearing alone", async () => {
  const template = readFileSync(join(root, "examples/bearing_alone/model.yaml"), "utf8");
  claim(/^bearings:\n/m.test(template), "the example is written in another way");
  const [head, body] = template.split(/^bearings:\n/m);
  const lines = body.split("\n");
  const end = lines.findIndex((line, i) => i > 0 && line !== "" && !line.startsWith("   ") && !line.startsWith("#"));
  const own = lines.slice(1, end < 0 ? lines.length : end).map((line) => line.replace(/^ {2}/, "  "));
  const rest = end < 0 ? [] : lines.slice(end);
  writeFileSync(join(folder, "pair.yaml"), `${head}templates:\n  plain:\n${own.join("\n")}\n    features:\n      hole: {shape: hole, diameter: 4 mm, angle: 90 deg, pressure: 2 bar}\nbearings:\n  left: {use: plain}\n  right: {use: plain}   # the other one\n${rest.join("\n")}`);
  await openFile("pair.yaml");
  await page.locator('.documents .tab[aria-selected="true"]', { hasText: "pair.yaml" }).waitFor();
  const [first] = [await textOf(page)];
  await page.locator(".right").getByRole("tab", { name: "Bearing" }).click();
  await page.getByLabel("Which bearing").selectOption("right");
  const hole = page.locator('.unwrapped .handle[data-feature="hole"]');
  await hole.focus();
  await page.keyboard.press("ArrowRight");
  await says(page, "angle: 91 deg");
  claim((await textOf(page)).includes("angle: 90 deg") && (await textOf(page)).includes("# the other one"), "the template has changed");
  await page.locator('.unwrapped .handle[aria-label*="91°"]').waitFor();
  await page.getByLabel("Which bearing").selectOption("left");
  await page.locator('.unwrapped .handle[aria-label*="90°"]').waitFor();
  await page.locator(".cm-content").focus();
  for (let i = 0; i < 20 && (await textOf(page)) !== first; i++) await page.keyboard.press("Control+z");
  await page.locator(".right").getByRole("tab", { name: "Machine" }).click();
});

await findings.check("a table is edited as a table, every other line stays as it is", async () => {
  const file = "gas_pressure.csv";
  const before = readFileSync(join(folder, file), "utf8").replace("10, 0.0000", "# a remark\n10,   0.0000");
  writeFileSync(join(folder, file), before);
  await openFile(file);
  await page.locator(".cells input").first().waitFor();
  const lines = () => textOf(page).then((text) => text.split("\n"));
  const was = before.replace(/\r/g, "").split("\n");
  claim((await lines()).join("\n") === was.join("\n"), "the text is another one at once");
  const cell = (name, row) => page.getByLabel(`${name}, row ${row}`, { exact: true });
  const pressure = "pressure [bar]";
  await cell(pressure, 3).fill("0.25");
  await cell(pressure, 3).press("Enter");
  await says(page, "10,   0.25");
  claim((await page.evaluate(() => document.activeElement.getAttribute("aria-label"))) === `${pressure}, row 4`, "Enter does not lead to the next row");
  claim((await lines()).join("\n") === was.join("\n").replace("10,   0.0000", "10,   0.25"), "more than the cell has changed");
  // What would be another column is not taken.
  await cell(pressure, 3).fill("0,5");
  await cell(pressure, 3).press("Enter");
  claim((await cell(pressure, 3).inputValue()) === "0.25", "a separator is taken");
  await picture(page, "27-table");
  const faults = [...(await accessibilityFaults(page, "light")), ...(await accessibilityFaults(page, "dark"))];
  await page.emulateMedia({ colorScheme: "light" });
  claim(faults.length === 0, faults.join("\n"));
  await cell(pressure, 2).focus();
  await button("Row below").click();
  await says(page, "\n7.5, 0.15\n");
  await button("Remove row").click();
  await says(page, "\n7.5, 0.15\n", false);
  await page.locator(".table-columns input").nth(1).uncheck();
  claim((await page.locator(".table-plot svg").count()) === 0, "a column is drawn that is not wanted");
  await page.locator(".table-columns input").nth(1).check();
  // To its last row, which is not there before it is seen.
  await page.locator(".table-scroll").evaluate((e) => (e.scrollTop = e.scrollHeight));
  await cell("angle [deg]", 145).waitFor();
  await cell("angle [deg]", 145).press("Control+Enter");
  await says(page, "\n725, ");
  await button("Text").click();
  await page.locator(".cm-content").focus();
  for (let i = 0; i < 20 && (await textOf(page)) !== was.join("\n"); i++) await page.keyboard.press("Control+z");
  claim((await textOf(page)) === was.join("\n"), "undoing everything does not give the first text");
  await button("Table").click();
  await cell(pressure, 3).waitFor();
  await openFile("model.yaml");
  await page.locator(".table-bar").waitFor({ state: "detached" });
  await page.locator(".cm-content").waitFor();
});

await findings.check("surfaces of a mesh are chosen by the mouse and written into the model", async () => {
  await openFile("four_bar.yaml");
  await state(page, "Ready to run");
  const first = await textOf(page);
  await openFile("conrod.msh");
  await page.locator(".mesh-space canvas").waitFor();
  // Over the picture until something is hit: bores are small, the rod is slim.
  const box = await page.locator(".mesh-space canvas").boundingBox();
  const checked = () => page.locator(".mesh-table input:checked").evaluateAll((boxes) => boxes.map((e) => e.value));
  for (let i = 1; i < 20 && (await checked()).length === 0; i++) await page.mouse.click(box.x + box.width / 2, box.y + (box.height * i) / 20);
  const [picked] = await checked();
  claim(picked !== undefined, "no click chooses a surface");
  await picture(page, "28-mesh-picked");
  const faults = await accessibilityFaults(page, "light");
  claim(faults.length === 0, faults.join("\n"));
  await page.getByLabel(`Choose ${picked}`).uncheck();
  // What the file has no name for gets one in a new file.
  await page.getByLabel("Choose plane_z_max").check();
  await page.getByRole("button", { name: "Write conrod_named.msh" }).click();
  await page.locator("dialog h2", { hasText: "conrod_named.msh" }).waitFor();
  await page.getByLabel("Choose plane_z_max").check();
  claim((await page.locator("dialog .template-text").innerText()).includes("nodes: plane_z_max, origin:"), "the plane has no frame");
  await page.keyboard.press("Escape");
  await page.locator("dialog").waitFor({ state: "detached" });
  await openFile("conrod.msh");
  await page.locator(".mesh-space canvas").waitFor();
  const row = page.locator(".mesh-table tr", { hasText: "45 mm" }).first();
  await row.locator("input").check();
  const name = (await checked())[0];
  claim((await page.locator("dialog .template-text").innerText()).includes(`nodes: ${name}`), "the lines are not those of what was chosen");
  await page.getByRole("button", { name: "Write them into four_bar.yaml" }).click();
  await page.locator("dialog .note", { hasText: "1 surface written" }).waitFor();
  await page.keyboard.press("Escape");
  const text = await textOf(page);
  claim(text.includes("flexible: {mesh: conrod.msh, length_unit: 1 mm}") && new RegExp(`nodes: ${name}, origin: .* mm`).test(text) && text.includes(`faces: ${name}}, diameter: 45 mm`), `the text says ${text}`);
  await page.locator("dialog").waitFor({ state: "detached" });
  for (let i = 0; i < 20 && (await textOf(page)) !== first; i++) {
    await page.locator(".cm-content").focus();
    await page.keyboard.press("Control+z");
  }
  claim((await textOf(page)) === first, `undo does not give the first text, but ${await textOf(page)}`);
});

await findings.check("a CAD file becomes a mesh with its bores, by gmsh; without gmsh the page says what to install", async () => {
  // A stand-in for gmsh: what it makes of a file is its own affair.
  const tools = mkdtempSync(join(tmpdir(), "hersey-tools-"));
  const gmsh = join(tools, "gmsh");
  const parts = mkdtempSync(join(tmpdir(), "hersey-parts-"));
  writeFileSync(join(parts, "rod.step"), "ISO-10303-21;");
  const path = process.env.PATH;
  process.env.PATH = `${tools}${delimiter}/bin`;
  const other = await serve(resolve(program), parts);
  process.env.PATH = path;
  const shop = await open(await browser.newContext({ viewport: size, colorScheme: "light" }), other.address, /status of 4\d\d/);
  if (await shop.locator("dialog.templates").count()) await shop.keyboard.press("Escape");
  await shop.locator("dialog.templates").waitFor({ state: "detached" });
  const openPart = () => shop.locator('.file[data-path="rod.step"]').click();
  const make = () => shop.getByRole("button", { name: "Make the mesh" }).click();
  await openPart();
  if (!existsSync("/bin/gmsh")) {
    await make();
    await shop.locator(".cad-said.fault", { hasText: "apt-get install gmsh" }).waitFor();
  }
  await picture(shop, "25-cad");
  writeFileSync(gmsh, `#!/bin/sh\n/bin/cp ${join(root, "examples/meshes/conrod.msh")} part.msh\n`);
  chmodSync(gmsh, 0o755);
  await shop.getByLabel("Size of an element").fill("5 mm");
  await make();
  await shop.locator("dialog .mesh-table").waitFor();
  const found = await shop.locator("dialog .mesh-table").innerText();
  claim(/bore/.test(found) && found.includes("45 mm"), `found: ${found}`);
  claim((await shop.locator("dialog .template-text").innerText()).includes("mesh: rod.msh, length_unit: 1 m}"), "no lines of a model");
  await shop.locator('.file[data-path="rod.msh"]').waitFor();
  await picture(shop, "26-cad-mesh");
  await shop.keyboard.press("Escape");
  // One that takes long is stopped.
  writeFileSync(gmsh, "#!/bin/sh\nexec /bin/sleep 60\n");
  await openPart();
  await shop.getByLabel("Name of the mesh").fill("second.msh");
  await make();
  await shop.locator(".cad-said", { hasText: "at work" }).waitFor();
  await shop.locator(".cad-form").getByRole("button", { name: "Stop" }).click();
  await shop.locator(".cad-said.fault", { hasText: "stopped" }).waitFor();
  const faults = await accessibilityFaults(shop, "light");
  claim(faults.length === 0, faults.join("\n"));
  claim(!existsSync(join(parts, "second.msh")), "there is a mesh");
  claim(shop.complaints.length === 0, shop.complaints.join("\n"));
  await shop.context().close();
  await other.stop();
  forget(parts);
  forget(tools);
});

claim(page.complaints.length === 0, page.complaints.join("\n"));
await browser.close();
await server.stop();
forget(folder);
console.log(`${findings.held} held, ${findings.failed} failed, ${((performance.now() - begun) / 1000).toFixed(0)} s; pictures: ${pictures}`);
process.exit(findings.failed > 0 ? 1 : 0);
