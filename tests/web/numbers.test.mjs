// The library filters the built-in sky: WebAssembly's numbers beside the machine's.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import test from 'node:test';
import { nativePrograms, webBuild } from './places.mjs';

async function webNumbers() {
  const program = `${webBuild}/bin/ibl_numbers`;
  const lines = [];
  const start = createRequire(import.meta.url)(`${program}.js`);
  await start({ wasmBinary: readFileSync(`${program}.wasm`), print: (line) => lines.push(line), printErr: (line) => console.log(`wasm: ${line}`) });
  return lines.map(Number);
}

test('the built-in sky is filtered to the same coefficients and levels', async () => {
  const native = execFileSync(`${nativePrograms}/ibl_numbers`, { encoding: 'utf8', maxBuffer: 1 << 26 }).trim().split('\n').map(Number);
  const web = await webNumbers();
  assert.equal(web.length, native.length);
  assert.ok(native.length > 10000);
  let largest = 0;
  native.forEach((value, i) => { largest = Math.max(largest, Math.abs(web[i] - value) / Math.max(1, Math.abs(value))); });
  console.log(`largest difference ${largest}`);
  assert.ok(largest < 1e-5, `they differ by ${largest}`);  // other vector lengths, sums of float in another order
});
