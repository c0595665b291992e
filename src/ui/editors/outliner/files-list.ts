/** The open files and those that belong to nothing. A drop of thousands is listed as it is scrolled. */
import type { Document } from '../../../model/document.ts';
import type { SourceFile } from '../../../model/files.ts';
import type { Uses } from '../../state/workbench.ts';
import { element } from '../../widgets/dom.ts';
import { icon } from '../../widgets/icons.ts';
import { cutLabel } from '../../widgets/middle-cut.ts';
import { bytes } from '../../widgets/numbers/number-text.ts';

export interface ListedFile {
  readonly source: SourceFile;
  /** Why it is unused; empty if it isn't. */
  readonly why: string;
}

/** Each file once, even if several characters came from it. */
export function listedFiles({ characters, unused }: Document): readonly ListedFile[] {
  const files = new Map<string, ListedFile>();
  const list = (why: string, sources: readonly SourceFile[] = []) => {
    for (const source of sources) files.set(source.path, { source, why });
  };
  for (const { unread } of characters) list('It has errors.', unread);
  for (const { sources } of characters) list('', sources);
  for (const { file, why } of unused) list(why, [file.source]);
  // Those that are used come first.
  return [...files.values()].sort((a, b) => Number(a.why !== '') - Number(b.why !== ''));
}

/** Rows that are added at a time. */
const CHUNK = 60;

export interface FilesList {
  readonly element: HTMLElement;
  readonly count: number;
}

export function filesList(wb: Uses<'store'>): FilesList {
  const list = element('div', { class: 'file-list scrolls', tabindex: 0 });
  /** Scrolled into view, it adds more rows. */
  const end = element('div', { class: 'list-end' });
  let files: readonly ListedFile[] = [];
  let next = 0;
  const listMore = () => {
    const more = files.slice(next, next + CHUNK);
    next += more.length;
    end.before(...more.map(fileRow));
    // Observed again, so that it is said again if it is still in view.
    observer.unobserve(end);
    if (next < files.length) observer.observe(end);
  };
  const observer = new IntersectionObserver(
    (entries) => {
      if (entries.some(({ isIntersecting }) => isIntersecting)) listMore();
    },
    { root: list, rootMargin: '200px 0px' },
  );
  const show = (document: Document) => {
    files = listedFiles(document);
    next = 0;
    const nothing =
      document.isOpeningSample && document.characters.length > 0
        ? `An example is open. It ${document.isOpeningSample === true ? 'closes' : 'was changed, so it stays'} when you open your own files.`
        : 'Files you open are listed here. Files that were not used say why.';
    list.replaceChildren(...(files.length ? [] : [element('p', { class: 'empty' }, nothing)]), end);
    listMore();
  };
  wb.store.subscribe((now, before) => {
    if (now.document.unused !== before.document.unused || !sameSources(now.document, before.document)) {
      show(now.document);
    }
  });
  show(wb.store.document);
  return {
    element: list,
    get count() {
      return files.length;
    },
  };
}

function sameSources(a: Document, b: Document): boolean {
  return (
    a.isOpeningSample === b.isOpeningSample &&
    a.characters.length === b.characters.length &&
    a.characters.every(
      ({ sources, unread }, i) => sources === b.characters[i].sources && unread === b.characters[i].unread,
    )
  );
}

function fileRow({ source, why }: ListedFile): HTMLElement {
  return element(
    'div',
    { class: `file-row ${why ? 'is-unused' : ''}`, tooltip: source.path },
    icon(why ? 'unused' : 'file'),
    cutLabel(source.name),
    element(
      'span',
      { class: 'detail' },
      // Beside the files of a take that more than its channels moves there is a plain one, which may be missing.
      source.bytes > 0 ? bytes(source.bytes) : 'made on save',
    ),
    why && element('span', { class: 'why' }, `Unused: ${why}`),
  );
}
