/**
 * The decoder of Draco as one module for page, worker and command: the package has a script for Node and a file of
 * WebAssembly, which it looks for on disk.
 *
 *     import { make, wasm } from 'virtual:draco';      wasm: base64
 */
import { readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import type { Plugin } from 'vite';

const FOLDER = fileURLToPath(new URL('../node_modules/draco3dgltf/', import.meta.url));
const IS_NODE = '"object"==typeof process&&"object"==typeof process.versions&&"string"==typeof process.versions.node';

export function draco(): Plugin {
  return {
    name: 'marrow-draco',
    resolveId: (id) => (id === 'virtual:draco' ? '\0virtual:draco' : undefined),
    load(id) {
      if (id !== '\0virtual:draco') return undefined;
      const script = readFileSync(`${FOLDER}draco_decoder_gltf_nodejs.js`, 'utf8');
      if (!script.includes(IS_NODE)) throw new Error("Draco's script has changed: see plugins/draco.ts.");
      const wasm = readFileSync(`${FOLDER}draco_decoder_gltf.wasm`).toString('base64');
      // What follows exports it for other kinds of modules.
      const [plain] = script
        .replace(IS_NODE, '!1')
        .replace(/require\("(fs|path)"\)/g, 'null')
        .split('"object"===typeof exports');
      return `${plain}\nexport const make = DracoDecoderModule;\nexport const wasm = "${wasm}";\n`;
    },
  };
}
