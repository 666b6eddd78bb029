// What a report must do where the film does not close: of a pad on a plane runner.
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { bearingReport, everyReport, sweepReport } from "./checks.mjs";

const nodesAlong = 26;

/** What a figure saves as a table: its head, and rows of numbers. */
async function table(page, kind) {
  const button = page.locator(`[data-figure="${kind}"]`).first().getByRole("button", { name: /as CSV$/ });
  const [download] = await Promise.all([page.waitForEvent("download"), button.click()]);
  const [head, ...rows] = (await readFile(await download.path())).toString().split("\n");
  return { head, rows: rows.map((row) => row.split(",").map(Number)) };
}

const readable = (page) => page.evaluate(() => [...document.querySelector("#page").children].filter((e) => !e.matches(".licences")).map((e) => e.innerText).join("\n"));

const everyPad = {
  "no number is missing, and nothing is said of a journal": async (page) => {
    const text = await readable(page);
    for (const word of ["NaN", "undefined", "null", "Infinity", "journal", "eccentricity", "attitude", "shell", "unwrapped", "φ"])
      assert.doesNotMatch(text, new RegExp(`(?<!\\p{L})${word}(?!\\p{L})`, "iu"), `the page of a pad says ${word}`);
    for (const kind of ["locus", "orbit", "around", "eccentricity", "torque", "stability"]) assert.equal(await page.locator(`[data-figure="${kind}"]`).count(), 0, `there is a figure ${kind}`);
  },

  "the map goes from one end of the pad to the other": async (page) => {
    const { head, rows } = await table(page, "map");
    assert.match(head, /^"y \[mm\]","z \[mm\]",/);
    const [first, last] = [rows[0], rows[rows.length - 1]];
    [-25, -20, 25, 20].forEach((place, i) => assert.ok(Math.abs([first[0], first[1], last[0], last[1]][i] - place) < 1e-4, `the corners are ${first} and ${last}`));
    const canvas = page.locator('[data-figure="map"] canvas');
    await canvas.scrollIntoViewIfNeeded();
    const { width, height } = await canvas.boundingBox();
    // Just within the left border (field_map.ts: margin); on a film that closed this would be 0 degrees.
    await canvas.hover({ position: { x: 54, y: height / 2 } });
    assert.match(await page.locator('[data-figure="map"] .tooltip').innerText(), /y −2[45](\.\d+)?\smm, z .*mm/, "the map's left border is not the leading end");
    await canvas.hover({ position: { x: width - 94, y: height / 2 } });
    assert.match(await page.locator('[data-figure="map"] .tooltip').innerText(), /y 2[45](\.\d+)?\smm, z .*mm/, "the map's right border is not the trailing end");
    assert.match(await canvas.getAttribute("aria-label"), /pad/, "the map has the name of another film");
  },

  "the curve along the middle has the nodes once, over y": async (page) => {
    const { head, rows } = await table(page, "midplane");
    assert.match(head, /^"y \[mm\]"/);
    assert.equal(rows.length, nodesAlong, `${rows.length} places for ${nodesAlong} nodes`);
    rows.slice(1).forEach(([y], i) => assert.ok(y > rows[i][0], "the places do not ascend"));
    assert.match(await page.locator('[data-figure="midplane"] figcaption').first().innerText(), /middle of the pad/);
  },

  "the map shows every stored field": everyReport["the map shows every stored field"],
};

