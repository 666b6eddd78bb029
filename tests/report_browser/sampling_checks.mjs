// What the page of `hersey study` must do in a real browser.
import assert from "node:assert/strict";

const kinds = ["histogram", "indices", "tornado", "response", "parallel", "scatter-matrix"];

export const samplingReport = {
  "every figure of a drawn study is there": async (page) => {
    for (const kind of kinds) assert.equal(await page.locator(`[data-figure="${kind}"] svg`).count(), 1, kind);
  },

  "figures have their colours": async (page) => {
    const style = (selector, property) => page.locator(selector).first().evaluate((e, p) => getComputedStyle(e)[p], property);
    assert.notEqual(await style('[data-figure="histogram"] .bar', "fill"), "rgb(0, 0, 0)");
    assert.equal(await style('[data-figure="parallel"] .trace', "fill"), "none");
    assert.equal(await style('[data-figure="scatter-matrix"] .pane', "fill"), "none");
  },

  "a click on a dot shows its run": async (page) => {
    const dot = page.locator('[data-figure="response"] .dot[data-run="5"]');
    await dot.dispatchEvent("click");
    assert.match(await page.locator(".detail h2").innerText(), /^Run 6 of /);
    assert.ok(await dot.evaluate((e) => e.classList.contains("chosen")), "the dot is not marked");
    assert.ok(await page.locator('[data-figure="parallel"] .trace[data-run="5"].chosen').count(), "its line is not marked");
  },

  "another figure is chosen above its picture": async (page) => {
    const caption = page.locator('[data-figure="histogram"] .caption');
    const before = await caption.innerText();
    await page.locator('[data-figure="histogram"] .controls label').nth(1).click();
    assert.notEqual(await caption.innerText(), before);
  },

  "every run stands in the table": async (page) => {
    const runs = Number(/of (\d+)/.exec(await page.locator(".detail h2").innerText())[1]);
    assert.equal(await page.locator("details table tbody tr").count(), runs);
  },
};
