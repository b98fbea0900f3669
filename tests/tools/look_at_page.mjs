// Opens a page of `samara export` in Debian's Chromium without a network, works it as a person would, photographs it,
// and prints what it found as one JSON object.
//
//   node look_at_page.mjs TOOLS PAGE TIME PICTURE    TOOLS: the folder in which `npm ci` installed package.json
//
// TIME: seconds at which the poses are read and the picture is taken.

import { createRequire } from 'node:module';
import { join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';

const [tools, page_file, time, picture] = process.argv.slice(2);
const { chromium } = createRequire(join(resolve(tools), 'package.json'))('playwright-core');
const browser = await chromium.launch({
    executablePath: '/usr/bin/chromium',
    args: ['--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'],
});
const page = await browser.newPage({ viewport: { width: 1280, height: 800 } });
page.setDefaultTimeout(240_000);  // a software renderer on a busy machine
const faults = [];
const requests = [];
page.on('console', (message) => {
    const text = message.text();
    // Reading pixels from the software renderer is slow, and Chromium says so.
    if (['error', 'warning'].includes(message.type()) && !/GPU stall|swiftshader/i.test(text)) faults.push(text);
});
page.on('pageerror', (fault) => faults.push(String(fault)));
page.on('request', (request) => {
    if (!/^(data|blob):/.test(request.url()) && request.url() !== page.url()) requests.push(request.url());
});
await page.goto(pathToFileURL(resolve(page_file)).href);

/** How many colours a canvas shows, and the share of its pixels that are not the commonest one. */
const colours = (selector) => page.evaluate((which) => {
    const source = document.querySelector(which);
    const copy = document.createElement('canvas');
    [copy.width, copy.height] = [source.width, source.height];
    const pen = copy.getContext('2d');
    pen.drawImage(source, 0, 0);
    const words = new Uint32Array(pen.getImageData(0, 0, copy.width, copy.height).data.buffer);
    const counts = new Map();
    for (const word of words) counts.set(word, (counts.get(word) ?? 0) + 1);
    return { count: counts.size, other_share: 1 - Math.max(...counts.values()) / words.length };
}, selector);
/** Waits until everything asked for so far is drawn. */
const settle = async () => {
    const ticks = await page.evaluate('window.samara.ticks()');
    await page.waitForFunction(`window.samara.ticks() > ${ticks + 1}`);
};
const samara = (expression) => page.evaluate(`(() => { const s = window.samara; return ${expression}; })()`);

const found = { plays: await samara('s.playing()') };
found.follows = await page.isChecked('#follow');
if (found.plays) await page.waitForFunction('window.samara.time() > 0');
if (found.plays) await page.keyboard.press('Space');
found.paused = !(await samara('s.playing()'));
await page.keyboard.press('Home');
await settle();
await page.keyboard.press('ArrowRight');
await settle();
found.after_an_arrow = await samara('s.time()');

await page.locator('#scrub').evaluate((scrub, to) => {
    scrub.value = to;
    scrub.dispatchEvent(new Event('input'));
}, time);
await settle();
found.time = await samara('s.time()');
found.poses = await samara('s.motion.bodies.map((b, i) => Array.from({ length: b.copies }, (_, c) => s.drawnPose(i, c)))');
found.arrows = await samara(`s.stage.forces.arrows.map((arrow) => {
    if (!arrow.visible) return null;
    const up = s.stage.camera.up.clone().set(0, 1, 0).applyQuaternion(arrow.quaternion);
    return { direction: up.toArray(), length: arrow.line.scale.y + arrow.cone.scale.y, place: arrow.position.toArray() };
})`);
found.series = await samara('s.series().map((values) => Array.from(values))');
found.stage = await colours('#stage');
/** The shares of the stage's pixels in which one of red, green and blue is more than half above both others, without the trail. */
found.hues = await page.evaluate(() => {
    const { stage } = window.samara;
    stage.showTrail(false);
    stage.draw();
    const source = document.getElementById('stage');
    const copy = document.createElement('canvas');
    [copy.width, copy.height] = [source.width, source.height];
    const pen = copy.getContext('2d');
    pen.drawImage(source, 0, 0);
    const { data } = pen.getImageData(0, 0, copy.width, copy.height);
    const counts = [0, 0, 0];
    for (let i = 0; i < data.length; i += 4) {
        for (let k = 0; k < 3; ++k) {
            if (data[i + k] > 1.5 * Math.max(data[i + (k + 1) % 3], data[i + (k + 2) % 3])) ++counts[k];
        }
    }
    stage.showTrail(true);
    stage.draw();
    return counts.map((count) => (4 * count) / data.length);
});
// The width of each material's image, of each body.
found.images = await samara('s.stage.crowds.map(({ meshes }) => [meshes[0].material].flat().map(({ map }) => map?.image.naturalWidth ?? 0))');
found.plots = [];
for (const i of [1, 2, 3]) found.plots.push(await colours(`#series canvas:nth-child(${i})`));
found.text = await page.evaluate('document.body.innerText');
await page.screenshot({ path: picture });

// What a picture costs, and whether it is drawn again where nothing moves.
await settle();
const drawn = await samara('s.stage.renderer.info.render.frame');
for (let i = 0; i < 3; ++i) await settle();
found.drawn_at_rest = (await samara('s.stage.renderer.info.render.frame')) - drawn;
found.cost = await samara('({ calls: s.stage.renderer.info.render.calls, triangles: s.stage.renderer.info.render.triangles })');
found.enlarged = await samara('s.stage.enlarged');
found.marked = await page.isVisible('#marker');

// The share of the stage's pixels that shadows change.
found.shadow_share = await page.evaluate(async () => {
    const { stage } = window.samara;
    const pixels = (shadows) => {
        stage.light.key.castShadow = shadows;
        stage.draw();
        const copy = document.createElement('canvas');
        const source = document.getElementById('stage');
        [copy.width, copy.height] = [source.width, source.height];
        const pen = copy.getContext('2d');
        pen.drawImage(source, 0, 0);
        return new Uint32Array(pen.getImageData(0, 0, copy.width, copy.height).data.buffer);
    };
    const without = pixels(false);
    const having = pixels(true);
    return having.filter((word, i) => word !== without[i]).length / having.length;
});

// A click on the first body picks it, wherever it is drawn.
const last = found.poses.length - 1;
await samara(`s.choose(${last}, 0)`);
found.chosen = await samara('({ ...s.chosen })');
const place = await samara(`(() => { const v = s.stage.camera.position.clone().fromArray(s.drawnPose(0, 0).position)
    .project(s.stage.camera); const c = document.getElementById('stage').getBoundingClientRect();
    return [c.left + (v.x + 1) / 2 * c.width, c.top + (1 - v.y) / 2 * c.height]; })()`);
await page.mouse.click(...place);
await settle();
found.picked = await samara('({ ...s.chosen })');
await page.keyboard.press('f');
await settle();
found.followed = await samara('s.stage.controls.target.distanceTo(s.stage.place)');

// Windows of many sizes, with and without the help: which panels overlap, or leave the page.
found.overlaps = [];
for (const [width, height] of [[320, 480], [400, 700], [700, 400], [800, 600], [1280, 720], [1920, 1080]]) {
    await page.setViewportSize({ width, height });
    for (const help of [false, true]) {
        if ((await page.isVisible('#help')) !== help) await page.click('#help-switch');
        await settle();
        const faulty = await page.evaluate(() => {
            const boxes = ['#caption', '#scale', '#help', '#controls', '#series', ...document.querySelectorAll('#controls > *')]
                .map((panel) => (typeof panel === 'string' ? document.querySelector(panel) : panel))
                .filter((panel) => panel.offsetParent !== null)
                .map((panel) => ({ name: panel.id || panel.textContent, inner: panel.parentElement.id, box: panel.getBoundingClientRect() }));
            const faults = boxes.filter(({ box }) => box.left < 0 || box.right > document.documentElement.clientWidth).map(({ name }) => name);
            if (document.getElementById('stage').clientHeight < 150) faults.push('stage');
            boxes.forEach((a, i) => boxes.slice(0, i).forEach((b) => {
                if (a.inner === b.name || b.inner === a.name) return;  // one contains the other
                const wide = Math.min(a.box.right, b.box.right) - Math.max(a.box.left, b.box.left);
                const high = Math.min(a.box.bottom, b.box.bottom) - Math.max(a.box.top, b.box.top);
                if (wide > 0.5 && high > 0.5) faults.push(`${b.name}, ${a.name}`);
            }));
            return faults;
        });
        found.overlaps.push(...faulty.map((names) => `${width} x ${height}: ${names}`));
    }
    await page.screenshot({ path: picture.replace(/[.]png$/, `-${width}x${height}.png`) });
}
await page.setViewportSize({ width: 1280, height: 800 });
await page.keyboard.press('h');
found.help_by_key = !await page.isVisible('#help');

// A narrow window, then a reader who wants the dark, a fine screen and nothing that moves by itself.
await page.setViewportSize({ width: 600, height: 700 });
await settle();
found.narrow = await page.evaluate(`(() => { const c = document.getElementById('stage');
    return { canvas: c.width, box: c.clientWidth, page: document.documentElement.scrollWidth }; })()`);
const other = await browser.newPage({
    viewport: { width: 640, height: 480 }, deviceScaleFactor: 2, colorScheme: 'dark', reducedMotion: 'reduce', hasTouch: true,
});
other.setDefaultTimeout(240_000);
other.on('pageerror', (fault) => faults.push(String(fault)));
await other.goto(pathToFileURL(resolve(page_file)).href);
await other.waitForFunction('window.samara.ticks() > 1');
found.dark = await other.evaluate(`(() => { const c = document.getElementById('stage'); return {
    plays: window.samara.playing(), paper: getComputedStyle(document.body).backgroundColor, fine: c.width / c.clientWidth }; })()`);
await other.touchscreen.tap(...await other.evaluate(`(() => { const b = document.getElementById('play').getBoundingClientRect();
    return [b.left + b.width / 2, b.top + b.height / 2]; })()`));
found.dark.plays_after_a_tap = await other.evaluate('window.samara.playing()');

await browser.close();
console.log(JSON.stringify({ ...found, faults, requests }));
