/** Which packages are built into the page, the command and the npm package: all are only needed to build. */
import { readdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';

const ROOT = fileURLToPath(new URL('../../', import.meta.url));

/**
 * Their paths in the lock file: of those that the sources import, or that a plugin takes files of, and of what these
 * need.
 */
export function builtPackages() {
  const { devDependencies } = JSON.parse(readFileSync(join(ROOT, 'package.json'), 'utf8'));
  const locked = JSON.parse(readFileSync(join(ROOT, 'package-lock.json'), 'utf8')).packages;
  const texts = ['src', 'plugins'].flatMap((folder) =>
    readdirSync(join(ROOT, folder), { recursive: true, encoding: 'utf8' })
      .filter((file) => file.endsWith('.ts'))
      .map((file) => readFileSync(join(ROOT, folder, file), 'utf8')),
  );
  const isUsed = (name) => texts.some((text) => isImportedIn(text, name));
  const found = new Set();
  const add = (name) => {
    const path = `node_modules/${name}`;
    if (found.has(path)) return;
    found.add(path);
    Object.keys(locked[path]?.dependencies ?? {}).forEach(add);
  };
  Object.keys(devDependencies).filter(isUsed).forEach(add);
  return [...found];
}

/** Modules of the page import; plugins, which only run when it is built, name the folder of what is in it. */
function isImportedIn(text, name) {
  const isPlugin = text.includes("from 'vite'");
  return isPlugin ? text.includes(`node_modules/${name}/`) : text.includes(`'${name}'`) || text.includes(`'${name}/`);
}
