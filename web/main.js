import { enableExtensions, makeContext } from './context.js';
import { fillSelect, makeParameters, showValue, valueOf } from './controls.js';
import { filterEnvironment, Superseded } from './filtering.js';
import { listenToGestures } from './gestures.js';
import { decodePictures } from './gltf-pictures.js';
import { loadLibrary } from './library.js';

const parameters = new URLSearchParams(location.search);
const $ = (id) => document.getElementById(id);
const canvas = $('picture');
const isPhone = matchMedia('(max-width: 760px)').matches;
// Along an edge of the filtered maps; a phone's screen shows no more.
const mapSize = Number(parameters.get('maps')) || (isPhone ? 128 : 256);

let library;
let gl;
let lost = false;
let lastTime = 0;
let reportDue = 0;
let reportWanted = false;
let forced = true;  // what is shown has changed though the picture has not

const say = (text) => { $('status').textContent = text; };

function complain(error) {
  say(`Error: ${error.message ?? error}`);
  document.documentElement.dataset.error = error.message ?? String(error);
}

function stop(message) {
  $('message').textContent = message;
  $('message').hidden = false;
  say('Stopped');
  document.documentElement.dataset.state = 'failed';
}

// Runs a call of the library whose error is the user's to see.
function attempt(...call) {
  if (lost) return false;
  try {
    library.run(...call);
    forced = true;
    return true;
  } catch (error) {
    complain(error);
    return false;
  }
}

// ---- Light

async function light(job, label) {
  $('progress').hidden = false;
  $('progress').value = 0;
  say(`Filtering ${label}`);
  document.documentElement.dataset.light = 'filtering';
  try {
    const { packed, seconds } = await filterEnvironment({ ...job, size: mapSize }, (share) => { $('progress').value = share; });
    if (!attempt('set_light', packed, packed.length)) return;
    $('environment-name').textContent = `${label}, filtered in ${seconds.toFixed(2)} s`;
    say(`Lit by ${label}`);
    document.documentElement.dataset.light = label;
    document.documentElement.dataset.seconds = seconds.toFixed(3);
  } catch (error) {
    if (error instanceof Superseded) return;
    complain(error);
    document.documentElement.dataset.light = 'failed';
  }
  $('progress').hidden = true;
}

// ---- Files

const sceneEndings = /\.(glb|gltf)$/i;

async function open(file) {
  const bytes = new Uint8Array(await file.arrayBuffer());
  if (!sceneEndings.test(file.name)) return light({ bytes, name: file.name }, file.name);
  say(`Reading ${file.name}`);
  for (const { index, width, height, rgba } of await decodePictures(bytes))
    attempt('add_picture', index, rgba, width, height);
  if (!attempt('load_scene', bytes, bytes.length, file.name)) return;
  $('scene').value = '';
  say(`Showing ${file.name}`);
  document.documentElement.dataset.scene = file.name;
}

async function openAll(files) {
  for (const file of files) {
    try {
      await open(file);
    } catch (error) {
      complain(error);
    }
  }
}

function listenToFiles() {
  for (const id of ['environment-file', 'scene-file']) {
    $(id).addEventListener('change', async (event) => {
      await openAll([...event.target.files]);
      event.target.value = '';
    });
  }
  let depth = 0;
  const hint = (shown) => { $('drop-hint').hidden = !shown; };
  addEventListener('dragenter', (event) => { event.preventDefault(); ++depth; hint(true); });
  addEventListener('dragleave', () => { depth = Math.max(0, depth - 1); hint(depth > 0); });
  addEventListener('dragover', (event) => event.preventDefault());
  addEventListener('drop', (event) => {
    event.preventDefault();
    depth = 0;
    hint(false);
    openAll([...(event.dataTransfer?.files ?? [])]);
  });
}

// ---- Controls

function listenToNumber(id, key = id) {
  const input = $(id);
  showValue(input);
  input.addEventListener('input', () => {
    showValue(input);
    attempt('set_number', key, valueOf(input));
  });
}

function chooseTechnique(tables, key, name) {
  const technique = tables.techniques.find((t) => t.name === name);
  const text = makeParameters($(`${key}-parameters`), technique, (changed) => attempt('set_text', key, changed));
  if (key === 'technique') $('technique-summary').textContent = `${technique.summary} (${technique.source})`;
  return attempt('set_text', key, text);
}

function showBuiltInScene(name) {
  if (!attempt('built_in_scene', name)) return;
  say(`Showing the built-in scene ${name}`);
  document.documentElement.dataset.scene = name;
}

