// The page in a real browser.
//
//   node page.mjs PAGE.html [PAGE.html ...] [--shots FOLDER]
//
// CHROMIUM names the browser (default /usr/bin/chromium). The module playwright-core is found beside this file or under NODE_PATH.
// Each page must open without an error and without asking for anything; the first must also have a finding with a place.

import assert from 'node:assert/strict';
import { mkdirSync, mkdtempSync, rmSync } from 'node:fs';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { basename, join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';

const { chromium } = createRequire(import.meta.url)('playwright-core');

const FLAGS = ['--headless', '--no-sandbox', '--disable-gpu', '--disable-quic', '--no-first-run', '--disable-background-networking',
  '--disable-component-update', '--disable-sync'];

const given = process.argv.slice(2);
const at = given.indexOf('--shots');
const shots = at < 0 ? null : resolve(given.splice(at, 2)[1]);
if (shots) mkdirSync(shots, { recursive: true });
const pages = given.map(file => resolve(file));
assert(pages.length, 'name a page');

const profile = mkdtempSync(join(tmpdir(), 'voromill-browser-'));
const context = await chromium.launchPersistentContext(profile, {
  executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium', args: FLAGS, viewport: { width: 1360, height: 860 }, colorScheme: 'dark',
});

const view = page => page.evaluate(() => ({ ...stage.view }));

// The pixels of what is drawn, not only what is meant to be.
const pixels = page => page.evaluate(() => stage.panes.map(pane => pane.base.canvas.toDataURL() + pane.work.canvas.toDataURL()).join());

// After the next rendering.
async function settled(page, act) {
  const before = await page.evaluate(() => stage.element.dataset.drawn);
  await act();
  await page.waitForFunction(drawn => stage.element.dataset.drawn !== drawn, before);
  await page.waitForTimeout(60);
}

async function open(file, colorScheme = 'dark') {
  const page = await context.newPage();
  const wrong = [], asked = [];
  page.on('console', message => { if (['error', 'warning'].includes(message.type())) wrong.push(message.text()); });
  page.on('pageerror', error => wrong.push(String(error.stack)));
  page.on('request', request => { if (!request.url().startsWith('file:') && !request.url().startsWith('data:')) asked.push(request.url()); });
  await page.emulateMedia({ colorScheme, reducedMotion: 'reduce' });
  const start = Date.now();
  await page.goto(pathToFileURL(file).href);
  await page.waitForFunction(() => document.documentElement.dataset.ready && document.getElementById('stage').dataset.drawn);
  console.log(`${basename(file)}: open after ${Date.now() - start} ms, drawn in ${await page.evaluate(() => stage.cost.toFixed(0))} ms`);
  const shoot = name => (shots ? page.screenshot({ path: join(shots, `${basename(file, '.html')}-${name}.png`) }) : null);
  return { page, wrong, asked, shoot };
}

async function opens(file) {
  for (const scheme of ['dark', 'light']) {
    const { page, wrong, asked, shoot } = await open(file, scheme);
    assert.equal(await page.getAttribute('html', 'data-theme'), scheme, 'as the system says');
    await shoot(scheme);
    assert.deepEqual(wrong, [], 'nothing went wrong');
    assert.deepEqual(asked, [], 'nothing was asked of the network');
    await page.close();
  }
}

async function moves(page) {
  const start = await view(page);
  const box = await page.locator('#stage').boundingBox();
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
  await settled(page, async () => { await page.mouse.move(x, y); await page.mouse.down(); await page.mouse.move(x + 90, y + 40, { steps: 4 }); await page.mouse.up(); });
  const panned = await view(page);
  assert(panned.x < start.x && panned.y > start.y, 'dragging moves the board with the pointer');
  assert.equal(panned.scale, start.scale, 'and does not zoom');
  await settled(page, () => page.mouse.wheel(0, -400));
  const zoomed = await view(page);
  assert(zoomed.scale > start.scale * 1.5, 'the wheel zooms');
  await page.focus('#stage');
  await settled(page, () => page.keyboard.press('ArrowLeft'));
  assert((await view(page)).x < zoomed.x, 'arrows move');
  await settled(page, () => page.keyboard.press('0'));
  const whole = await view(page);
  assert(Math.abs(whole.scale / start.scale - 1) < 1e-9, '0 shows all of it');
}

async function layers(page) {
  for (const id of await page.evaluate(() => LAYERS.map(layer => layer.id))) {
    if (['names', 'findings', 'lost', 'drillPath', 'board'].includes(id)) continue;
    const before = await pixels(page);
    await settled(page, () => page.click(`#layer-${id}`));
    assert(await pixels(page) !== before, `layer ${id} shows`);
    await settled(page, () => page.click(`#layer-${id}`));
    assert(await pixels(page) === before, `and ${id} hides again`);
  }
}

async function plays(page, shoot) {
  const total = await page.evaluate(() => player.total);
  assert(total > 10, 'the programs take a while');
  const done = await pixels(page);
  await settled(page, () => page.evaluate(() => { const bar = document.getElementById('time'); bar.value = player.total * 0.1; bar.dispatchEvent(new Event('input')); }));
  assert.match(await page.textContent('#line'), /\.\w+:\d+$/, 'the line of the program that runs');
  assert(await pixels(page) !== done, 'less is cut');
  await shoot('playing');
  const before = await page.evaluate(() => player.now);
  await page.click('#play');
  await page.waitForTimeout(400);
  await page.click('#play');
  assert(await page.evaluate(() => player.now) > before, 'time goes on while it plays');
  const tool = await page.evaluate(() => player.tool());
  assert(tool && Number.isFinite(tool.x) && Number.isFinite(tool.y), 'the tool is somewhere');
  await settled(page, () => page.evaluate(() => player.seek(player.total)));
  assert(await pixels(page) === done, 'at the end all is cut');
}

async function shows(page, shoot) {
  const start = await view(page);
  await settled(page, () => page.click('#show-first'));
  const found = await page.evaluate(() => ({ item: stage.selected, view: stage.view }));
  assert(found.view.scale > start.scale, 'it goes closer');
  assert(Math.hypot(found.view.x - found.item.at[0], found.view.y - found.item.at[1]) < 1, 'to the place');
  assert.equal(await page.locator('.item[aria-current]').count(), 1, 'and marks its row');
  assert.equal(await page.textContent('#live'), found.item.message, 'and says it aloud');
  await shoot('finding');
  // Over the cut there, the page tells what is cut.
  const box = await page.locator('#stage').boundingBox();
  await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
  await page.waitForTimeout(60);
  const told = await page.textContent('#readout');
  assert.match(told, /program.+:\d+/, `the line under the pointer: ${told}`);
  await page.focus('#stage');
  await page.keyboard.press('n');
  assert.notEqual(await page.evaluate(() => stage.selected.index), found.item.index, 'n goes to the next');
}

async function sides(page, shoot) {
  if (await page.locator('[data-side=both]').count() === 0) return;
  await settled(page, () => page.click('[data-side=both]'));
  assert.equal(await page.locator('.pane').count(), 2, 'two panes');
  const [a, b] = await page.evaluate(() => stage.panes.map(pane => pane.toBoard(100, 100)));
  assert.deepEqual(a, b, 'that show the same place');
  await shoot('both');
}

// The board as it comes from the mill: copper with grooves to the laminate, and nothing beside it.
async function looksMilled(page, shoot) {
  const milled = page.locator('[id^=milled-]').first();
  assert.equal(await milled.locator('canvas').count(), 0, 'nothing is drawn before');
  const start = Date.now();
  await milled.locator('summary').click();
  await milled.locator('canvas').waitFor();
  console.log(`as milled: drawn in ${Date.now() - start} ms`);
  await milled.locator('canvas').scrollIntoViewIfNeeded();
  await shoot('milled');
  const [copper, laminate, beside] = await milled.locator('canvas').evaluate(canvas => {
    const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height), counts = [0, 0, 0];
    for (let i = 0; i < data.length; i += 4) {
      const [red, green, , alpha] = data.slice(i, i + 4);
      counts[alpha === 0 ? 2 : green > 0.85 * red ? 1 : 0] += 1;
    }
    return counts.map(count => count / (data.length / 4));
  });
  assert(copper > 0.2 && laminate > 0.0005 && beside > 0.02, `copper ${copper}, laminate ${laminate}, beside it ${beside}`);
  await milled.locator('summary').click();
}

