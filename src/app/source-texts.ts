/**
 * The text of files as they were given, for the tab *Source*. Blobs are kept, which refer to bytes on disk or in the
 * browser's own storage: nothing is copied until lines are shown. After a restored session the file is read from disk.
 */

import { formatKindOf, KINDS, type Kind } from '../files/kinds.ts';
import type { GivenFile } from '../io/given.ts';
import type { Character, Document } from '../model/document.ts';
import { baseName, type SourceFile } from '../model/files.ts';
import { mapMarks } from '../model/part.ts';
import type { SourceMap } from '../model/source-map.ts';
import type { AsOpened, SourceFiles, TextEdits } from '../ui/state/source.ts';
import type { SourceInput } from '../worker/protocol.ts';
import type { FoundText, TextParts } from './read-text.ts';

export interface SourceTextsParts extends TextParts {
  /** Loads what compares and changes texts. */
  edits(texts: SourceTexts): Promise<TextEdits>;
}

/** Needed only once a text is shown. */
const reading = () => import('./read-text.ts');

export class SourceTexts implements SourceFiles {
  /** By path, in the order in which they were given. */
  private readonly blobs = new Map<string, Blob>();

  /** By the file as it was read, which undo restores with its parts. */
  private readonly asOpened = new WeakMap<SourceFile, AsOpened>();

  constructor(private readonly parts: SourceTextsParts) {}

  /** Keeps given files, in place of earlier ones of their paths. */
  note(files: readonly GivenFile[]): void {
    for (const { path, blob } of files) {
      this.blobs.delete(path);
      this.blobs.set(path, blob);
    }
  }

  /** Notes a file that was written in place: what it had before can't be read any more. */
  noteWritten(path: string, blob: Blob, { characters }: Document): void {
    this.note([{ path, blob }]);
    for (const { source, characters: own } of sourcesOf(characters)) {
      if (source.path === path) this.asOpened.set(source, { characters: own, given: blob });
    }
  }

  /** Notes what files gave, right after they were opened: those that were known before are as they were then. */
  noteOpened({ characters }: Document): void {
    for (const { source, characters: own } of sourcesOf(characters)) {
      if (!this.asOpened.has(source)) this.asOpened.set(source, { characters: own, given: this.given(source.path) });
    }
  }

  opened(source: SourceFile): AsOpened | undefined {
    return this.asOpened.get(source);
  }

  isText(name: string): boolean {
    const kind = formatKindOf(name);
    const { isBinary }: Partial<Kind> = kind ? KINDS[kind] : { isBinary: true };
    return !isBinary;
  }

  pathOf(name: string): string | undefined {
    return [...this.blobs.keys()].findLast((path) => baseName(path) === name);
  }

  given(path: string): Blob | undefined {
    return this.found(path)?.blob;
  }

  async read(
    path: string,
    signal: AbortSignal,
    onText: (text: Blob) => void,
    onProgress: (share: number) => void,
  ): Promise<SourceMap> {
    const { readText } = await reading();
    return readText(this.parts, await this.find(path, signal), signal, onText, onProgress);
  }

  edits(): Promise<TextEdits> {
    return this.parts.edits(this);
  }

  /** Where the text of a file is. Rejects as `read` does. */
  async find(path: string, signal: AbortSignal): Promise<SourceInput> {
    const { findText } = await reading();
    return findText(this.parts, path, this.found(path), zipAndInside(path)?.[1], signal);
  }

  /** Where the text of a file is, if it was given in this session. */
  found(path: string): FoundText | undefined {
    const own = this.blobs.get(path);
    if (own) return { blob: own };
    const [zip, inside] = zipAndInside(path) ?? [];
    const blob = zip === undefined ? undefined : this.blobs.get(zip);
    return blob && inside !== undefined ? { blob, inside } : undefined;
  }
}

/** The files that characters have parts of, with these characters. */
function sourcesOf(characters: readonly Character[]) {
  const found = new Map<SourceFile, Character[]>();
  for (const character of characters) {
    const sources = new Set<SourceFile>();
    if (character.parts) {
      mapMarks(character.parts, (mark) => {
        if (mark.file) sources.add(mark.file.source);
        return mark;
      });
    }
    for (const source of sources) {
      const own = found.get(source);
      if (own) own.push(character);
      else found.set(source, [character]);
    }
  }
  return [...found].map(([source, own]) => ({ source, characters: own }));
}

/** `heroes.zip/hero/hero.skel` is `hero/hero.skel` in `heroes.zip`. */
function zipAndInside(path: string): readonly [zip: string, inside: string] | undefined {
  const end = path.toLowerCase().lastIndexOf('.zip/') + '.zip'.length;
  return end < '.zip'.length ? undefined : [path.slice(0, end), path.slice(end + 1)];
}