function makeControls(tables) {
  fillSelect($('technique'), tables.techniques.map(({ name, summary }) => ({ name, title: summary })));
  fillSelect($('reference'), tables.techniques.map(({ name, summary }) => ({ name, title: summary })));
  fillSelect($('scene'), tables.scenes.map(({ name, description }) => ({ name, title: description })));
  fillSelect($('comparison'), tables.comparisons.map((name) => ({ name })));
  fillSelect($('curve'), tables.curves.map((name) => ({ name })));
  $('technique').value = parameters.get('technique') ?? 'prefiltered-ggx';
  $('reference').value = 'mirror';
  $('curve').value = 'filmic';
  $('scene').value = parameters.get('scene') ?? 'spheres';
  for (const key of ['technique', 'reference']) {
    $(key).addEventListener('change', () => chooseTechnique(tables, key, $(key).value));
    chooseTechnique(tables, key, $(key).value);
  }
  $('scene').addEventListener('change', () => showBuiltInScene($('scene').value));
  for (const id of ['comparison', 'curve']) $(id).addEventListener('change', () => attempt('set_text', id, $(id).value));
  for (const id of ['rotation', 'exposure', 'automatic-exposure', 'background', 'split', 'animate']) listenToNumber(id);
  $('frame-scene').addEventListener('click', () => attempt('frame_scene'));
  $('built-in-sky').addEventListener('click', () => light({ sky: 'sky:' }, 'the built-in sky'));
  $('times').addEventListener('toggle', () => attempt('set_number', 'timing', $('times').open));
  $('controls').addEventListener('submit', (event) => event.preventDefault());
}

// ---- Frames

function fitCanvas() {
  const fixed = Number(parameters.get('size'));
  const ratio = Math.min(devicePixelRatio || 1, isPhone ? 1.5 : 2);
  const width = fixed || Math.max(1, Math.min(4096, Math.round(canvas.clientWidth * ratio)));
  const height = fixed || Math.max(1, Math.min(4096, Math.round(canvas.clientHeight * ratio)));
  if (canvas.width === width && canvas.height === height) return;
  canvas.width = width;
  canvas.height = height;
  attempt('resize', width, height);
}

function showReport() {
  const { passes = [], numbers } = JSON.parse(library.text('report'));
  $('numbers').textContent = numbers
    ? `Difference: RMS ${numbers.rms} (${(100 * numbers.relativeRms).toPrecision(3)} %), largest ${numbers.largest}`
    : '';
  $('passes').replaceChildren(...passes.map(({ name, milliseconds, depth }) => {
    const row = document.createElement('tr');
    row.insertCell().textContent = '\u2007'.repeat(2 * depth) + name;
    row.insertCell().textContent = milliseconds.toFixed(2);
    return row;
  }));
}

function tick(now) {
  requestAnimationFrame(tick);
  if (lost) return;
  if (reportWanted && now >= reportDue) {
    reportWanted = false;
    reportDue = now + 250;
    showReport();
  }
  fitCanvas();
  if (!forced && library.call('needs_draw') === 0) return;
  const seconds = lastTime ? Math.min((now - lastTime) / 1000, 0.1) : 0;
  lastTime = now;
  forced = $('animate').checked;
  try {
    library.run('frame', seconds);
  } catch (error) {
    complain(error);
  }
  document.documentElement.dataset.frames = String(Number(document.documentElement.dataset.frames ?? 0) + 1);
  reportWanted = true;
}

// ---- The context

function listenToContext() {
  canvas.addEventListener('webglcontextlost', (event) => {
    event.preventDefault();  // or it never comes back
    lost = true;
    library.call('stop');
    say('The graphics device was taken away; waiting for it');
    document.documentElement.dataset.state = 'lost';
  });
  canvas.addEventListener('webglcontextrestored', () => {
    try {
      enableExtensions(gl);
      library.run('start');
      lost = false;
      forced = true;
      say('The graphics device is back');
      document.documentElement.dataset.state = 'ready';
    } catch (error) {
      stop(error.message);
    }
  });
}

async function begin() {
  try {
    gl = makeContext(canvas);
    if (typeof WebAssembly !== 'object') throw new Error('This page needs WebAssembly, which this browser does not have.');
    library = await loadLibrary();
  } catch (error) {
    return stop(error.message);
  }
  const context = library.module.GL.registerContext(gl, { majorVersion: 2, minorVersion: 0, enableExtensionsByDefault: 0 });
  library.module.GL.makeContextCurrent(context);
  try {
    library.run('start');
  } catch (error) {
    return stop(error.message);
  }
  listenToContext();
  makeControls(JSON.parse(library.text('tables')));
  listenToFiles();
  listenToGestures(canvas, {
    orbit: (x, y) => attempt('orbit', x, y),
    pan: (x, y) => attempt('pan', x, y),
    zoom: (factor) => attempt('zoom', factor),
    frame: () => attempt('frame_scene'),
  });
  fitCanvas();
  showBuiltInScene($('scene').value);
  document.documentElement.dataset.state = 'ready';
  if (parameters.get('frames') !== 'manual') requestAnimationFrame(tick);  // tests draw each frame themselves
  await light({ sky: parameters.get('sky') ?? 'sky:' }, 'the built-in sky');
}

globalThis.welkin = { get library() { return library; }, get context() { return gl; } };
begin();
