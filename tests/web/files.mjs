// Small files that tests drop on the page.

// Radiance RGBE without run lengths: colour(x, y) gives three values.
export function makeHdr(width, height, colour) {
  const header = Buffer.from(`#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y ${height} +X ${width}\n`);
  const pixels = Buffer.alloc(width * height * 4);
  for (let y = 0; y < height; ++y)
    for (let x = 0; x < width; ++x) {
      const rgb = colour(x, y);
      const exponent = Math.ceil(Math.log2(Math.max(...rgb, 1e-30) * (256 / 255)));
      const at = (y * width + x) * 4;
      rgb.forEach((value, c) => { pixels[at + c] = Math.floor(value * 2 ** (8 - exponent)); });
      pixels[at + 3] = exponent + 128;
    }
  return Buffer.concat([header, pixels]);
}

// OpenEXR: one part, scan lines, floats, no compression (OpenEXR File Layout).
export function makeExr(width, height, colour) {
  const text = (value) => Buffer.from(`${value}\0`);
  const int = (...values) => Buffer.from(Int32Array.from(values).buffer);
  const float = (...values) => Buffer.from(Float32Array.from(values).buffer);
  const attribute = (name, type, value) => Buffer.concat([text(name), text(type), int(value.length), value]);
  const channel = (name) => Buffer.concat([text(name), int(2, 0, 1, 1)]);
  const box = int(0, 0, width - 1, height - 1);
  const header = Buffer.concat([
    int(20000630, 2),
    attribute('channels', 'chlist', Buffer.concat([channel('B'), channel('G'), channel('R'), Buffer.from([0])])),
    attribute('compression', 'compression', Buffer.from([0])),
    attribute('dataWindow', 'box2i', box), attribute('displayWindow', 'box2i', box),
    attribute('lineOrder', 'lineOrder', Buffer.from([0])),
    attribute('pixelAspectRatio', 'float', float(1)),
    attribute('screenWindowCenter', 'v2f', float(0, 0)), attribute('screenWindowWidth', 'float', float(1)),
    Buffer.from([0]),
  ]);
  const lineSize = 8 + width * 12;
  const offsets = Buffer.alloc(height * 8);
  const lines = [];
  for (let y = 0; y < height; ++y) {
    offsets.writeBigUInt64LE(BigInt(header.length + offsets.length + y * lineSize), y * 8);
    const row = Array.from({ length: width }, (_, x) => colour(x, y));
    lines.push(int(y, width * 12), ...[2, 1, 0].map((c) => float(...row.map((rgb) => rgb[c]))));
  }
  return Buffer.concat([header, offsets, ...lines]);
}

// A square of two triangles that faces +Z, with a texture (the bytes of a PNG) where one is given.
export function makeGlb(png) {
  const positions = Float32Array.of(-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0);
  const texcoords = Float32Array.of(0, 1, 1, 1, 1, 0, 0, 0);
  const indices = Uint16Array.of(0, 1, 2, 0, 2, 3);
  const parts = [positions, texcoords, indices].map((values) => Buffer.from(values.buffer));
  if (png) parts.push(png);
  let offset = 0;
  const bufferViews = parts.map((part) => {
    const view = { buffer: 0, byteOffset: offset, byteLength: part.length };
    offset += Math.ceil(part.length / 4) * 4;
    return view;
  });
  const binary = Buffer.concat(parts.map((part) => Buffer.concat([part, Buffer.alloc(-part.length & 3)])));
  const document = {
    asset: { version: '2.0' }, scene: 0, scenes: [{ nodes: [0] }], nodes: [{ mesh: 0 }],
    meshes: [{ primitives: [{ attributes: { POSITION: 0, TEXCOORD_0: 1 }, indices: 2, material: 0 }] }],
    materials: [{ pbrMetallicRoughness: { metallicFactor: 0, roughnessFactor: 1, ...(png ? { baseColorTexture: { index: 0 } } : {}) }, doubleSided: true }],
    ...(png ? { textures: [{ source: 0 }], images: [{ bufferView: 3, mimeType: 'image/png' }] } : {}),
    accessors: [
      { bufferView: 0, componentType: 5126, count: 4, type: 'VEC3', min: [-1, -1, 0], max: [1, 1, 0] },
      { bufferView: 1, componentType: 5126, count: 4, type: 'VEC2' },
      { bufferView: 2, componentType: 5123, count: 6, type: 'SCALAR' },
    ],
    bufferViews, buffers: [{ byteLength: binary.length }],
  };
  const json = Buffer.from(JSON.stringify(document));
  const padded = Buffer.concat([json, Buffer.alloc(-json.length & 3, ' ')]);
  const word = (...values) => Buffer.from(Uint32Array.from(values).buffer);
  return Buffer.concat([word(0x46546c67, 2, 28 + padded.length + binary.length), word(padded.length, 0x4e4f534a), padded,
    word(binary.length, 0x004e4942), binary]);
}
