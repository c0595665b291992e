/** The manual as it is built: plain pages without script, in which every address leads somewhere. */
import { existsSync, readdirSync, readFileSync, statSync } from 'node:fs';
import { posix } from 'node:path';
import { fileURLToPath } from 'node:url';
import { describe, expect, it } from 'vitest';
import { manualFiles } from '../../plugins/manual.ts';
import { fileOf, SHOTS } from '../pictures/shots.ts';

const ROOT = fileURLToPath(new URL('../../', import.meta.url));
const files = await manualFiles();
const pages = [...files.keys()].filter((path) => path.endsWith('.html'));

const textOf = (path: string) => {
  const content = files.get(path);
  if (typeof content !== 'string') throw new Error(`The manual has no page ${path}.`);
  return content;
};
/** All addresses of a page, as paths from the page of Marrow. */
const addressesOf = (path: string) =>
  [...textOf(path).matchAll(/ (?:href|src)="([^"]*)"/g)]
    .map(([, address = '']) => address)
    .filter((address) => !/^https?:/.test(address))
    .map((address) => {
      const [file = '', anchor] = address.split('#');
      return { file: file === '' ? `manual/${path}` : posix.join('manual', posix.dirname(path), file), anchor };
    });
const isBuilt = (file: string) =>
  files.has(file.replace(/^manual\//, '')) || file === 'index.html' || existsSync(`${ROOT}public/${file}`);

describe('the manual', () => {
  it('the manual has pages, and all their links and pictures lead to files and headings of it', () => {
    expect(pages.length).toBeGreaterThan(20);
    const broken = pages.flatMap((path) =>
      addressesOf(path)
        .filter(({ file, anchor }) => {
          const hasAnchor = () => textOf(file.replace(/^manual\//, '')).includes(` id="${anchor}"`);
          return !isBuilt(file) || (anchor !== undefined && !hasAnchor());
        })
        .map(({ file, anchor }) => `${path}: ${file}#${anchor ?? ''}`),
    );
    expect(broken).toEqual([]);
  });

  it('every page of the manual is reached from its contents by Next, and back by Previous', () => {
    const linked = (path: string, rel: string) => {
      const [, address] = new RegExp(`<a href="([^"]*)" rel="${rel}">`).exec(textOf(path)) ?? [];
      return address === undefined ? undefined : posix.join(posix.dirname(path), address);
    };
    const way = (from: string, rel: string) => {
      const found = [from];
      for (let at = linked(from, rel); at !== undefined; at = linked(at, rel)) found.push(at);
      return found;
    };
    const forth = way('index.html', 'next');
    expect([...forth].sort()).toEqual([...pages].sort());
    expect(way(forth.at(-1) ?? '', 'prev')).toEqual(forth.toReversed());
  });

  it('each page of the manual has a title of its own, one heading above all, and marks itself in the list of pages', () => {
    const titles = pages.map((path) => /<title>(.*?)<\/title>/.exec(textOf(path))?.[1]);
    expect(new Set(titles).size).toBe(pages.length);
    for (const path of pages) expect([path, textOf(path).match(/<h1 /g)?.length]).toEqual([path, 1]);
    const marked = pages.filter((path) => textOf(path).includes(' aria-current="page"'));
    expect(pages.filter((path) => !marked.includes(path))).toEqual(['index.html']);
  });

  it('pages of the manual need neither script nor inline style, and every picture says what it shows', () => {
    for (const path of pages) {
      // An example may have both, as text.
      const page = textOf(path).replace(/<pre\b[\s\S]*?<\/pre>/g, '');
      expect([path, page.match(/<script|<style| style=| on\w+="/g)]).toEqual([path, null]);
      const pictures = textOf(path).match(/<img [^>]*>/g) ?? [];
      expect(pictures.filter((picture) => !/ alt="[^"]{10,}"/.test(picture))).toEqual([]);
    }
  });

  it('the pictures are those that their script makes, none over 150 kB, and each is shown', () => {
    const pictures = readdirSync(`${ROOT}docs/pictures`);
    expect(pictures.sort()).toEqual(SHOTS.map(fileOf).sort());
    expect(pictures.filter((name) => statSync(`${ROOT}docs/pictures/${name}`).size > 150_000)).toEqual([]);
    const readme = readFileSync(`${ROOT}README.md`, 'utf8');
    const isShown = (name: string) => files.has(`pictures/${name}`) || readme.includes(`docs/pictures/${name}`);
    expect(pictures.filter((name) => !isShown(name))).toEqual([]);
  });
});
