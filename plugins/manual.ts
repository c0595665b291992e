/**
 * The manual of the page: the Markdown of docs/ as plain HTML, without script, in `manual/` beside the page.
 *
 *     docs/README.md         manual/index.html       the contents; their order is that of the pages
 *     docs/guide/curves.md   manual/guide/curves.html
 *     docs/pictures/…        manual/pictures/…       what pages show
 *     CONTRIBUTING.md        manual/CONTRIBUTING.html
 *
 * The development server makes them anew for each request. Anything that a page can't lead to ends the build.
 */
import { existsSync, readdirSync, readFileSync } from 'node:fs';
import { dirname, extname, join, posix, relative } from 'node:path';
import { fileURLToPath } from 'node:url';
import type { Marked, Tokens } from 'marked';
import type { Plugin } from 'vite';

const ROOT = fileURLToPath(new URL('..', import.meta.url));
const STYLE = 'manual.css';
const CONTENTS = 'docs/README.md';
/** Stricter than the page's own (`plugins/policy.ts`), which hosts may send besides. */
const POLICY = "default-src 'none'; style-src 'self'; img-src 'self'; base-uri 'none'; form-action 'none'";

const TYPES: Readonly<Record<string, string>> = {
  '.html': 'text/html; charset=utf-8',
  '.css': 'text/css; charset=utf-8',
  '.png': 'image/png',
  '.jpg': 'image/jpeg',
  '.webp': 'image/webp',
  '.gif': 'image/gif',
};

export function manual(): Plugin {
  return {
    name: 'marrow-manual',
    async generateBundle() {
      for (const [path, source] of await manualFiles()) {
        this.emitFile({ type: 'asset', fileName: `manual/${path}`, source });
      }
    },
    configureServer(server) {
      server.middlewares.use('/manual', (request, response, next) => {
        const { pathname } = new URL(request.url ?? '/', 'http://localhost');
        const path = pathname.endsWith('/') ? `${pathname.slice(1)}index.html` : pathname.slice(1);
        manualFiles().then((files) => {
          const content = files.get(path);
          if (content === undefined) return next();
          response.setHeader('content-type', TYPES[extname(path)] ?? 'application/octet-stream');
          response.end(content);
        }, next);
      });
    },
  };
}

/** The anchor of a heading, as hosts of Markdown make it. @param heading its Markdown */
export function anchorOf(heading: string): string {
  return heading
    .toLowerCase()
    .replaceAll(/[^\p{L}\p{N} _-]/gu, '')
    .replaceAll(' ', '-');
}

/** A page of the manual. */
interface ManualPage {
  /** Of its Markdown, from the root of the project. */
  readonly source: string;
  /** Below `manual/`. */
  readonly path: string;
  /** Without markup. */
  readonly title: string;
  readonly text: string;
}

interface Group {
  readonly title: string;
  readonly pages: readonly ManualPage[];
}

/**
 * All files of the manual by their paths below `manual/`.
 *
 * @throws Error if a link or an image leads nowhere, or a document isn't among the contents
 */
export async function manualFiles(): Promise<ReadonlyMap<string, string | Uint8Array>> {
  // Here, since tests and the command need the configuration without it.
  const { Marked } = await import('marked');
  const groups = groupsOf(new Marked());
  const contents = pageOf(CONTENTS);
  const pages = [contents, ...groups.flatMap((group) => group.pages)];
  const missing = documents().filter((source) => !pages.some((page) => page.source === source));
  if (missing.length > 0) throw new Error(`${CONTENTS} has no link to ${missing.join(', ')}.`);

  const files = new Map<string, string | Uint8Array>([[STYLE, read('plugins/manual.css')]]);
  pages.forEach((page, i) => {
    const shown = new Marked();
    const headings: Heading[] = [];
    shown.use({ renderer: renderer(page, pages, headings, (path, content) => files.set(path, content)) });
    const body = shown.parse(page.text, { async: false });
    files.set(page.path, html(page, { body, headings, groups, contents, previous: pages[i - 1], next: pages[i + 1] }));
  });
  return files;
}

const read = (path: string) => readFileSync(join(ROOT, path), 'utf8');

