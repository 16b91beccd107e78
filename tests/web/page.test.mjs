// The page in Chromium, drawn by the machine's own OpenGL ES driver through ANGLE.
import assert from 'node:assert/strict';
import { mkdirSync } from 'node:fs';
import test, { after, before } from 'node:test';
import { launch, openPage, serve, waitForLight } from './browser.mjs';
import { makeExr, makeGlb, makeHdr } from './files.mjs';
import { pictures } from './places.mjs';

const builtIn = 'the built-in sky';
let server, browser;
before(async () => {
  mkdirSync(pictures, { recursive: true });
  server = await serve();
  browser = await launch();
});
after(async () => {
  await browser?.close();
  server?.close();
});

async function withPage(query, options, use) {
  const page = await openPage(browser, server.url + query, options);
  try {
    await use(page);
    assert.deepEqual(page.failures, []);
  } finally {
    await page.close();
  }
}

// What the viewer shows: its size and bytes, and their mean.
const look = (page) => page.evaluate(() => {
  const { library, context } = globalThis.welkin;
  const { width, height } = context.canvas;
  const bytes = library.bytes(library.call('screenshot'), width * height * 3);
  return { width, height, mean: bytes.reduce((sum, value) => sum + value, 0) / bytes.length, bytes: [...bytes] };
});
const pixel = ({ width, bytes }, x, y) => bytes.slice((y * width + x) * 3, (y * width + x) * 3 + 3);

// As if files were dropped: a DataTransfer made in the page.
async function drop(page, name, bytes) {
  await page.evaluate(({ name, base64 }) => {
    const data = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
    const dataTransfer = new DataTransfer();
    dataTransfer.items.add(new File([data], name));
    for (const type of ['dragenter', 'dragover', 'drop'])
      document.body.dispatchEvent(new DragEvent(type, { bubbles: true, cancelable: true, dataTransfer }));
  }, { name, base64: bytes.toString('base64') });
}

test('the page loads, shows the built-in sky, and sends nothing', async () => {
  await withPage('?size=128&maps=64', {}, async (page) => {
    await waitForLight(page, builtIn);
    const shown = await look(page);
    assert.equal(shown.width, 128);
    assert.ok(shown.mean > 20 && shown.mean < 235, `mean ${shown.mean}`);
    assert.ok(server.asked.every(({ method }) => method === 'GET'));
  });
});

test('a dropped .hdr lights the scene', async () => {
  await withPage('?size=64&maps=64', {}, async (page) => {
    await waitForLight(page, builtIn);
    await drop(page, 'red.hdr', makeHdr(64, 32, () => [2, 0.25, 0.25]));
    await waitForLight(page, 'red.hdr');
    const { bytes } = await look(page);
    const [r, g] = pixel({ width: 64, bytes }, 1, 1);  // the background
    assert.ok(r > g + 40, `${r} ${g}`);
  });
});

test('a dropped .exr is decoded row by row from the top', async () => {
  await withPage('?size=64&maps=64&scene=plane', {}, async (page) => {
    await waitForLight(page, builtIn);
    // Blue above the horizon, red below.
    await drop(page, 'halves.exr', makeExr(64, 32, (x, y) => (y < 16 ? [0.1, 0.1, 2] : [2, 0.1, 0.1])));
    await waitForLight(page, 'halves.exr');
    await page.waitForTimeout(500);
    const [r, , b] = pixel(await look(page), 2, 1);  // above the horizon
    assert.ok(b > r + 40, `the sky is upside down: red ${r}, blue ${b}`);
  });
});

test('a damaged file gives one line that names it, and the page goes on', async () => {
  await withPage('?size=64&maps=64', {}, async (page) => {
    await waitForLight(page, builtIn);
    await drop(page, 'broken.hdr', Buffer.from('#?RADIANCE\nnothing'));
    await page.waitForFunction(() => document.documentElement.dataset.error !== undefined);
    assert.match(await page.textContent('#status'), /^Error: broken\.hdr: /);
    assert.ok((await look(page)).mean > 20);
  });
});

test('a dropped .glb is shown with its texture, decoded by the browser', async () => {
  await withPage('?size=64&maps=64', {}, async (page) => {
    await waitForLight(page, builtIn);
    const png = await page.evaluate(async () => {
      const canvas = new OffscreenCanvas(4, 4);
      const context = canvas.getContext('2d');
      context.fillStyle = '#00ff00';
      context.fillRect(0, 0, 4, 4);
      const bytes = new Uint8Array(await (await canvas.convertToBlob({ type: 'image/png' })).arrayBuffer());
      return btoa(String.fromCharCode(...bytes));
    });
    await drop(page, 'square.glb', makeGlb(Buffer.from(png, 'base64')));
    await page.waitForFunction(() => document.documentElement.dataset.scene === 'square.glb' || document.documentElement.dataset.error);
    assert.equal(await page.getAttribute('html', 'data-error'), null);
    await page.waitForTimeout(500);
    const [r, g, b] = pixel(await look(page), 32, 32);
    assert.ok(g > r + 30 && g > b + 30, `${r} ${g} ${b}`);
  });
});

