/** The text of files, for the tab *Source*: where it comes from, and places in it. */
import type { Diagnostic } from '../../model/diagnostic.ts';
import type { Character } from '../../model/document.ts';
import type { SourceFile } from '../../model/files.ts';
import type { SourceMap } from '../../model/source-map.ts';
import type { LineHunk } from '../../model/text-changes.ts';

/** Longer texts are neither compared nor edited: comparing one of this size takes 1 to 2 s. */
export const MAX_TEXT_BYTES = 5_000_000;

/** A place in a file, as messages name it. */
export interface SourcePlace {
  /** Without folders. */
  readonly file: string;
  /** From 1. */
  readonly line: number;
}

/** What a file gave when it was opened. */
export interface AsOpened {
  /** Those that have a part from it, as they were then. */
  readonly characters: readonly Character[];
  /** The text that was read. */
  readonly given: Blob | undefined;
}

/** What the page changed in a file, against the file as it was opened. */
export interface FileChanges {
  /** Ascending; none: nothing has changed. */
  readonly hunks: readonly LineHunk[];
  /** The text with the changes, and what is on its lines; absent if nothing has changed. */
  readonly changed?: { readonly text: Blob; readonly map: SourceMap };
}

/** A text that was edited, as it was read. */
export interface CheckedText {
  readonly diagnostics: readonly Diagnostic[];
  /** It says what the text said that it was edited from. */
  readonly isSame: boolean;
  /**
   * Replaces what the page has from the file, as one undo step; false if that doesn't fit any more. Absent if the text
   * has errors or doesn't fit.
   */
  apply?(): boolean;
}

/** Comparing and editing texts. Both reject with an `Error` whose message is a sentence. */
export interface TextEdits {
  changes(path: string): Promise<FileChanges>;
  /** @param base what it was edited from */
  check(path: string, edited: string, base: string): Promise<CheckedText>;
}

/** The text of files as they were opened: `SourceTexts` of the page. */
export interface SourceFiles {
  /** Whether a file of that name is text. */
  isText(name: string): boolean;
  /** The path of the file of that name that was given last, opened or not; undefined if there was none. */
  pathOf(name: string): string | undefined;
  /** What was given for a path, or the zip that contains it: another object once it is opened again. */
  given(path: string): Blob | undefined;
  /** What a file gave that was read in this session; undefined if its parts were restored. */
  opened(source: SourceFile): AsOpened | undefined;
  /** Loads what compares and edits texts. */
  edits(): Promise<TextEdits>;
  /**
   * Reads a file. Rejects with an `Error`, whose message is a sentence, if it can't be read, and with the signal's
   * reason if it is aborted.
   *
   * @param onText called as soon as the bytes are known, before their lines are
   * @param onProgress how much is read, from 0 to 1
   */
  read(
    path: string,
    signal: AbortSignal,
    onText: (text: Blob) => void,
    onProgress: (share: number) => void,
  ): Promise<SourceMap>;
}