function documents(): readonly string[] {
  const all = readdirSync(join(ROOT, 'docs'), { recursive: true, encoding: 'utf8' });
  return all.filter((name) => name.endsWith('.md')).map((name) => `docs/${name.replaceAll('\\', '/')}`);
}

function pageOf(source: string): ManualPage {
  const text = read(source);
  const title = /^# (.+)$/m.exec(text)?.[1];
  if (title === undefined) throw new Error(`${source} has no title ("# …").`);
  const path = source === CONTENTS ? 'index.html' : `${source.replace(/^docs\//, '').replace(/\.md$/, '')}.html`;
  return { source, path, title: title.replaceAll('`', ''), text };
}

/** The pages that the contents link, under the headings where they do. */
function groupsOf(marked: Marked): readonly Group[] {
  const groups: { title: string; pages: ManualPage[] }[] = [];
  const sources = new Set<string>();
  for (const token of marked.lexer(read(CONTENTS))) {
    if (token.type === 'heading' && token.depth === 2) groups.push({ title: token.text, pages: [] });
    const group = groups.at(-1);
    if (!group) continue;
    marked.walkTokens([token], (inner) => {
      if (inner.type !== 'link' || !/\.md(#|$)/.test(inner.href)) return;
      const source = posix.join('docs', inner.href.replace(/#.*/, ''));
      if (sources.has(source)) return;
      sources.add(source);
      group.pages.push(pageOf(source));
    });
  }
  return groups;
}

interface Heading {
  readonly anchor: string;
  /** HTML. */
  readonly text: string;
}

/** @param add a file that the page shows */
function renderer(
  page: ManualPage,
  pages: readonly ManualPage[],
  headings: Heading[],
  add: (path: string, content: Uint8Array) => void,
) {
  const target = (href: string): string => {
    if (/^(https?:|#)/.test(href)) return href;
    const [, path = '', anchor = ''] = /^([^#]*)(.*)$/.exec(href) ?? [];
    const source = posix.join(posix.dirname(page.source), path);
    const linked = pages.find((one) => one.source === source);
    if (linked) return between(page, linked.path) + anchor;
    if (!existsSync(join(ROOT, source))) throw new Error(`${page.source}: ${href} leads to no file.`);
    const file = relative('docs', source).replaceAll('\\', '/');
    if (file.startsWith('..')) throw new Error(`${page.source}: ${href} is neither in docs/ nor among its contents.`);
    add(file, readFileSync(join(ROOT, source)));
    return between(page, file);
  };
  return {
    heading(this: Parser, { tokens, depth, text }: Tokens.Heading) {
      const shown = this.parser.parseInline(tokens);
      const anchor = anchorOf(text);
      if (depth === 2) headings.push({ anchor, text: shown });
      return `<h${depth} id="${escaped(anchor)}">${shown}</h${depth}>\n`;
    },
    link(this: Parser, { href, tokens }: Tokens.Link) {
      return `<a href="${escaped(target(href))}">${this.parser.parseInline(tokens)}</a>`;
    },
    image({ href, text }: Tokens.Image) {
      const size = sizeOf(join(ROOT, dirname(page.source), href));
      return `<img src="${escaped(target(href))}" alt="${escaped(text)}"${size}>`;
    },
    // Wide ones scroll, by keyboard too.
    table(this: Parser, token: Tokens.Table) {
      const row = (cells: readonly Tokens.TableCell[], tag: 'th' | 'td') =>
        `<tr>${cells.map(({ tokens }) => `<${tag}>${this.parser.parseInline(tokens)}</${tag}>`).join('')}</tr>\n`;
      const isNamed = token.header.some(({ text }) => text !== '');
      const head = isNamed ? `<thead>${row(token.header, 'th')}</thead>\n` : '';
      return `<div class="table" tabindex="0"><table>${head}<tbody>${token.rows.map((cells) => row(cells, 'td')).join('')}</tbody></table></div>\n`;
    },
    code({ text }: Tokens.Code) {
      return `<pre tabindex="0"><code>${escaped(text)}</code></pre>\n`;
    },
    html({ text }: Tokens.HTML | Tokens.Tag) {
      if (!/^\s*<!--/.test(text))
        throw new Error(`${page.source}: ${text.trim()} is HTML, which the manual leaves out.`);
      return '';
    },
  };
}

/** What marked calls a renderer on. */
interface Parser {
  readonly parser: { parseInline(tokens: Tokens.Generic[]): string };
}

/** `width` and `height` of a picture, so that the page doesn't move when it comes; empty if it isn't known how to tell. */
function sizeOf(path: string): string {
  const bytes = readFileSync(path);
  if (path.endsWith('.png')) return ` width="${bytes.readUInt32BE(16)}" height="${bytes.readUInt32BE(20)}"`;
  if (path.endsWith('.webp')) {
    const [width, height] = webpSize(bytes);
    return ` width="${width}" height="${height}"`;
  }
  if (path.endsWith('.gif')) return ` width="${bytes.readUInt16LE(6)}" height="${bytes.readUInt16LE(8)}"`;
  return '';
}

/** https://developers.google.com/speed/webp/docs/riff_container: extended, without loss, or with loss. */
function webpSize(bytes: Buffer): readonly [width: number, height: number] {
  const kind = bytes.toString('latin1', 12, 16);
  if (kind === 'VP8X') return [bytes.readUIntLE(24, 3) + 1, bytes.readUIntLE(27, 3) + 1];
  if (kind === 'VP8 ') return [bytes.readUInt16LE(26) & 0x3fff, bytes.readUInt16LE(28) & 0x3fff];
  const packed = bytes.readUInt32LE(21);
  return [(packed & 0x3fff) + 1, ((packed >> 14) & 0x3fff) + 1];
}

/** The address of a file of the manual on a page of it. */
function between(page: ManualPage, path: string): string {
  return posix.relative(posix.dirname(page.path), path);
}

function escaped(text: string): string {
  return text.replaceAll('&', '&amp;').replaceAll('<', '&lt;').replaceAll('>', '&gt;').replaceAll('"', '&quot;');
}

interface Around {
  readonly body: string;
  readonly headings: readonly Heading[];
  readonly groups: readonly Group[];
  readonly contents: ManualPage;
  readonly previous: ManualPage | undefined;
  readonly next: ManualPage | undefined;
}

function html(page: ManualPage, { body, headings, groups, contents, previous, next }: Around): string {
  const to = (path: string) => escaped(between(page, path));
  const link = (other: ManualPage, attributes = '') =>
    `<a href="${to(other.path)}"${other === page ? ' aria-current="page"' : attributes}>${escaped(other.title)}</a>`;
  const title = page === contents ? 'Marrow manual' : `${page.title} – Marrow manual`;
  // The contents have a list of pages already.
  const onPage = page !== contents && headings.length > 1;
  const own = headings.map(({ anchor, text }) => `<li><a href="#${escaped(anchor)}">${text}</a></li>`).join('');
  // After the title and what the page is for.
  const [lead = ''] = /^.*?<\/h1>\n(<p>.*?<\/p>\n)?/s.exec(body) ?? [];
  return `<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="${POLICY}">
<title>${escaped(title)}</title>
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<link rel="stylesheet" href="${to(STYLE)}">
<link rel="icon" type="image/svg+xml" href="${to('../icons/icon.svg')}">
</head>
<body>
<a class="skip" href="#content">Skip to content</a>
<header><a class="name" href="${to(contents.path)}">Marrow manual</a> <a href="${to('../index.html')}">Workbench</a></header>
<div class="columns">
<main id="content">
${lead}${onPage ? `<nav class="on-page" aria-label="On this page"><ul>${own}</ul></nav>\n` : ''}${body.slice(lead.length)}
<nav class="around" aria-label="Previous and next page">
${previous ? `<span>Previous: ${link(previous, ' rel="prev"')}</span>` : ''}
${next ? `<span class="next">Next: ${link(next, ' rel="next"')}</span>` : ''}
</nav>
</main>
<nav class="pages" aria-label="Pages">
${groups.map((group) => `<h2>${escaped(group.title)}</h2>\n<ul>${group.pages.map((one) => `<li>${link(one)}</li>`).join('\n')}</ul>`).join('\n')}
</nav>
</div>
</body>
</html>
`;
}
