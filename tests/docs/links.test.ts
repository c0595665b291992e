/** Links of the documents lead to files and headings that exist, and the README stays one page. */
import { existsSync, readdirSync, readFileSync } from 'node:fs';
import { dirname, join, relative } from 'node:path';
import { fileURLToPath } from 'node:url';
import { expect, it } from 'vitest';
import { anchorOf } from '../../plugins/manual.ts';

const ROOT = fileURLToPath(new URL('../../', import.meta.url));
const docs = readdirSync(join(ROOT, 'docs'), { recursive: true, encoding: 'utf8' })
  .filter((name) => name.endsWith('.md'))
  .map((name) => join(ROOT, 'docs', name));
const pages = ['README.md', 'CONTRIBUTING.md', 'CHANGELOG.md'].map((name) => join(ROOT, name)).concat(docs);
const textOf = (path: string) => readFileSync(path, 'utf8');

/** The anchors of a page, as hosts of Markdown make them from headings. */
const anchorsOf = (text: string) =>
  new Set([...text.matchAll(/^#+ (.+)$/gm)].map(([, heading = '']) => anchorOf(heading)));

it('every link between documents leads to a file, and to a heading of it', () => {
  const broken = pages.flatMap((page) =>
    [...textOf(page).matchAll(/\]\((?!https?:)([^)#\s]*)(?:#([^)\s]*))?\)/g)]
      .filter(([, path = '', anchor]) => {
        const target = path === '' ? page : join(dirname(page), path);
        return !existsSync(target) || (anchor !== undefined && !anchorsOf(textOf(target)).has(anchor));
      })
      .map(([link]) => `${relative(ROOT, page)}: ${link}`),
  );
  expect(broken).toEqual([]);
});

it('the README is one page', () => {
  const text = textOf(join(ROOT, 'README.md'));
  expect(text.split('\n').length).toBeLessThanOrEqual(150);
  expect(text.split(/\s+/).length).toBeLessThanOrEqual(1200);
});
