// What a report must do where a bearing has two films: of a floating ring by itself.
import assert from "node:assert/strict";
import { bearingReport, everyReport } from "./checks.mjs";

const films = ["inner", "outer"];
const readable = (page) => page.evaluate(() => [...document.querySelector("#page").children].filter((e) => !e.matches(".licences")).map((e) => e.innerText).join("\n"));

export const ringReport = {
  "verdict and key numbers are on the first screen": bearingReport["verdict and key numbers are on the first screen"],
  "title, conditions and status come first": bearingReport["title, conditions and status come first"],
  "a narrow screen needs no sideways scrolling": everyReport["a narrow screen needs no sideways scrolling"],

  "no number is missing, nor said in dashes": async (page) => {
    const text = await readable(page);
    for (const word of ["NaN", "undefined", "null", "Infinity"]) assert.doesNotMatch(text, new RegExp(`(?<!\\p{L})${word}(?!\\p{L})`, "iu"), `the page of a ring says ${word}`);
    for (const cell of await page.locator("td.number, .tile").allInnerTexts()) assert.match(cell, /\d/, `a cell without a number: ${cell}`);
  },

  "tiles, tables and verdict tell of both films": async (page) => {
    for (const film of films) {
      assert.match(await page.locator(`.solution [data-tile="film_h_min_${film}"]`).innerText(), /\d.*µm/, `no tile of the ${film} film`);
      assert.ok((await page.locator(`tr[data-quantity="film_power_${film}"]`).count()) > 0, `no power of the ${film} film`);
    }
    assert.match(await page.locator(".verdict-line").innerText(), /(inner|outer) film/, "the verdict does not say which film is thinnest");
    assert.equal(await page.locator(".matrix").count(), 2, "there are matrices of what a ring has not");
  },

  "each film has its map, its middle and its circle": async (page) => {
    for (const kind of ["map", "midplane", "locus"])
      for (const film of films) {
        const figure = page.locator(`.solution [data-figure="${kind}-${film}"]`);
        assert.equal(await figure.count(), 1, `figure ${kind} of the ${film} film is missing`);
        assert.match(await figure.locator("figcaption").innerText(), new RegExp(kind === "locus" ? "ring" : `${film} film`), `the caption of ${kind} does not say which film`);
      }
    const drawn = (film) => page.locator(`.solution [data-figure="map-${film}"] canvas`).first().evaluate((canvas) => canvas.toDataURL());
    assert.notEqual(await drawn("inner"), await drawn("outer"), "both maps show the same film");
  },
};

export const ringSweepReport = {
  ...ringReport,
  "each figure of the sweep has both films": async (page) => {
    for (const kind of ["film", "ring-speed", "eccentricity", "pressure", "power", "stiffness", "damping"])
      assert.equal(await page.locator(`.study [data-figure="${kind}"]`).count(), 1, `figure ${kind} is missing`);
    for (const kind of ["film", "eccentricity", "pressure", "power"])
      for (const film of films) assert.match(await page.locator(`.study [data-figure="${kind}"] .legend`).innerText(), new RegExp(`${film} film`), `${kind} lacks the ${film} film`);
  },
};