test('a lost context comes back with the same picture, and leaves no object behind', async () => {
  await withPage('?size=64&maps=64', {}, async (page) => {
    await waitForLight(page, builtIn);
    await page.waitForTimeout(300);
    const before = await look(page);
    const objects = await page.evaluate(() => globalThis.welkin.library.call('living_objects'));
    assert.ok(objects > 10);
    await page.evaluate(() => {
      globalThis.loser = globalThis.welkin.context.getExtension('WEBGL_lose_context');
      globalThis.loser.loseContext();
    });
    await page.waitForFunction(() => document.documentElement.dataset.state === 'lost');
    assert.equal(await page.evaluate(() => globalThis.welkin.library.call('living_objects')), 0);
    await page.evaluate(() => globalThis.loser.restoreContext());
    await page.waitForFunction(() => document.documentElement.dataset.state === 'ready');
    await page.waitForTimeout(500);
    const later = await look(page);
    assert.deepEqual(later.bytes, before.bytes);
    assert.equal(await page.evaluate(() => globalThis.welkin.library.call('living_objects')), objects);
  });
});

for (const [what, script, expected] of [
  ['WebGL 2', 'HTMLCanvasElement.prototype.getContext = () => null', /WebGL 2/],
  ['float render targets', `const real = WebGL2RenderingContext.prototype.getExtension;
    WebGL2RenderingContext.prototype.getExtension = function (name) { return name === 'EXT_color_buffer_float' ? null : real.call(this, name); }`, /EXT_color_buffer_float/],
]) {
  test(`without ${what} the page says so`, async () => {
    const page = await browser.newPage();
    await page.addInitScript(script);
    await page.goto(server.url);
    await page.waitForSelector('#message:not([hidden])');
    assert.match(await page.textContent('#message'), expected);
    await page.close();
  });
}

test('every control has a name for those who do not see it', async () => {
  await withPage('?size=64&maps=64', {}, async (page) => {
    await waitForLight(page, builtIn);
    const techniques = await page.$$eval('#technique option', (options) => options.map((o) => o.value));
    assert.ok(techniques.length >= 3);
    const session = await page.context().newCDPSession(page);
    const roles = ['button', 'checkbox', 'combobox', 'slider', 'spinbutton', 'application', 'progressbar', 'DisclosureTriangle'];
    let seen = 0;
    for (const technique of techniques) {
      await page.selectOption('#technique', technique);
      const { nodes } = await session.send('Accessibility.getFullAXTree');
      for (const node of nodes.filter((n) => !n.ignored && roles.includes(n.role?.value))) {
        ++seen;
        assert.ok(node.name?.value?.trim(), `a ${node.role.value} of ${technique} has no name`);
      }
    }
    assert.ok(seen > 10 * techniques.length);
  });
});

test('keys turn the scene; a pinch comes closer', async () => {
  await withPage('?size=64&maps=64', { hasTouch: true }, async (page) => {
    await waitForLight(page, builtIn);
    await page.waitForTimeout(300);
    const first = (await look(page)).bytes;
    await page.focus('#picture');
    await page.keyboard.press('ArrowLeft');
    await page.waitForTimeout(300);
    const turned = (await look(page)).bytes;
    assert.notDeepEqual(turned, first);
    const session = await page.context().newCDPSession(page);
    const touch = (type, points) => session.send('Input.dispatchTouchEvent', { type, touchPoints: points.map(([x, y], id) => ({ x, y, id })) });
    await touch('touchStart', [[200, 200], [260, 200]]);
    await touch('touchMove', [[170, 200], [290, 200]]);
    await touch('touchEnd', []);
    await page.waitForTimeout(300);
    assert.notDeepEqual((await look(page)).bytes, turned);
  });
});

test('two techniques are compared, with numbers', async () => {
  await withPage('?size=64&maps=64', {}, async (page) => {
    await waitForLight(page, builtIn);
    await page.selectOption('#comparison', 'split');
    await page.waitForFunction(() => /RMS/.test(document.getElementById('numbers').textContent));
    await page.selectOption('#comparison', 'difference');
    await page.click('#times summary');
    await page.evaluate(() => globalThis.welkin.library.run('orbit', 0.01, 0));
    await page.waitForFunction(() => document.querySelectorAll('#passes tr').length > 0);
  });
});

test('a phone shows the picture and its controls without scrolling sideways', async () => {
  const phone = { viewport: { width: 390, height: 844 }, deviceScaleFactor: 2, isMobile: true, hasTouch: true };
  await withPage('?maps=64', phone, async (page) => {
    await waitForLight(page, builtIn);
    await page.waitForTimeout(1500);
    const sizes = await page.evaluate(() => ({
      wide: document.documentElement.scrollWidth, canvas: document.getElementById('picture').getBoundingClientRect().toJSON(),
      technique: document.getElementById('technique').getBoundingClientRect().toJSON(),
    }));
    assert.ok(sizes.wide <= 390, `scrolls to ${sizes.wide}`);
    assert.ok(sizes.canvas.width > 380 && sizes.canvas.height > 350);
    assert.ok(sizes.technique.height >= 40, 'large enough for a finger');
    await page.screenshot({ path: `${pictures}/phone.png` });
  });
  await withPage('?maps=64', { viewport: { width: 1280, height: 720 } }, async (page) => {
    await waitForLight(page, builtIn);
    await page.waitForTimeout(1500);
    await page.screenshot({ path: `${pictures}/desktop.png` });
  });
});