/** Of a pad by itself. */
export const padReport = {
  "verdict and key numbers are on the first screen": everyReport["verdict and key numbers are on the first screen"],
  "the first printed sheet holds verdict and key numbers, none is empty": everyReport["the first printed sheet holds verdict and key numbers, none is empty"],
  "title, conditions and status come first": everyReport["title, assumptions and status come first"],
  ...everyPad,

  "key numbers are those of a pad": async (page) => {
    const verdict = await page.locator(".verdict-line").innerText();
    assert.match(verdict, /µm at y\s=\s[−\d.]+\smm, z\s=\s[−\d.]+\smm/, `the verdict does not say where: ${verdict}`);
    for (const key of ["h_min", "p_max", "film_thickness_middle", "friction_runner", "side_flow", "power_film"])
      assert.match(await page.locator(`.solution [data-tile="${key}"] .tile-value`).innerText(), /\d/, `no key number ${key}`);
    for (const key of ["stiffness", "stiffness_along", "stiffness_across", "damping", "damping_along", "damping_across"])
      assert.match(await page.locator(`td[data-quantity="${key}"]`).innerText(), /\d.*N/, `${key} is missing`);
  },

  "the button switches to dark and back": bearingReport["the button switches to dark and back"],
  "a narrow screen needs no sideways scrolling": everyReport["a narrow screen needs no sideways scrolling"],
};

export const padSweepReport = {
  "the sweep has figures of a pad": async (page) => {
    for (const kind of ["film", "friction", "pressure", "centre", "stiffness", "tilt-stiffness", "damping", "tilt-damping", "flow", "power"])
      assert.match(await page.locator(`.study [data-figure="${kind}"] figcaption`).innerText(), /over load/, `no figure ${kind} over load`);
    // The model holds both slopes at zero.
    assert.equal(await page.locator('.study [data-figure="tilt"]').count(), 0, "slopes that are zero have a figure");
  },

  "an operating point chosen in the table is shown in detail": sweepReport["an operating point chosen in the table is shown in detail"],
};

/** Of a machine with a pad. */
export const padRunReport = {
  "verdict and key numbers are on the first screen": everyReport["verdict and key numbers are on the first screen"],
  "title, assumptions and status come first": everyReport["title, assumptions and status come first"],
  ...everyPad,
  "every figure is drawn": everyReport["every figure is drawn"],
  "the maps of the cycle differ": everyReport["the maps of the cycle differ"],

  "figures name the pad's own quantities": async (page) => {
    const caption = (kind) => page.locator(`[data-figure="${kind}"] figcaption`).first().innerText();
    assert.match(await caption("force"), /on the pad, in its axes/);
    assert.match(await caption("cycle"), /^.*The pad over/);
    assert.match(await page.locator('[data-figure="thickness"] .legend').innerText(), /at the pad’s middle/);
    assert.match(await page.locator('[data-figure="flow"] .legend').innerText(), /leading end[^]*trailing end/);
    const { head, rows } = await table(page, "sliding-speed");
    assert.match(head, /"sliding speed \[m\/s\]"$/);
    // The drive's speed, stored in single precision.
    for (const [, speed] of rows) assert.ok(Math.abs(speed - 3) < 1e-6, `the runner slides at ${speed} m/s`);
  },

  "the film lies in its bearing": async (page) => {
    assert.match(await page.locator('[data-figure="machine"] figcaption').innerText(), /Films lie in their bearings/);
    assert.match(await page.locator(".machine-legend").innerText(), /film of pad, 0 to [\d.]+ MPa/);
  },
};

/** Of a machine's steady state, which has one instant. */
export const padStateReport = {
  "verdict and key numbers are on the first screen": everyReport["verdict and key numbers are on the first screen"],
  "title, assumptions and status come first": everyReport["title, assumptions and status come first"],
  ...everyPad,

  "quantities over time are numbers, not empty axes": async (page) => {
    for (const kind of ["thickness", "peak-pressure", "force", "power", "flow"]) {
      const figure = page.locator(`[data-figure="${kind}"]`).first();
      assert.equal(await figure.locator("canvas").count(), 0, `${kind} is drawn over one instant`);
      assert.ok((await figure.locator("tr").count()) > 0, `${kind} says nothing`);
    }
    assert.match(await page.locator('[data-figure="force"] table').first().innerText(), /magnitude\s+98[01](\.\d+)?\sN/, "the film does not carry the carriage");
  },
};
