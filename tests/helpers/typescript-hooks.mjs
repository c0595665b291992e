/** How Node reads the project's TypeScript, and the modules that Vite's plugins make: hooks of `node:module`. */
import { readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { transformSync } from 'rolldown/utils';

const TYPESCRIPT = /^file:(?!.*\/node_modules\/).*\.ts(?:\?.*)?$/;
const DRACO = JSON.stringify(new URL('../../plugins/draco.ts', import.meta.url).href);
const WEB_PAGE = JSON.stringify(new URL('../../plugins/web-page.ts', import.meta.url).href);
const VIRTUAL = {
  'virtual:draco': `import { draco } from ${DRACO};
const text = draco().load('\\0virtual:draco');
export const { make, wasm } = await import('data:text/javascript;base64,' + Buffer.from(text).toString('base64'));`,
  'virtual:web-page': `import { pageScripts } from ${WEB_PAGE};
export const { viewer, loader, style, policy } = await pageScripts();`,
  // As in development.
  'virtual:opening-sample': 'export const address = undefined;',
};

/** Its other form, the one that Node finds, hides its names. */
const GIFENC = new URL('../../node_modules/gifenc/dist/gifenc.esm.js', import.meta.url).href;

export function resolve(specifier, context, nextResolve) {
  if (specifier in VIRTUAL) return { url: specifier, shortCircuit: true };
  if (specifier === 'gifenc') return { url: GIFENC, format: 'module', shortCircuit: true };
  return nextResolve(specifier, context);
}

export function load(url, context, nextLoad) {
  if (url in VIRTUAL) return { format: 'module', source: VIRTUAL[url], shortCircuit: true };
  if (!TYPESCRIPT.test(url)) return nextLoad(url, context);
  const path = fileURLToPath(url);
  const { code, map, errors } = transformSync(path, readFileSync(path, 'utf8'), { sourcemap: true });
  if (errors.length > 0) throw new SyntaxError(`${path}: ${errors[0].message}`);
  // For the lines in messages of errors.
  const inline = Buffer.from(JSON.stringify(map)).toString('base64');
  const source = `${code}\n//# sourceMappingURL=data:application/json;base64,${inline}\n`;
  return { format: 'module', source, shortCircuit: true };
}
