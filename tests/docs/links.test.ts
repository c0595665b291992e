/** Links of the documents lead to files and headings that exist, and the README stays one page. */
import { existsSync, readdirSync, readFileSync } from 'node:fs';
import { dirname, join, relative } from 'node:path';
import { fileURLToPath } from 'node:url';
import { expect, it } from 'vitest';

const ROOT = fileURLToPath(new URL('../../', import.meta.url));
const docs = readdirSync(join(ROOT, 'docs'), { recursive: true, encoding: 'utf8' })
  .filter((name) => name.endsWith('.md'))
  .map((name) => join(ROOT, 'docs', name));
const pages = ['README.md', 'CONTRIBUTING.md', 'CHANGELOG.md'].map((name) => join(ROOT, name)).concat(docs);
const textOf = (path: string) => readFileSync(path, 'utf8');

/** The anchors of a page, as hosts of Markdown make them from headings. */
function anchorsOf(text: string): Set<string> {
  const headings = [...text.matchAll(/^#+ (.+)$/gm)].map(([, heading = '']) => heading);
  return new Set(
    headings.map((heading) =>
      heading
        .toLowerCase()
        .replaceAll(/[^\p{L}\p{N} _-]/gu, '')
        .replaceAll(' ', '-'),
    ),
  );
}

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

it('every page of the manual can be reached from its contents', () => {
  const reached = new Set<string>();
  const waiting = [join(ROOT, 'docs/README.md')];
  for (let page = waiting.pop(); page !== undefined; page = waiting.pop()) {
    if (reached.has(page)) continue;
    reached.add(page);
    for (const [, path = ''] of textOf(page).matchAll(/\]\((?!https?:)([^)#\s]+\.md)/g)) {
      waiting.push(join(dirname(page), path));
    }
  }
  expect(docs.filter((page) => !reached.has(page)).map((page) => relative(ROOT, page))).toEqual([]);
});

it('the README is one page', () => {
  const text = textOf(join(ROOT, 'README.md'));
  expect(text.split('\n').length).toBeLessThanOrEqual(150);
  expect(text.split(/\s+/).length).toBeLessThanOrEqual(1200);
});
