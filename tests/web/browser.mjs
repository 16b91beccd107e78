// A static file server and Chromium, for tests.
import { createReadStream, existsSync, statSync } from 'node:fs';
import { createServer } from 'node:http';
import { createRequire } from 'node:module';
import { extname, join, normalize } from 'node:path';
import { root, site } from './places.mjs';

const { chromium } = createRequire(`${root}web/package.json`)('playwright-core');

const types = { '.html': 'text/html', '.css': 'text/css', '.js': 'text/javascript', '.wasm': 'application/wasm', '.txt': 'text/plain' };

// The software rasteriser shares two cores with whatever else runs.
const patience = 300000;

export async function serve() {
  const asked = [];
  const server = createServer((request, response) => {
    const path = new URL(request.url, 'http://host').pathname;
    asked.push({ method: request.method, path });
    const file = join(site, normalize(path === '/' ? '/index.html' : path));
    if (!file.startsWith(site) || !existsSync(file) || !statSync(file).isFile()) return response.writeHead(404).end();
    response.writeHead(200, { 'content-type': types[extname(file)] ?? 'application/octet-stream' });
    createReadStream(file).pipe(response);
  });
  await new Promise((resolve) => server.listen(0, '127.0.0.1', resolve));
  return { url: `http://127.0.0.1:${server.address().port}/`, asked, close: () => server.close() };
}

// angle: 'gles-egl' draws by the driver of the machine, as the native renderer does; 'swiftshader' by Chromium's own.
export function launch(angle = 'gles-egl', more = []) {
  return chromium.launch({
    executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
    headless: true,
    timeout: patience,
    args: ['--no-sandbox', '--disable-quic', '--no-first-run', '--disable-background-networking', '--disable-component-update',
      '--disable-sync', '--use-gl=angle', `--use-angle=${angle}`, '--ignore-gpu-blocklist', '--enable-unsafe-swiftshader', ...more],
  });
}

// Opens the page and waits until it shows the built-in sky. What the page reports as an error fails the test.
export async function openPage(browser, url, options = {}) {
  const page = await browser.newPage(options);
  page.setDefaultTimeout(patience);
  page.failures = [];
  page.on('pageerror', (error) => page.failures.push(String(error)));
  page.on('console', (message) => { if (message.type() === 'error') page.failures.push(message.text()); });
  await page.goto(url);
  await page.waitForFunction(() => document.documentElement.dataset.state !== undefined);
  return page;
}

export async function waitForLight(page, label) {
  await page.waitForFunction((wanted) => {
    const { light, error } = document.documentElement.dataset;
    return error !== undefined || light === 'failed' || light === wanted;
  }, label);
  const { light, error } = await page.evaluate(() => ({ ...document.documentElement.dataset }));
  if (light !== label) throw new Error(`${label} was not loaded: ${error}`);
}
