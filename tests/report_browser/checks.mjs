// What a report must do in a real browser. Each check gets an open page and throws where the report falls short.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { copyFile, mkdtemp, readFile, rm } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";

const frame = (page) => page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));

/** Number of pixels of each canvas in a figure that are coloured, not grey: frames and text alone do not count. */
const colouredPixels = (figure) =>
  figure.evaluate((element) =>
    [...element.querySelectorAll("canvas")].map((canvas) => {
      // Through a copy, so that a picture drawn by WebGL counts too.
      const copy = new OffscreenCanvas(canvas.width, canvas.height).getContext("2d");
      copy.drawImage(canvas, 0, 0);
      const { data } = copy.getImageData(0, 0, canvas.width, canvas.height);
      let count = 0;
      for (let i = 0; i < data.length; i += 4) {
        const [r, g, b, a] = data.slice(i, i + 4);
        if (a > 40 && Math.max(r, g, b) - Math.min(r, g, b) > 40) count++;
      }
      return count;
    }),
  );

/** The picture of a figure's canvases as text, to see whether it changed. */
const picture = (page, kind) =>
  page.evaluate((k) => [...document.querySelectorAll(`[data-figure="${k}"] canvas`)].map((c) => c.toDataURL()).join(), kind);

/** What the first screen of a desk must show without scrolling. */
async function onFirstScreen(page, locator, what) {
  const box = await locator.boundingBox();
  assert.ok(box !== null, `${what} is not shown`);
  assert.ok(box.y >= 0 && box.y + box.height <= 768, `${what} ends ${Math.round(box.y + box.height)} px down a screen of 768 px`);
}

const firstScreen = async (page) => {
  await page.setViewportSize({ width: 1366, height: 768 });
  // A smooth scroll that a check before has begun comes to its end first, however slow the machine.
  for (let still = 0, tries = 0; still < 3 && tries < 40; tries++) {
    await page.evaluate(() => scrollTo({ top: 0, behavior: "instant" }));
    await page.waitForTimeout(250);
    still = (await page.evaluate(() => scrollY)) === 0 ? still + 1 : 0;
  }
  await frame(page);
  assert.ok((await page.locator(".verdict .judgements li").count()) > 0, "there is no verdict");
  await onFirstScreen(page, page.locator(".verdict").first(), "the verdict");
  const tiles = page.locator(".tiles").first();
  assert.match(await tiles.innerText(), /\d/, "there are no key numbers");
  await onFirstScreen(page, tiles, "the row of key numbers");
  await page.setViewportSize({ width: 1280, height: 900 });
};

/** The page as it is printed, the text of each sheet: by pdftotext of poppler-utils. */
async function printed(page) {
  const folder = await mkdtemp(join(tmpdir(), "hersey-print-"));
  try {
    await page.pdf({ path: join(folder, "page.pdf"), preferCSSPageSize: true, printBackground: true });
    const text = execFileSync("pdftotext", ["-layout", join(folder, "page.pdf"), "-"]).toString();
    return text.split("\f").slice(0, -1);
  } finally {
    await rm(folder, { recursive: true });
  }
}

/** What the first sheet must hold, and none may be: empty, or buttons. */
const onPaper = async (page) => {
  const squeezed = (text) => text.replace(/\s+/g, "");
  const sheets = await printed(page);
  const first = squeezed(sheets[0]);
  const title = squeezed(await page.locator("h1").innerText());
  assert.ok(first.includes(title.slice(0, 20)), "the first sheet has no title");
  for (const text of (await page.locator(".verdict").first().locator(".judgements li").allInnerTexts()).map((t) => t.replace(/^\w+:\s*\n/, ""))) assert.ok(first.includes(squeezed(text)), `the first sheet lacks the verdict "${text}"`);
  const values = await page.locator(".tiles").first().locator(".tile-value").allInnerTexts();
  assert.ok(values.length >= 4, "there are no key numbers");
  for (const value of values) assert.ok(first.includes(squeezed(value).replace(/[⁰¹²³⁴⁵⁶⁷⁸⁹⁻]/g, "").slice(0, 5)), `the first sheet lacks the key number ${value}`);
  sheets.forEach((sheet, i) => assert.ok(sheet.trim().length > 0, `sheet ${i + 1} of ${sheets.length} is empty`));
  for (const word of ["PNG", "SVG", "CSV"]) assert.ok(!new RegExp(`\\b${word}\\b`).test(sheets.join("\n")), `buttons are printed: ${word}`);
};

async function openAssumptions(page) {
  if ((await page.locator("details.assumptions").first().getAttribute("open")) === null) await page.locator("details.assumptions > summary").first().click();
}

async function pressOnSlider(page, key) {
  await page.locator(".timeline-slider").focus();
  await page.keyboard.press(key);
  await frame(page);
}

/** Whether a figure shows a colour within seconds: it stands on the page some frames before its curve is drawn. */
async function becomesColoured(page, figure) {
  for (const end = Date.now() + 5000; Date.now() < end; await frame(page)) if (Math.max(...(await colouredPixels(figure))) > 0) return true;
  return false;
}

