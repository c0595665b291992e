/** What the packages that are built into the page and the command may be. */
import { readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { describe, expect, it } from 'vitest';
import { builtPackages } from './helpers/built-packages.mjs';

const ROOT = fileURLToPath(new URL('../', import.meta.url));

interface Locked {
  readonly license?: string;
  readonly hasInstallScript?: boolean;
}

const read = (path: string) => JSON.parse(readFileSync(`${ROOT}${path}`, 'utf8'));
// As npm writes it.
const locked = Object.entries(read('package-lock.json').packages as Record<string, Locked>).filter(([path]) => path);

/** They may be part of a program under the MIT licence, as they are. */
const ALLOWED = new Set(['0BSD', 'Apache-2.0', 'BSD-2-Clause', 'BSD-3-Clause', 'ISC', 'MIT', 'MPL-2.0']);

describe('packages', () => {
  it('what is built into the page and the command has a licence that allows it, by its own word too', () => {
    const paths = new Set(builtPackages());
    const built = locked.filter(([path]) => paths.has(path));
    expect(built.map(([path]) => path)).toContain('node_modules/three');
    expect(built.length).toBe(paths.size);
    for (const [path, { license }] of built) {
      expect([path, ALLOWED.has(license ?? '')]).toEqual([path, true]);
      expect([path, read(`${path}/package.json`).license]).toEqual([path, license]);
    }
  });

  it('whoever installs the package gets nothing else, and nothing runs', () => {
    const { dependencies, scripts } = read('package.json');
    expect(dependencies).toBeUndefined();
    expect(Object.keys(scripts).filter((name) => /install|prepare/.test(name))).toEqual([]);
  });

  it('no package runs a script when it is installed', () => {
    expect(readFileSync(`${ROOT}.npmrc`, 'utf8')).toMatch(/^ignore-scripts=true$/m);
    // One that needs its script would be installed without it, and fail later.
    const scripted = locked.filter(([, { hasInstallScript }]) => hasInstallScript).map(([path]) => path);
    expect(scripted.filter((path) => !path.endsWith('/fsevents'))).toEqual([]);
  });

  it('every package is pinned to the bytes it had, wherever it comes from', () => {
    const loose = Object.entries(read('package-lock.json').packages as Record<string, { integrity?: string }>);
    expect(loose.filter(([path, { integrity }]) => path && !integrity?.startsWith('sha512-'))).toEqual([]);
    const { devDependencies } = read('package.json');
    for (const [name, version] of Object.entries(devDependencies)) {
      expect([name, version]).toEqual([name, expect.stringMatching(/^(npm:[@\w/-]+@)?\d+\.\d+\.\d+[\w.-]*$/)]);
    }
  });
});
