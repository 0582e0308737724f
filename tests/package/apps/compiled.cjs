// The sizes of the modules that are compiled from here on: required alone and first, so that it can be seen what is compiled, and when.
const sizes = [];
WebAssembly.Module = class extends WebAssembly.Module {
  constructor(bytes) {
    super(bytes);
    sizes.push(bytes.byteLength);
  }
};

module.exports = sizes;
