import { mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { describe, expect, it } from 'vitest';
import { builtFiles, webAppManifest } from '../../plugins/offline.ts';
import { formatKindOf, KINDS, type Kind, READABLE_EXTENSIONS } from '../../src/files/kinds.ts';

const ROOT = fileURLToPath(new URL('../../', import.meta.url));

const isRare = (extension: string) => {
  const kind: Kind = KINDS[formatKindOf(`a.${extension}`) ?? 'skel'];
  return kind.isRare === true;
};

describe('the web app manifest', () => {
  it('the web app manifest hands over files of every kind that is told by its extensions, each of them once', () => {
    const [{ accept, action }] = webAppManifest().file_handlers;
    expect(
      Object.values(accept)
        .flat()
        .map((extension) => extension.replace('.', ''))
        .sort(),
    ).toEqual(READABLE_EXTENSIONS.filter((extension) => !isRare(extension)).sort());
    expect(Object.values(accept).flat()).not.toContain('.txt');
    expect(action).toBe('.');
    expect(Object.keys(accept).filter((type) => !/^(application\/x-|image\/)[a-z0-9]+$/.test(type))).toEqual([]);
  });

  it('the web app manifest names icons of the sizes that they have', () => {
    for (const { src, sizes, type } of webAppManifest().icons) {
      const bytes = readFileSync(join(ROOT, 'public', src));
      if (type === 'image/svg+xml') expect(bytes.toString()).toMatch(/^<svg /);
      // Width and height in the header of a PNG.
      else expect(`${bytes.readUInt32BE(16)}x${bytes.readUInt32BE(20)}`).toBe(sizes);
    }
  });

  it('the web app manifest has relative addresses only, for any path', () => {
    const { start_url, scope, icons } = webAppManifest();
    for (const address of [start_url, scope, ...icons.map(({ src }) => src)]) expect(address).not.toMatch(/^\/|:/);
  });

  it('the icon of the tab is that of the app', () => {
    const page = readFileSync(join(ROOT, 'index.html'), 'utf8');
    const inPage = /rel="icon"[^>]*href="\/([^"]*)"/.exec(page)?.[1];
    expect(webAppManifest().icons.map(({ src }) => src)).toContain(inPage);
  });
});

describe('the list of built files', () => {
  const listed = (files: Readonly<Record<string, string>>) => {
    const folder = mkdtempSync(join(tmpdir(), 'marrow-'));
    try {
      mkdirSync(join(folder, 'assets'));
      for (const [path, text] of Object.entries(files)) writeFileSync(join(folder, path), text);
      return builtFiles(folder);
    } finally {
      rmSync(folder, { recursive: true });
    }
  };

  it('the list of built files has all but source maps and the service worker itself', () => {
    const files = listed({ 'index.html': '', 'assets/a b.js': '', 'assets/a b.js.map': '', 'sw.js': '' });
    expect(Object.keys(files)).toEqual(['assets/a%20b.js', 'index.html']);
  });

  it('the list of built files has the hash of each content as browsers check it', () => {
    // SHA-256 of "abc" (FIPS 180-2, appendix B.1), in base64.
    expect(listed({ 'index.html': 'abc' })).toEqual({
      'index.html': 'sha256-ungWv48Bz+pBQUDeXa4iI7ADYaOWF3qctBD/YfIAFa0=',
    });
  });
});
