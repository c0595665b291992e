/**
 * The text of files as they were given, for the tab *Source*. Blobs are kept, which refer to bytes on disk or in the
 * browser's own storage: nothing is copied until lines are shown. After a restored session the file is read from disk.
 */
import type { DiskFile } from '../io/disk-files.ts';
import type { GivenFile } from '../io/given.ts';
import type { Character, Document } from '../model/document.ts';
import { baseName, type SourceFile } from '../model/files.ts';
import { mapMarks } from '../model/part.ts';
import type { SourceMap } from '../model/source-map.ts';
import { formatKindOf } from '../project/kinds.ts';
import type { AsOpened, SourceFiles, TextEdits } from '../ui/state/source.ts';
import type { Runs } from '../worker/client.ts';
import type { SourceInput } from '../worker/protocol.ts';
import type { DiskHandles } from './disk-handles.ts';

export interface SourceTextsParts {
  readonly worker: Runs<'source'>;
  readonly handles: Pick<DiskHandles, 'at'>;
  /** `readAgain` of `io/disk-files.ts`. */
  readAgain(file: DiskFile, signal: AbortSignal): Promise<GivenFile>;
  /** Loads what compares and changes texts. */
  edits(texts: SourceTexts): Promise<TextEdits>;
}

interface Found {
  readonly blob: Blob;
  /** Its path in the blob, which is a zip then. */
  readonly inside?: string;
}

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

  /** Notes what files gave, right after they were opened: those that were known before are as they were then. */
  noteOpened({ characters }: Document): void {
    const found = new Map<SourceFile, Character[]>();
    for (const character of characters) {
      const sources = new Set<SourceFile>();
      if (character.parts) {
        mapMarks(character.parts, (mark) => {
          if (mark.file) sources.add(mark.file.source);
          return mark;
        });
      }
      for (const source of sources) found.set(source, [...(found.get(source) ?? []), character]);
    }
    for (const [source, own] of found) {
      if (!this.asOpened.has(source)) this.asOpened.set(source, { characters: own, given: this.given(source.path) });
    }
  }

  opened(source: SourceFile): AsOpened | undefined {
    return this.asOpened.get(source);
  }

  isText(name: string): boolean {
    const kind = formatKindOf(name);
    return kind !== undefined && kind !== 'texture';
  }

  pathOf(name: string): string | undefined {
    return [...this.blobs.keys()].findLast((path) => baseName(path) === name);
  }

  given(path: string): Blob | undefined {
    return this.foundIn(path)?.blob;
  }

  async read(
    path: string,
    signal: AbortSignal,
    onText: (text: Blob) => void,
    onProgress: (share: number) => void,
  ): Promise<SourceMap> {
    const file = await this.find(path, signal);
    signal.throwIfAborted();
    if (file.inside === undefined) onText(file.blob);
    const { map, text } = await this.parts.worker.run('source', file, {
      signal,
      onProgress: ({ done, of }) => onProgress(of > 0 ? done / of : 0),
    });
    if (text) onText(text);
    return map;
  }

  edits(): Promise<TextEdits> {
    return this.parts.edits(this);
  }

  /** Where the text of a file is. Rejects as `read` does. */
  async find(path: string, signal: AbortSignal): Promise<SourceInput> {
    const found = this.foundIn(path);
    if (found) return { path, ...found };
    const file = this.parts.handles.at(path);
    if (!file) throw new Error('Its text is no longer at hand. Open the file again.');
    const { blob } = await this.parts.readAgain(file, signal);
    const inside = zipAndInside(path)?.[1];
    return { path, blob, ...(file.path !== path && inside !== undefined && { inside }) };
  }

  private foundIn(path: string): Found | undefined {
    const own = this.blobs.get(path);
    if (own) return { blob: own };
    const [zip, inside] = zipAndInside(path) ?? [];
    const blob = zip === undefined ? undefined : this.blobs.get(zip);
    return blob && inside !== undefined ? { blob, inside } : undefined;
  }
}

/** `heroes.zip/hero/hero.skel` is `hero/hero.skel` in `heroes.zip`. */
function zipAndInside(path: string): readonly [zip: string, inside: string] | undefined {
  const end = path.toLowerCase().lastIndexOf('.zip/') + '.zip'.length;
  return end < '.zip'.length ? undefined : [path.slice(0, end), path.slice(end + 1)];
}