/** Of one run of a machine with a bearing. */
export const runReport = {
  "a quantity that the report knows nothing of has a curve all the same": async (page) => {
    const slot = /(<script id="hersey-data" type="application\/json">)([\s\S]*?)(<\/script>)/;
    const html = readFileSync(fileURLToPath(page.url()), "utf8");
    const data = JSON.parse(slot.exec(html)[2]);
    const { datasets } = data.runs[0];
    const film = Object.keys(datasets).find((path) => path.endsWith("/p_max")).replace("p_max", "");
    datasets[`${film}wear_depth`] = { ...datasets[`${film}p_max`], unit: "m", description: "depth worn off the shell" };
    datasets["/bodies/anything/load"] = { ...datasets[`${film}force`], description: "what it bears" };
    data.runs[0].attributes["/bodies/anything"] = {};
    const other = await page.context().browser().newPage();
    await other.setContent(html.replace(slot, (_, begin, __, end) => begin + JSON.stringify(data).replaceAll("</", "<\\/") + end));
    for (const [section, caption] of [["Further quantities of the film", "Wear depth: depth worn off the shell."], ["Bodies", "anything: Load: what it bears."]]) {
      await other.locator("details > summary", { hasText: section }).click();
      const figure = other.locator("figure", { hasText: caption });
      await figure.first().waitFor({ timeout: 5000 }).catch(() => {});  // a section draws when it has opened
      assert.equal(await figure.count(), 1, `no figure "${caption}"`);
      assert.ok(await becomesColoured(other, figure), `nothing is drawn of "${caption}"`);
    }
    await other.close();
  },
};

