// The WebAssembly library with JavaScript's types: texts, byte arrays, exceptions.
import createWelkin from './welkin.js';

export async function loadLibrary(options = {}) {
  return new Library(await createWelkin(options));
}

class Library {
  constructor(module) {
    this.module = module;
  }

  // Copies of the arguments live in the library's memory during the call: texts as UTF-8, typed arrays as they are.
  call(name, ...values) {
    const { module } = this;
    const copies = [];
    const keep = (size) => {
      const at = module._malloc(Math.max(size, 1));
      if (at === 0) throw new Error('there is not enough memory');
      copies.push(at);
      return at;
    };
    try {
      const numbers = values.map((value) => {
        if (typeof value === 'string') {
          const size = module.lengthBytesUTF8(value) + 1;
          const at = keep(size);
          module.stringToUTF8(value, at, size);
          return at;
        }
        if (ArrayBuffer.isView(value)) {
          const bytes = new Uint8Array(value.buffer, value.byteOffset, value.byteLength);
          const at = keep(bytes.length);
          module.HEAPU8.set(bytes, at);
          return at;
        }
        return Number(value);
      });
      return module[`_welkin_${name}`](...numbers);
    } finally {
      for (const at of copies) module._free(at);
    }
  }

  // For functions that say whether they succeeded.
  run(name, ...values) {
    if (this.call(name, ...values) === 0) throw new Error(this.module.UTF8ToString(this.call('error')));
  }

  text(name) {
    return this.module.UTF8ToString(this.call(name));
  }

  bytes(at, size) {
    return this.module.HEAPU8.slice(at, at + size);
  }
}
