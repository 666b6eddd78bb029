// node browser_test.mjs MODULES SITE   opens every page of the site in headless Chromium, at 1366 x 768 and 390 x 844: no error on the
// console, nothing asked of the network, nothing wider than the window. One page of each kind is audited too, light and dark: no
// finding of axe-core that is serious or critical (contrast among them).
// Needs a Chromium (CHROMIUM=/path/to/it, default /usr/bin/chromium) and `make docs`.
import { createRequire } from 'node:module';
import { readFileSync, readdirSync } from 'node:fs';
import { join, relative, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';

const [modules, site] = process.argv.slice(2).map((path) => resolve(path));
const require = createRequire(join(modules, 'package.json'));
const { chromium } = require('playwright-core');
const axe = readFileSync(require.resolve('axe-core/axe.min.js'), 'utf8');
const audited = ['index.html', 'comparison.html', 'tutorial/first-bearing.html', 'examples.html', 'examples/engine/index.html', 'model/lubricants.html',
  'conventions.html', 'theory/beams.html', 'validation.html'];
const sizes = [{ width: 1366, height: 768 }, { width: 390, height: 844 }];

const pagesBelow = (folder) =>
  readdirSync(folder, { withFileTypes: true }).flatMap((entry) =>
    entry.isDirectory() ? pagesBelow(join(folder, entry.name)) : entry.name.endsWith('.html') && entry.name !== '404.html' ? [join(folder, entry.name)] : []);

// What one page does wrong in one theme and size.
async function faultsOf(context, path, audit) {
  const page = await context.newPage();
  const faults = [];
  page.on('console', (message) => message.type() === 'error' && faults.push(`console: ${message.text()}`));
  page.on('pageerror', (error) => faults.push(`error: ${error.message}`));
  page.on('request', (request) => /^https?:/.test(request.url()) && faults.push(`asks the network for ${request.url()}`));
  await page.goto(pathToFileURL(path).href);
  await page.evaluate(() => document.fonts.ready);
  const wide = await page.evaluate(() => document.documentElement.scrollWidth - window.innerWidth);
  if (wide > 1) faults.push(`is ${wide} px wider than the window`);
  if (audit) {
    await page.evaluate(axe);
    const found = await page.evaluate(() => window.axe.run(document, { resultTypes: ['violations'], preload: false }));
    for (const violation of found.violations.filter((v) => ['serious', 'critical'].includes(v.impact))) {
      const [first] = violation.nodes;
      faults.push(`${violation.id} (${violation.nodes.length}): ${first.html.slice(0, 120)} ${first.failureSummary.split('\n')[1] ?? ''}`);
    }
  }
  await page.close();
  return faults;
}

// From a folder, too, a word leads to the page that tells about it.
async function searchFaults(browser) {
  const page = await browser.newPage();
  await page.goto(pathToFileURL(join(site, 'index.html')).href);
  await page.locator('[data-md-component=search-query]').click();
  await page.keyboard.type('radial_clearance');
  await page.waitForSelector('.md-search-result__link', { timeout: 5000 }).catch(() => {});
  const found = await page.locator('.md-search-result__link:visible').evaluateAll((links) => links.map((link) => link.href));
  await page.close();
  return found.some((link) => link.includes('model/bearings.html')) ? [] : [`the search for radial_clearance finds ${found.length} pages, not the key`];
}

const browser = await chromium.launch({ executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium', args: ['--no-sandbox', '--disable-quic', '--disable-background-networking'] });
let failed = 0;
const pages = pagesBelow(site);
for (const viewport of sizes) {
  for (const colorScheme of ['light', 'dark']) {
    const context = await browser.newContext({ viewport, colorScheme });
    for (const path of pages) {
      const audit = audited.includes(relative(site, path));
      if (!audit && colorScheme === 'dark') continue;
      for (const fault of await faultsOf(context, path, audit)) {
        failed++;
        console.log(`${relative(site, path)} ${viewport.width} ${colorScheme}: ${fault}`);
      }
    }
    await context.close();
  }
}
for (const fault of await searchFaults(browser)) {
  failed++;
  console.log(fault);
}
await browser.close();
console.log(`${pages.length} pages in two sizes, ${audited.length} of them audited in both themes, ${failed} faults`);
process.exit(failed ? 1 : 0);
