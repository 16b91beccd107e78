// Filters environments beside the page, so that it stays alive: one job a worker, which ends with it.
import { loadLibrary } from './library.js';
import parseExr from './vendor/parse-exr.js';

const floatType = 1015;  // as parse-exr numbers it

// The decoder gives four channels, bottom row first.
function decodeExr(bytes) {
  const { width, height, data } = parseExr(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength), floatType);
  const channels = data.length / (width * height);
  const rgb = new Float32Array(width * height * 3);
  for (let y = 0; y < height; ++y)
    for (let x = 0; x < width; ++x)
      for (let c = 0; c < 3; ++c)
        rgb[(y * width + x) * 3 + c] = data[((height - 1 - y) * width + x) * channels + (channels < 3 ? 0 : c)];
  return { width, height, rgb };
}

const isExr = (bytes) => bytes[0] === 0x76 && bytes[1] === 0x2f && bytes[2] === 0x31 && bytes[3] === 0x01;

function filter(library, { sky, bytes, name, size }) {
  if (sky) return library.run('filter_sky', sky, size);
  if (!isExr(bytes)) return library.run('filter_file', bytes, bytes.length, name, size);
  let picture;
  try {
    picture = decodeExr(bytes);
  } catch (error) {
    throw new Error(`${name}: cannot read as OpenEXR: ${error.message ?? error}`);
  }
  return library.run('filter_pixels', picture.rgb, picture.width, picture.height, name, size);
}

self.onmessage = async ({ data }) => {
  try {
    const library = await loadLibrary({ onProgress: (share) => self.postMessage({ share }) });
    const begin = performance.now();
    filter(library, data);
    const packed = library.bytes(library.call('packed'), library.call('packed_size'));
    self.postMessage({ packed, seconds: (performance.now() - begin) / 1000 }, [packed.buffer]);
  } catch (error) {
    self.postMessage({ error: error.message ?? String(error) });
  }
};
