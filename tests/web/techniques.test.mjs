// Every technique in the page beside the native renderer's picture of the same state.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdirSync, readFileSync, rmSync } from 'node:fs';
import test, { after, before } from 'node:test';
import { launch, openPage, serve, waitForLight } from './browser.mjs';
import { nativePrograms, pictures } from './places.mjs';

const size = 64, maps = 64, scene = 'spheres';
const native = `${pictures}/native`;

let server;
before(async () => {
  rmSync(native, { recursive: true, force: true });
  mkdirSync(native, { recursive: true });
  execFileSync(`${nativePrograms}/native_pictures`, [scene, size, maps, native]);
  server = await serve();
});
after(() => server.close());

function difference(page, machine) {
  let sum = 0, largest = 0, different = 0;
  machine.forEach((value, i) => {
    const d = Math.abs(value - page[i]);
    sum += d;
    largest = Math.max(largest, d);
    if (d > 0) ++different;
  });
  return { mean: sum / machine.length, largest, different: different / machine.length };
}

// One frame from a fresh start of the technique, as native_pictures draws it.
const drawTechnique = (page, name) => page.evaluate(({ name, size }) => {
  const { library } = globalThis.welkin;
  library.run('set_text', 'technique', name);
  library.run('frame', 0);
  return [...library.bytes(library.call('screenshot'), size * size * 3)];
}, { name, size });

// The same driver: identical where this was written; the compilers' last bits might show when rounded to bytes. Another driver: filters of textures
// and functions differ by more; 1/255 on average is what the eye does not see.
// The mirror takes its mip level from derivatives of the mirrored view, which SwiftShader makes of other pixels of a 2 x 2 block: 1.39 seen, in a
// picture of 64 x 64 where such footprints are large.
const limit = (angle, name, mean) => (angle === 'swiftshader' && name === 'mirror' ? 1.8 : mean);

for (const { angle, mean } of [{ angle: 'gles-egl', mean: 0.02 }, { angle: 'swiftshader', mean: 1 }]) {
  test(`each technique draws what the native renderer draws (${angle})`, async () => {
    const browser = await launch(angle);
    try {
      const page = await openPage(browser, `${server.url}?size=${size}&maps=${maps}&scene=${scene}&frames=manual`);
      await waitForLight(page, 'the built-in sky');
      const names = await page.$$eval('#technique option', (options) => options.map((o) => o.value));
      assert.ok(names.length >= 3);
      const wrong = [];
      for (const name of names) {
        const drawn = await drawTechnique(page, name);
        const d = difference(drawn, readFileSync(`${native}/${name}.rgb`));
        console.log(`${angle} ${name}: mean ${d.mean.toFixed(4)}, largest ${d.largest}, different ${(100 * d.different).toFixed(2)} %`);
        if (!(d.mean <= limit(angle, name, mean))) wrong.push(`${name}: ${d.mean}`);
      }
      assert.deepEqual(wrong, []);
      assert.deepEqual(page.failures, []);
    } finally {
      await browser.close();
    }
  });
}