export const everyReport = {
  "verdict and key numbers are on the first screen": firstScreen,

  "the first printed sheet holds verdict and key numbers, none is empty": onPaper,

  "the licences of what the page contains stand at its foot": async (page) => {
    const foot = page.locator("footer.licences");
    await foot.locator("summary").click();
    const text = await foot.innerText();
    for (const part of ["uPlot", "three.js", "MIT", "Permission is hereby granted"]) assert.ok(text.includes(part), `no ${part} in the licences`);
    await foot.locator("summary").click();
  },

  "title, assumptions and status come first": async (page) => {
    assert.ok((await page.locator("h1").innerText()).trim().length > 0, "there is no title");
    await openAssumptions(page);
    const assumptions = await page.locator(".assumptions").first().innerText();
    assert.match(assumptions, /cavitation/i, "the assumptions do not name the cavitation condition");
    assert.ok((await page.locator(".status").count()) > 0, "how the run ended is not shown");
  },

  "the summary gives numbers with units": async (page) => {
    const moft = page.locator('.summary tr[data-quantity^="minimum film thickness (MOFT)"]').first();
    assert.match(await moft.innerText(), /\d.*µm/s, "the minimum film thickness has no value in µm");
    assert.ok((await page.locator(".tile").count()) >= 4, "key figures are missing");
  },

  "every figure is drawn": async (page) => {
    const figures = await page.locator("figure:visible").all();
    assert.ok(figures.length >= 8, `only ${figures.length} figures`);
    for (const figure of figures) {
      await figure.scrollIntoViewIfNeeded();
      await frame(page);
      const kind = await figure.getAttribute("data-figure");
      const counts = await colouredPixels(figure);
      assert.ok(counts.length > 0, `figure ${kind} has no canvas`);
      for (const count of counts) assert.ok(count > 30, `figure ${kind} is empty (${count} coloured pixels)`);
    }
  },

  "the mechanism is drawn as a graph: every body once, ground above all": async (page) => {
    await page.locator("summary", { hasText: /^Mechanism$/ }).click();
    // A section draws when it is opened, a moment after the click.
    await page.locator('[data-figure="graph"] .graph-name').first().waitFor();
    const names = await page.locator('[data-figure="graph"] .graph-name').allTextContents();
    assert.equal(names[0], "ground");
    assert.equal(new Set(names).size, names.length, `bodies twice: ${names.join(", ")}`);
    assert.ok((await page.locator('[data-figure="graph"] .graph-link.bearing').count()) > 0, "no bearing in the graph");
    await page.locator("summary", { hasText: /^Mechanism$/ }).click();
  },

  "the slider, moved by keys, changes map, mid-plane curve, orbit and machine": async (page) => {
    for (const kind of ["map", "midplane", "orbit", "machine"]) {
      const pictures = new Set();
      for (const key of ["Home", "ArrowRight", "ArrowRight", "PageUp", "PageUp", "End"]) {
        await pressOnSlider(page, key);
        pictures.add(await picture(page, kind));
      }
      assert.ok(pictures.size > 1, `figure ${kind} stays the same from the first instant to the last`);
    }
    await pressOnSlider(page, "Home");
    const first = await page.locator(".timeline-text").innerText();
    await pressOnSlider(page, "End");
    assert.notEqual(await page.locator(".timeline-text").innerText(), first, "the time beside the slider does not change");
    assert.match(first, /t = .* ms/, "the time beside the slider has no unit");
  },

  "play advances the instant and pause holds it": async (page) => {
    await pressOnSlider(page, "Home");
    await page.locator(".play").click();
    await page.waitForFunction(() => Number(document.querySelector(".timeline-slider").value) >= 2, null, { timeout: 5000 });
    await page.locator(".play").click();
    const stopped = await page.locator(".timeline-slider").inputValue();
    await page.waitForTimeout(300);
    assert.equal(await page.locator(".timeline-slider").inputValue(), stopped, "the pause button does not stop the film");
  },

  "the map shows every stored field": async (page) => {
    const choices = await page.locator('[data-figure="map"] .segmented').first().locator("label").all();
    assert.ok(choices.length >= 2, "only one field can be chosen");
    const pictures = new Set();
    for (const choice of choices) {
      await choice.click();
      await frame(page);
      pictures.add(await picture(page, "map"));
    }
    assert.equal(pictures.size, choices.length, "two choices of the map look the same");
  },

  "the maps of the cycle differ": async (page) => {
    const choices = await page.locator('[data-figure="cycle"] .segmented label').all();
    assert.ok(choices.length >= 4, "thickness and pressure, and when, cannot be chosen");
    const pictures = new Set();
    for (const choice of choices) {
      await choice.click();
      await frame(page);
      pictures.add(await picture(page, "cycle"));
    }
    assert.equal(pictures.size, choices.length, "two maps of the cycle look the same");
    assert.match(await page.locator('[data-figure="cycle"] figcaption').innerText(), /whole run|last of/, "which cycle is not said");
  },

  "maps over angle and time differ, follow the instant, and a click picks one": async (page) => {
    const figure = page.locator('[data-figure="around"]').first();
    await figure.scrollIntoViewIfNeeded();
    const pictures = new Set();
    for (const choice of await figure.locator(".segmented label").all()) {
      await choice.click();
      await frame(page);
      pictures.add(await picture(page, "around"));
    }
    assert.equal(pictures.size, 2, "thickness and pressure look the same");
    await pressOnSlider(page, "Home");
    const first = await picture(page, "around");
    const canvas = figure.locator("canvas");
    await canvas.scrollIntoViewIfNeeded();
    await canvas.click();
    await frame(page);
    assert.notEqual(await picture(page, "around"), first, "the mark of the instant stays");
    assert.ok(Number(await page.locator(".timeline-slider").inputValue()) > 0, "the click picks no instant");
    await canvas.hover();
    assert.match(await figure.locator(".tooltip").innerText(), /φ .*°, (time|crank angle) .*(s|°)/, "the tooltip does not tell where and when");
  },

  "tooltips tell values with units": async (page) => {
    const plot = page.locator('[data-figure="peak-pressure"] .u-over');
    await plot.scrollIntoViewIfNeeded();
    await plot.hover();
    const tooltip = page.locator('[data-figure="peak-pressure"] .tooltip');
    await tooltip.waitFor({ state: "visible", timeout: 2000 });
    assert.match(await tooltip.innerText(), /MPa/, "the tooltip of the peak pressure has no unit");
    const map = page.locator('[data-figure="map"] canvas');
    await map.scrollIntoViewIfNeeded();
    await map.hover();
    assert.match(await page.locator('[data-figure="map"] .tooltip').innerText(), /φ .*°, z .*mm/, "the map's tooltip does not tell where");
  },

  "figures are saved as drawings, pictures and tables": async (page) => {
    const saved = async (kind, format) => {
      const waiting = page.waitForEvent("download");
      await page.locator(`[data-figure="${kind}"]`).first().getByRole("button", { name: new RegExp(`as ${format}$`) }).click();
      const download = await waiting;
      return { name: download.suggestedFilename(), content: await readFile(await download.path()) };
    };
    const drawing = await saved("thickness", "SVG");
    assert.match(drawing.name, /\.svg$/);
    const text = drawing.content.toString();
    assert.match(text, /^<svg[^]*film thickness \[µm\][^]*<path d="M[\d. ]+L[^]*<\/svg>$/, "the drawing has no axis or no curve");
    const wellFormed = await page.evaluate((t) => new DOMParser().parseFromString(t, "image/svg+xml").querySelector("parsererror") === null, text);
    assert.ok(wellFormed, "the drawing is not well-formed");
    for (const kind of ["thickness", "map", "orbit", "machine"]) {
      const { content } = await saved(kind, "PNG");
      assert.ok(content.length > 2000 && content.toString("latin1", 1, 4) === "PNG", `the picture of ${kind} is none`);
    }
    for (const [kind, columns] of [["thickness", 2], ["map", 3], ["orbit", 3], ["cycle", 3], ["around", 3]]) {
      const rows = (await saved(kind, "CSV")).content.toString().split("\n");
      assert.ok(rows.length > 2 && rows[1].split(",").length >= columns, `the table of ${kind} has too little`);
      assert.ok(rows[1].split(",").every((cell) => cell === "" || Number.isFinite(Number(cell))), `the table of ${kind} has no numbers: ${rows[1]}`);
    }
  },

  "figures over one abscissa share their cursor": async (page) => {
    const plot = page.locator('[data-figure="peak-pressure"] .u-over');
    await plot.scrollIntoViewIfNeeded();
    await plot.hover();
    const cursors = await page.locator('[data-figure="force"] .u-cursor-x').evaluate((e) => e.style.transform);
    assert.doesNotMatch(cursors, /translate\(-/, "the cursor of another figure does not follow");
    assert.equal(await page.locator('[data-figure="force"] .tooltip:visible').count(), 0, "a tooltip stands where no pointer is");
    await page.mouse.move(0, 0);
  },

  "orbit, map and machine follow the pointer in a figure, and go back when it leaves": async (page) => {
    await pressOnSlider(page, "Home");
    const look = async () => Object.fromEntries(await Promise.all(["orbit", "map", "machine"].map(async (kind) => [kind, await picture(page, kind)])));
    const plot = page.locator('[data-figure="peak-pressure"] .u-over');
    await plot.scrollIntoViewIfNeeded();
    await frame(page);
    const [before, reported] = [await look(), await page.locator(".timeline-text").innerText()];
    await plot.hover();
    await frame(page);
    const during = await look();
    for (const kind of Object.keys(before)) if (before[kind]) assert.notEqual(during[kind], before[kind], `figure ${kind} does not follow`);
    assert.notEqual(await page.locator(".timeline-text").innerText(), reported, "the instant of the cursor is not shown");
    assert.equal(await page.locator(".timeline-slider").inputValue(), "0", "the slider has moved without being touched");
    await page.mouse.move(0, 0);
    await frame(page);
    const after = await look();
    for (const kind of Object.keys(before)) assert.equal(after[kind], before[kind], `figure ${kind} does not go back`);
    assert.equal(await page.locator(".timeline-text").innerText(), reported, "the instant shown is not reported again");
  },

  "keys move a figure's cursor, and the others with it": async (page) => {
    await pressOnSlider(page, "Home");
    const place = () => page.locator('[data-figure="force"] .u-cursor-x').evaluate((e) => e.style.transform);
    const plot = page.locator('[data-figure="peak-pressure"] .u-over');
    await plot.focus();
    await page.keyboard.press("End");
    await frame(page);
    const [end, last] = [await place(), await plot.getAttribute("aria-valuetext")];
    assert.equal(await plot.getAttribute("aria-valuenow"), await plot.getAttribute("aria-valuemax"), "End does not lead to the last row");
    assert.ok(await page.locator('[data-figure="peak-pressure"] .tooltip').isVisible(), "the numbers at the cursor are not shown");
    await page.keyboard.press("Shift+ArrowLeft");
    await frame(page);
    assert.equal(Number(await plot.getAttribute("aria-valuemax")) - Number(await plot.getAttribute("aria-valuenow")), 10, "Shift and an arrow do not go ten rows");
    assert.notEqual(await place(), end, "the cursor of another figure does not follow");
    assert.notEqual(await plot.getAttribute("aria-valuetext"), last, "what is read out does not change");
    await page.keyboard.press("Enter");
    await frame(page);
    assert.notEqual(await page.locator(".timeline-slider").inputValue(), "0", "Enter does not choose the instant");
    await page.keyboard.press("Escape");
    await frame(page);
    assert.match(await place(), /translate\(-/, "Escape does not take the cursor away");
  },

  "a legend entry hides its curve": async (page) => {
    const before = await picture(page, "thickness");
    await page.locator('[data-figure="thickness"] .legend-entry').first().click();
    await frame(page);
    assert.notEqual(await picture(page, "thickness"), before, "the curve is still there");
    await page.locator('[data-figure="thickness"] .legend-entry').first().click();
  },

  "collapsed sections draw when opened": async (page) => {
    for (const details of await page.locator(".sections details").all()) {
      if ((await details.getAttribute("open")) !== null || (await details.locator("pre").count()) > 0) continue;
      await details.locator("summary").click();
      await frame(page);
      const figure = details.locator("figure").first();
      await figure.scrollIntoViewIfNeeded();
      await frame(page);
      const counts = await colouredPixels(figure);
      const isDrawing = (await figure.locator("svg").count()) > 0;
      assert.ok(isDrawing || counts.some((n) => n > 30), `section "${await details.locator("summary").innerText()}" draws nothing`);
    }
  },

  "light and dark schemes differ, and the button switches": async (page) => {
    const look = async () => [
      await page.evaluate(() => getComputedStyle(document.body).backgroundColor),
      await picture(page, "thickness"),
    ];
    await page.emulateMedia({ colorScheme: "light" });
    await frame(page);
    const light = await look();
    await page.emulateMedia({ colorScheme: "dark" });
    await frame(page);
    const dark = await look();
    assert.notEqual(dark[0], light[0], "the background does not follow the system's scheme");
    assert.notEqual(dark[1], light[1], "the figures are not redrawn for the dark scheme");
    await page.locator(".theme-button").click();
    await frame(page);
    assert.deepEqual(await look(), light, "the button does not bring the light scheme back");
  },

  "a narrow screen needs no sideways scrolling": async (page) => {
    await page.setViewportSize({ width: 390, height: 800 });
    await frame(page);
    const [content, screen] = await page.evaluate(() => [document.documentElement.scrollWidth, innerWidth]);
    await page.setViewportSize({ width: 1280, height: 900 });
    assert.ok(content <= screen, `the page is ${content} px wide on a screen of ${screen} px`);
  },

  "paper is white and without controls": async (page) => {
    await page.emulateMedia({ media: "print", colorScheme: "light" });
    await frame(page);
    assert.equal(await page.locator(".timeline").isVisible(), false, "the slider would be printed");
    await page.emulateMedia({ media: "screen" });
  },
};

const spectra = (page) => page.locator(".sections details", { has: page.locator("summary", { hasText: /^Spectra and orders$/ }) });

/** What a figure saves as a table: its head, and rows of numbers. */
async function table(page, figure) {
  const waiting = page.waitForEvent("download");
  await figure.getByRole("button", { name: /as CSV$/ }).click();
  const [head, ...rows] = (await readFile(await (await waiting).path())).toString().split("\n");
  return { head, rows: rows.map((row) => row.split(",").map(Number)) };
}

/** Of runs with as many instants as spectra need. */
export const spectraReport = {
  "the spectrum of any series is shown, over frequency and with a logarithmic scale": async (page) => {
    const section = spectra(page);
    if ((await section.getAttribute("open")) === null) await section.locator("summary").click();
    const figure = section.locator('[data-figure="spectrum"]');
    await figure.waitFor();
    await figure.scrollIntoViewIfNeeded();
    await frame(page);
    const picker = page.getByLabel("Series whose spectrum is shown");
    assert.ok((await picker.locator("option").count()) > 10, "there is little to choose from");
    const before = [await picture(page, "spectrum"), await figure.locator("figcaption").innerText()];
    await picker.selectOption(await picker.locator("option", { hasText: /peak film pressure|p max/i }).first().getAttribute("value"));
    await frame(page);
    const after = [await picture(page, "spectrum"), await figure.locator("figcaption").innerText()];
    before.forEach((look, i) => assert.notEqual(after[i], look, "another series looks the same"));
    await section.getByText("Logarithmic", { exact: true }).click();
    await frame(page);
    assert.notEqual(await picture(page, "spectrum"), after[0], "the logarithmic scale looks like the linear one");
    const { head, rows } = await table(page, section.locator('[data-figure="spectrum"]'));
    assert.match(head, /frequency \[Hz\].*amplitude \[MPa\]/);
    assert.ok(rows.length > 16 && rows.every((row) => row.every(Number.isFinite)), "the table has no numbers");
    await section.getByText("Linear", { exact: true }).click();
    await section.locator("summary").click();
  },
};

/** Of a run with more stored fields than the page holds. */
export const besideReport = {
  "the page is below 8 MB, and opens in under 2 s of the browser's own time": async (page) => {
    const file = fileURLToPath(page.url());
    assert.ok((await readFile(file)).length < 8e6, "the page is too large");
    const client = await page.context().newCDPSession(page);
    await client.send("Performance.enable", { timeDomain: "threadTicks" });
    await page.reload();
    await page.waitForSelector("figure canvas");
    const { metrics } = await client.send("Performance.getMetrics");
    const work = metrics.find(({ name }) => name === "TaskDuration").value;
    assert.ok(work < 2, `the page needs ${work} s to open`);
  },

  "all fields are loaded from the file beside the page when asked for": async (page) => {
    const button = page.getByRole("button", { name: /^Load all \d+ \([\d.]+ MB\)$/ });
    const wanted = Number(/\d+/.exec(await button.innerText())[0]);
    const instants = () => page.locator(".timeline-slider").getAttribute("max").then((max) => Number(max) + 1);
    const before = await instants();
    assert.ok(before < wanted, `the page has ${before} of ${wanted} instants`);
    await button.click();
    await page.waitForFunction((n) => Number(document.querySelector(".timeline-slider").max) + 1 === n, wanted);
    assert.equal(await button.count(), 0, "they can be loaded again");
    await pressOnSlider(page, "Home");
    await pressOnSlider(page, "End");
    assert.ok((await colouredPixels(page.locator('[data-figure="map"]')))[0] > 1000, "the map is empty");
  },

  "a page without its file says so, and goes on": async (page) => {
    const folder = await mkdtemp(join(tmpdir(), "hersey-alone-"));
    const alone = await page.context().browser().newPage();
    try {
      await copyFile(fileURLToPath(page.url()), join(folder, "report.html"));
      await alone.goto(pathToFileURL(join(folder, "report.html")).href);
      await alone.getByRole("button", { name: /^Load all/ }).click();
      await alone.getByText(/report_fields\/\S+ is not beside this page/).waitFor();
    } finally {
      await alone.close();
      await rm(folder, { recursive: true });
    }
  },
};

/** Of tests/report_browser/run_up.yaml: a slider swings by 1 mm once a turn, by 0.25 mm three times, while the shaft runs up. */
export const runUpReport = {
  "verdict and key numbers are on the first screen": firstScreen,

  "order tracks have the amplitudes of the orders, over the speed": async (page) => {
    await page.getByLabel("Series whose spectrum is shown").selectOption("/bodies/slider/position#0");
    const figure = page.locator('[data-figure="order-tracks"]');
    await figure.scrollIntoViewIfNeeded();
    await frame(page);
    assert.deepEqual(await figure.locator(".legend-entry").allInnerTexts(), ["order 0.5", "order 1", "order 2", "order 3"]);
    const { head, rows } = await table(page, figure);
    assert.match(head, /speed of hinge \[rpm\]/);
    const inner = rows.filter(([speed]) => speed > 1000 && speed < 2900);
    assert.ok(inner.length > 50, `${inner.length} speeds`);
    // Series have single precision; rows at 1 kHz, six and more of them a period of order 3.
    for (const [speed, half, first, second, third] of inner) {
      assert.ok(Math.abs(first - 1) < 0.01 && Math.abs(third - 0.25) < 0.02, `at ${speed} rpm orders 1 and 3 have ${first} and ${third} mm`);
      assert.ok(half < 0.01 && second < 0.02, `at ${speed} rpm orders 0.5 and 2 have ${half} and ${second} mm`);
    }
  },

  "the waterfall's ridge lies on the first order": async (page) => {
    const figure = page.locator('[data-figure="waterfall"]');
    assert.match(await figure.locator("svg").getAttribute("aria-label"), /largest amplitude [\d.]+ mm at [\d.]+ Hz/);
    const { head, rows } = await table(page, figure);
    assert.match(head, /speed \[rpm\].*frequency \[Hz\].*\[mm\]/);
    const peaks = new Map();
    for (const [speed, frequency, amplitude] of rows) if (!(peaks.get(speed)?.amplitude >= amplitude)) peaks.set(speed, { frequency, amplitude });
    assert.ok(peaks.size > 10, `${peaks.size} spectra`);
    for (const [speed, { frequency }] of peaks)
      // Within a piece of 1/15 of the run the speed changes by 200 rpm.
      if (speed > 600) assert.ok(Math.abs(frequency - speed / 60) < 4, `at ${speed} rpm the peak is at ${frequency} Hz`);
  },

  "the run-up has amplitude and phase of its orders over the speed, without order 3 beside them": async (page) => {
    assert.ok(await page.locator("summary", { hasText: /^Run-up$/ }).isVisible(), "there is no section on the run-up");
    const [sizes, phases] = ["amplitude", "phase"].map((name) => page.locator(`[data-figure="run-up-${name}"]`));
    await sizes.scrollIntoViewIfNeeded();
    await frame(page);
    assert.deepEqual(await sizes.locator(".legend-entry").allInnerTexts(), ["0.5×", "1×", "2×", "peak to peak"]);
    const { head, rows } = await table(page, sizes);
    // Half of what it moves is below a millimetre: micrometres.
    assert.match(head, /speed of hinge \[rpm\].*\[µm\]/);
    const inner = rows.filter(([speed]) => speed > 1000 && speed < 2900);
    assert.ok(inner.length > 50, `${inner.length} speeds`);
    // Single precision, 20 rows a revolution and more; sin a + sin(3 a)/4 reaches 0.891, between two rows at worst.
    for (const [speed, ...amplitudes] of inner) {
      const [half, first, second, whole] = amplitudes.map((a) => a / 1000);
      assert.ok(Math.abs(first - 1) < 0.005, `at ${speed} rpm order 1 has ${first} mm`);
      assert.ok(half < 0.005 && second < 0.005, `at ${speed} rpm orders 0.5 and 2 have ${half} and ${second} mm`);
      assert.ok(Math.abs(whole - 2 * 0.891) < 0.03, `at ${speed} rpm the slider moves by ${whole} mm`);
    }
    for (const [speed, lag] of (await table(page, phases)).rows)
      if (speed > 1000) assert.ok(Math.abs(lag - 90) < 0.5, `at ${speed} rpm the sine lags behind by ${lag} deg`);
  },

  "the map of the run-up's spectra is bright on the first order alone": async (page) => {
    const figure = page.locator('[data-figure="run-up-map"]');
    await figure.scrollIntoViewIfNeeded();
    await frame(page);
    const { rows } = await table(page, page.locator('[data-figure="run-up-waterfall"]'));
    const speeds = [...new Set(rows.map(([speed]) => speed))].sort((a, b) => a - b);
    const highest = Math.max(...rows.map(([, frequency]) => frequency));
    const [low, high] = [speeds[0], speeds[speeds.length - 1]];
    const canvas = figure.locator("canvas");
    const { width, height } = await canvas.boundingBox();
    // The margins of the map.
    const decibels = async (speed, frequency) => {
      const x = 62 + ((width - 62 - 92) * frequency) / highest;
      await canvas.hover({ position: { x, y: 10 + (height - 10 - 44) * (1 - (speed - low) / (high - low)) } });
      const [, value] = /, (\S+) dB/.exec(await figure.locator(".tooltip").innerText());
      return Number(value.replace("−", "-"));
    };
    for (const speed of speeds.filter((s) => s > 1500 && s < 2900)) {
      // The speed rises by 60 rpm and more within a piece: order 1 spreads over some lines.
      assert.ok((await decibels(speed, speed / 60)) > -8, `dark on the first order at ${speed} rpm`);
      assert.ok((await decibels(speed, (2 * speed) / 60)) < -20, `bright on the second order at ${speed} rpm`);
    }
  },

  "curves are drawn over the speed, and marked where the instant is": async (page) => {
    const label = () => page.locator('[data-figure="slider-position"] .u-over, [data-figure="hinge-rates"] .u-over').first().getAttribute("aria-label");
    if ((await page.locator("details:has(summary:text-is('Joints'))").getAttribute("open")) === null) await page.locator("summary", { hasText: /^Joints$/ }).click();
    await frame(page);
    assert.match(await label(), /against time$/);
    await page.getByText("Speed", { exact: true }).click();
    await frame(page);
    assert.match(await label(), /against speed$/);
    const { head, rows } = await table(page, page.locator('[data-figure="hinge-rates"]'));
    assert.match(head, /^"speed \[rpm\]"/);
    // In the second half of the run: the mean over a turn is below the speed itself by the square of what it gains in the turn.
    for (const [speed, rate] of rows.slice(1000, -300)) assert.ok(Math.abs(speed - (60 * rate) / (2 * Math.PI)) < 2, `${speed} rpm at ${rate} rad/s`);
    await page.getByText("Time", { exact: true }).click();
  },

  "drawings are saved as pictures, too": async (page) => {
    for (const [format, start] of [["PNG", "\x89PNG"], ["SVG", "<svg"]]) {
      const waiting = page.waitForEvent("download");
      await page.locator('[data-figure="waterfall"]').getByRole("button", { name: new RegExp(`as ${format}$`) }).click();
      const content = await readFile(await (await waiting).path());
      assert.equal(content.toString("latin1", 0, 4), start);
      assert.ok(content.length > 5000, `the ${format} has ${content.length} bytes`);
    }
  },
};

/** Of small motions about one state. */
export const modesReport = {
  "verdict and key numbers are on the first screen": firstScreen,

  "modes are listed with their frequencies, in the table too": async (page) => {
    const options = await page.locator(".mode-player option").allTextContents();
    assert.ok(options.length > 0 && options.every((text) => /^Mode \d+: .*\d Hz/.test(text)), options.join(" | "));
    assert.ok((await page.locator('tr[data-quantity^="mode 1"]').count()) > 0, "the table has no modes");
  },

  "a mode is played on the machine, and stopped": async (page) => {
    const button = page.getByRole("button", { name: "Play mode" });
    await frame(page);
    const still = await picture(page, "machine");
    await button.click();
    await page.waitForTimeout(300);
    const moving = await picture(page, "machine");
    assert.notEqual(moving, still, "nothing moves");
    await button.click();
    await frame(page);
    assert.equal(await picture(page, "machine"), still, "the machine does not come back");
  },
};

export const studyReport = {
  "the study compares all runs and shows the paper's figures": async (page) => {
    const rows = await page.locator(".comparison tbody tr").count();
    assert.ok(rows > 1, "the comparison table has no runs");
    assert.ok((await page.locator('[data-figure="study-midplane"]').count()) >= 1, "no figure of mid-plane pressures");
    assert.ok((await page.locator('[data-figure="study-film-thickness"]').count()) === 1, "no figure of film thickness");
    const curves = await page.locator('[data-figure="study-midplane"] .legend-entry').count();
    assert.equal(curves, rows, `${curves} mid-plane curves for ${rows} runs`);
  },

  "a run chosen in the table is shown in detail": async (page) => {
    const button = page.locator(".comparison tbody button").first();
    await button.click();
    await frame(page);
    assert.equal(await button.getAttribute("aria-pressed"), "true", "the table does not mark the chosen run");
    const before = await page.locator(".detail .tile").first().innerText();
    await page.locator(".comparison tbody button").nth(1).click();
    await frame(page);
    assert.notEqual(await page.locator(".detail .tile").first().innerText(), before, "the detail still shows the first run");
  },
};

/** Reports of runs that no study has made, in files of one name. */
export const comparisonReport = {
  "compared runs stand under their own names, with their own numbers": async (page) => {
    const rows = page.locator(".comparison tbody tr");
    const names = await rows.locator("td:first-child").allInnerTexts();
    assert.equal(new Set(names).size, names.length, `a run stands twice: ${names.join(", ")}`);
    assert.ok(names.length > 1 && !names.includes("results"), `runs without names of their own: ${names.join(", ")}`);
    const numbers = await rows.locator("td.number:nth-last-child(5)").allInnerTexts();
    assert.equal(new Set(numbers).size, names.length, `runs with one number: ${numbers.join(", ")}`);
    const curves = await page.locator('[data-figure="study-midplane"] .legend-entry').allInnerTexts();
    assert.deepEqual(curves.map((text) => text.trim().split("\n")[0]), names, "the curves have other names");
    assert.deepEqual(await page.locator(".detail select option").allInnerTexts(), names, "the runs to choose from have other names");
  },

  "runs are laid over each other, with their differences and a table of changes": async (page) => {
    const names = await page.locator(".study > .wide-table .comparison tbody td:first-child").allInnerTexts();
    for (const figure of await page.locator('[data-figure="overlay"]').all())
      assert.deepEqual(await figure.locator(".legend-entry").allInnerTexts(), names, "an overlay lacks a run");
    assert.ok((await page.locator('[data-figure="overlay"]').count()) >= 5, "too few quantities are laid over each other");
    assert.equal(await page.locator('[data-figure="difference"]').count(), await page.locator('[data-figure="overlay"]').count(), "an overlay has no differences");
    const row = page.locator('.changes tr[data-quantity="minimum film thickness at the end"]');
    const [before, after, change] = (await row.locator("td").allInnerTexts()).map((text) => parseFloat(text.replace("−", "-")));
    // Each is printed with four digits.
    assert.ok(Math.abs(after - before - change) <= 2e-3 * Math.abs(after), `${after} less ${before} is reported as ${change}`);
    assert.match(await row.innerText(), /\([+−][\d.]+ %\)/, "the change has no share");
    const picker = page.getByLabel("Further quantity laid over each other");
    assert.ok((await picker.locator("option").count()) > 10, "the film's further quantities cannot be chosen");
    const shown = await page.locator('[data-figure="overlay"] figcaption').last().innerText();
    await picker.selectOption("cavitated_share");
    await frame(page);
    assert.notEqual(await page.locator('[data-figure="overlay"] figcaption').last().innerText(), shown, "the chosen quantity is not shown");
    const reference = page.getByLabel("Run the others are compared with");
    await reference.selectOption("1");
    await frame(page);
    assert.match(await page.locator('[data-figure="difference"] .legend').first().innerText(), new RegExp(`${names[0]} − ${names[1]}`), "the reference stays the same");
    await reference.selectOption("0");
  },

  "each run can be shown": async (page) => {
    for (const row of await page.locator(".comparison tbody tr").all()) {
      await row.locator("button").click();
      await frame(page);
      assert.equal(await page.locator(".comparison tr.chosen").count(), 1, "the table marks several runs");
      const name = await row.locator("td").first().innerText();
      assert.equal(await page.locator(".detail select option:checked").innerText(), name);
    }
  },
};

/** Reports of a machine with several bearings. */
export const machineReport = {
  "verdict and key numbers are on the first screen": firstScreen,
  "the first printed sheet holds verdict and key numbers, none is empty": onPaper,

  "all bearings stand in one table, the worst first, and the verdict names it": async (page) => {
    const rows = page.locator(".overview tbody tr");
    const names = await rows.locator("th").allInnerTexts();
    assert.ok(names.length > 1, "there are not several bearings");
    const thickness = (await rows.locator("td:nth-child(2) .extreme-value").allInnerTexts()).map(parseFloat);
    assert.deepEqual(thickness, [...thickness].sort((a, b) => a - b), "the thinnest film is not first");
    assert.equal((await page.locator(".verdict-line strong").innerText()).trim(), names[0].trim(), "the verdict names another bearing");
    for (const row of await rows.all()) {
      assert.equal(await row.locator(".spark-curve").count(), 2, "a bearing has no spark lines");
      assert.equal((await row.locator(".where").allInnerTexts()).length, 2, "an extreme has no place");
    }
    assert.match(await page.locator(".overview tfoot").innerText(), /together.*\d/s, "there are no sums");
  },

  "assumptions name each topic once, and bearings where they differ": async (page) => {
    await openAssumptions(page);
    const topics = await page.locator(".assumptions dt").allInnerTexts();
    assert.equal(new Set(topics).size, topics.length, `a topic stands twice: ${topics.join(", ")}`);
    const answer = (topic) => page.locator(`.assumptions dt:text-is("${topic}") + dd`).innerText();
    assert.match(await answer("clearance"), /main left, main right: 30 µm.*big end: 28 µm.*small end: 12 µm/s);
    assert.doesNotMatch(await answer("compliance"), /main left/, "what all bearings share is said of one of them");
  },

  "how far cycles repeat stands in the summary, what steps cost with the solution": async (page) => {
    assert.ok((await page.locator('.summary tr[data-quantity="cycles"]').count()) === 1, "the cycles are not counted");
    assert.ok((await page.locator('.summary.cost tr[data-quantity^="share of computing time"]').count()) >= 4, "no shares of computing time");
  },

  "each bearing can be chosen": async (page) => {
    const tile = page.locator(".bearing-tiles .tile").first();
    const before = await tile.innerText();
    await page.locator(".overview").getByText("main left", { exact: true }).click();
    await frame(page);
    const after = await tile.innerText();
    assert.notEqual(after, before, "the figures are still those of the worst bearing");
    await page.getByLabel("Bearing shown in detail").selectOption("small_end");
    await frame(page);
    assert.notEqual(await tile.innerText(), after, "the list of bearings chooses none");
    assert.equal(await page.locator(".overview tr.chosen button").innerText(), "small end", "the overview marks another bearing");
  },
};

/** Reports of a bearing by itself. */
export const bearingReport = {
  "verdict and key numbers are on the first screen": firstScreen,
  "the first printed sheet holds verdict and key numbers, none is empty": onPaper,
  "title, conditions and status come first": everyReport["title, assumptions and status come first"],
  "the licences of what the page contains stand at its foot": everyReport["the licences of what the page contains stand at its foot"],

  "key figures carry the grid's error, tables their units": async (page) => {
    const tile = await page.locator('[data-tile="h_min"]').innerText();
    assert.match(tile, /\d.*µm[\s\S]*± [\d.].*\(grid\)/, `the smallest film thickness has no grid error: ${tile}`);
    assert.match(await page.locator('tr[data-quantity="side_flow"]').innerText(), /mm³\/s/, "the side flow has no unit");
    for (const key of ["K_xx", "C_yy", "stiffness_xy"])
      assert.match(await page.locator(`td[data-quantity="${key}"]`).innerText(), /\d/, `${key} is missing`);
  },

  "every figure is drawn": async (page) => {
    for (const kind of ["locus", "map", "midplane"]) assert.ok((await page.locator(`[data-figure="${kind}"]`).count()) > 0, `figure ${kind} is missing`);
    for (const figure of await page.locator("figure:visible").all()) {
      await figure.scrollIntoViewIfNeeded();
      await frame(page);
      for (const count of await colouredPixels(figure)) assert.ok(count > 30, `figure ${await figure.getAttribute("data-figure")} is empty`);
    }
  },

  "the map shows every stored field and tells where": async (page) => {
    await everyReport["the map shows every stored field"](page);
    const map = page.locator('[data-figure="map"] canvas');
    await map.hover();
    assert.match(await page.locator('[data-figure="map"] .tooltip').innerText(), /φ .*°, z .*mm/, "the map's tooltip does not tell where");
  },

  "stiffness and damping carry their grid error": async (page) => {
    const errors = await page.locator(".matrix tfoot").allInnerTexts();
    assert.equal(errors.length, 4, "not every matrix has an error");
    for (const error of errors) assert.match(error, /^± [\d.,·⁻⁰-⁹]+ \(grid\)$/, `no error: ${error}`);
  },

  "the button switches to dark and back": async (page) => {
    const look = () => picture(page, "map");
    const before = await look();
    await page.locator(".theme-button").click();
    await frame(page);
    assert.notEqual(await look(), before, "the figures are not redrawn");
    await page.locator(".theme-button").click();
    await frame(page);
    assert.equal(await look(), before, "the button does not bring the scheme back");
  },

  "a narrow screen needs no sideways scrolling": everyReport["a narrow screen needs no sideways scrolling"],
};

export const sweepReport = {
  "captions name what is varied, and negative coefficients their sign": async (page) => {
    const swept = (await page.locator(".study h2").first().innerText()).replace(/^Sweep over /, "").split(" and ")[0];
    for (const kind of ["film", "eccentricity", "friction", "pressure", "stiffness", "damping", "stability", "flow", "power"]) {
      const caption = await page.locator(`.study [data-figure="${kind}"] figcaption`).first().innerText();
      assert.ok(caption.includes(`over ${swept}`), `the caption of ${kind} does not say over ${swept}: ${caption}`);
    }
    // In every plain bearing one of the cross stiffnesses is negative at some speed.
    const legend = await page.locator('.study [data-figure="stiffness"] .legend').first().innerText();
    assert.match(legend, /−K(xy|yx)/, `no negative stiffness is reported as such: ${legend}`);
    assert.match(legend, /(^|\n)Kxx/, `no positive stiffness: ${legend}`);
  },

  "the sweep has a curve and a row per operating point": async (page) => {
    const rows = await page.locator(".comparison tbody tr").count();
    assert.ok(rows > 2, `${rows} rows`);
    for (const kind of ["film", "eccentricity", "friction", "stiffness", "damping", "flow"])
      assert.ok((await page.locator(`.study [data-figure="${kind}"]`).count()) > 0, `no figure of ${kind}`);
  },

  "an operating point chosen in the table is shown in detail": async (page) => {
    const buttons = page.locator(".comparison tbody button");
    await buttons.first().click();
    await frame(page);
    const before = await page.locator('[data-tile="h_min"]').innerText();
    await buttons.nth(1).click();
    await frame(page);
    assert.equal(await buttons.nth(1).getAttribute("aria-pressed"), "true", "the table does not mark the chosen point");
    assert.notEqual(await page.locator('[data-tile="h_min"]').innerText(), before, "the detail still shows the first point");
  },
};