// The pictures of how cuts are found: drawn when they are unfolded, of this side's nets.
async function explains(page, shoot) {
  const how = page.locator('[id^=how-]').first();
  assert.equal(await how.locator('canvas').count(), 0, 'nothing is drawn before');
  const start = Date.now();
  await how.locator('summary').click();
  await how.locator('canvas').nth(1).waitFor();
  console.log(`how it was found: drawn in ${Date.now() - start} ms`);
  await how.locator('canvas').first().scrollIntoViewIfNeeded();
  await shoot('how');
  // Pixels on copper, from above, have the hue of their net's region, and others lie beside them.
  const colours = await how.locator('canvas').nth(1).evaluate(canvas => {
    const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
    const seen = new Set();
    for (let i = 0; i < data.length; i += 4) seen.add(data[i] << 16 | data[i + 1] << 8 | data[i + 2]);
    return seen.size;
  });
  assert(colours >= 5, `copper, regions and lines between them: ${colours} colours`);
  await how.locator('summary').click();
}

async function reads(page) {
  const unnamed = await page.evaluate(() => [...document.querySelectorAll('button, input, select, [tabindex]')]
    .filter(element => !(element.textContent.trim() || element.ariaLabel || element.labels?.length)).map(element => element.outerHTML));
  assert.deepEqual(unnamed, [], 'everything that can be used has a name');
}

