// Pictures inside a .glb or .gltf, decoded by the browser as they are stored: no colour conversion, straight alpha.

function partsOf(bytes) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  if (bytes.length < 20 || view.getUint32(0, true) !== 0x46546c67)
    return { json: new TextDecoder().decode(bytes), binary: null };
  const jsonSize = view.getUint32(12, true);
  const json = new TextDecoder().decode(bytes.subarray(20, 20 + jsonSize));
  const next = 20 + jsonSize;
  const binary = next + 8 <= bytes.length ? bytes.subarray(next + 8, next + 8 + view.getUint32(next, true)) : null;
  return { json, binary };
}

async function storedBytes(image, document, binary) {
  if (image.uri?.startsWith('data:')) return new Uint8Array(await (await fetch(image.uri)).arrayBuffer());
  const view = document.bufferViews?.[image.bufferView];
  if (!view || !binary || (view.buffer ?? 0) !== 0) return null;
  const offset = view.byteOffset ?? 0;
  return binary.subarray(offset, offset + view.byteLength);
}

async function decode(bytes) {
  const bitmap = await createImageBitmap(new Blob([bytes]), { colorSpaceConversion: 'none', premultiplyAlpha: 'none' });
  // Through WebGL, not a 2-D canvas, whose pixels are premultiplied and come back changed.
  const gl = new OffscreenCanvas(1, 1).getContext('webgl2');
  const { width, height } = bitmap;
  gl.pixelStorei(gl.UNPACK_COLORSPACE_CONVERSION_WEBGL, gl.NONE);
  const texture = gl.createTexture();
  gl.bindTexture(gl.TEXTURE_2D, texture);
  gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA8, gl.RGBA, gl.UNSIGNED_BYTE, bitmap);
  gl.bindFramebuffer(gl.FRAMEBUFFER, gl.createFramebuffer());
  gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, texture, 0);
  const rgba = new Uint8Array(width * height * 4);
  gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, rgba);
  gl.getExtension('WEBGL_lose_context')?.loseContext();
  bitmap.close();
  return { width, height, rgba };
}

// [{ index, width, height, rgba }]; a damaged picture, or one that is another file, is left to the library's own message.
export async function decodePictures(bytes) {
  let document;
  const { json, binary } = partsOf(bytes);
  try {
    document = JSON.parse(json);
  } catch {
    return [];
  }
  const pictures = [];
  for (const [index, image] of (document.images ?? []).entries()) {
    const stored = await storedBytes(image, document, binary);
    if (!stored) continue;
    try {
      pictures.push({ index, ...await decode(stored) });
    } catch (error) {
      console.warn(`image ${index} cannot be decoded: ${error.message}`);
    }
  }
  return pictures;
}