// What lies beside the board is shown with some of the board.
async function keepsSight(page) {
  const seen = await page.evaluate(() => {
    const [, , right, top] = drawing.bounds, pane = stage.panes[0], view = stage.around(right + 40000, top + 20000);
    return Math.max((view.x - right) * view.scale / pane.width, (view.y - top) * view.scale / pane.height);
  });
  assert(seen < 0.5, `the corner of the board is in sight, ${seen} of the window from its middle`);
}

async function prints(page) {
  const folded = () => page.locator('.group:not([open])').count();
  // A person folds what is open at first.
  await page.evaluate(() => { document.querySelector('.group').open = false; });
  const before = await folded();
  assert(before > 0, 'something is folded');
  await page.evaluate(() => dispatchEvent(new Event('beforeprint')));
  assert.equal(await folded(), 0, 'on paper nothing is');
  assert.equal(await page.getAttribute('html', 'data-theme'), 'light', 'and it is light');
  await page.evaluate(() => dispatchEvent(new Event('afterprint')));
  assert.equal(await folded(), before, 'as before');
}

for (const file of pages) await opens(file);
const { page, wrong, shoot } = await open(pages[0]);
await moves(page);
await layers(page);
await plays(page, shoot);
await shows(page, shoot);
await keepsSight(page);
await prints(page);
await looksMilled(page, shoot);
await explains(page, shoot);
await reads(page);
assert.deepEqual(wrong, [], 'nothing went wrong meanwhile');
for (const file of pages.slice(1)) {
  const other = await open(file);
  await sides(other.page, other.shoot);
  await reads(other.page);
  assert.deepEqual(other.wrong, [], 'nothing went wrong meanwhile');
}
await context.close();
rmSync(profile, { recursive: true, force: true });
console.log('the page works');
