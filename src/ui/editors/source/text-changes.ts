/**
 * What the page changed in the file that is shown. It is asked for once nothing has changed for a moment, one time
 * after another: of what has changed meanwhile only the last state is compared.
 */

import type { Character } from '../../../model/document.ts';
import { sentenceOf } from '../../../model/failure.ts';
import type { SourceMap } from '../../../model/source-map.ts';
import type { LineHunk } from '../../../model/text-changes.ts';
import type { SourceFiles, TextEdits } from '../../state/source.ts';
import { LineText, type ShownLine } from './line-text.ts';

/** Milliseconds without a change. */
const PAUSE = 250;

/** A text with its changes. */
export interface ChangedText {
  readonly hunks: readonly LineHunk[];
  readonly map: SourceMap;
  readonly text: Blob;
  readonly count: number;
  line(line: number): ShownLine | undefined;
}

export interface ChangesCalls {
  /** There is another text, none any more, or a problem. */
  onChange(): void;
  /** More lines were read. */
  onText(): void;
  /** Lines to be read before the text is shown. */
  inView(): readonly number[];
}

export class TextChanges {
  /** Undefined if nothing has changed, or until it is known. */
  text: ChangedText | undefined;
  /** Why there is none, as a sentence. */
  problem: string | undefined;
  isComparing = false;
  private path: string | undefined;
  private characters: readonly Character[] = [];
  private timer = 0;
  private isRunning = false;
  private isAskedAgain = false;
  private loaded: Promise<TextEdits> | undefined;

  constructor(
    private readonly files: SourceFiles,
    private readonly calls: ChangesCalls,
  ) {}

  /** Comparing and editing texts, loaded on first use. */
  edits(): Promise<TextEdits> {
    this.loaded ??= this.files.edits().catch((error) => {
      // It may be loaded later.
      this.loaded = undefined;
      throw new Error(`The text comparison could not be loaded. ${sentenceOf(error)}`);
    });
    return this.loaded;
  }

  /**
   * The file that is shown, with the characters that have parts of it.
   *
   * @param isEdited whether any of these parts has changed
   */
  follow(path: string | undefined, characters: readonly Character[], isEdited: boolean): void {
    const isSame = characters.length === this.characters.length && characters.every((c, i) => c === this.characters[i]);
    if (path === this.path && isSame && isEdited === (this.isComparing || !!this.text || !!this.problem)) return;
    if (path !== this.path || !isEdited) this.drop();
    this.path = path;
    this.characters = characters;
    if (!isEdited) return;
    this.isComparing = true;
    clearTimeout(this.timer);
    this.timer = window.setTimeout(() => void this.compare(), PAUSE);
  }

  private drop(): void {
    clearTimeout(this.timer);
    this.isComparing = false;
    const had = this.text || this.problem;
    this.text = undefined;
    this.problem = undefined;
    if (had) this.calls.onChange();
  }

  private async compare(): Promise<void> {
    if (this.isRunning) {
      this.isAskedAgain = true;
      return;
    }
    this.isRunning = true;
    const { path, characters } = this;
    // Another file, or what was changed was undone.
    const isOver = () => this.path !== path || !this.isComparing;
    try {
      const edits = await this.edits();
      const { hunks, changed } = path === undefined ? { hunks: [] } : await edits.changes(path);
      const text = changed && (await this.shown(hunks, changed.text, changed.map));
      if (isOver()) return;
      this.text = text;
      this.problem = text ? undefined : 'The page was edited, but nothing from this file was changed.';
    } catch (error) {
      if (isOver()) return;
      this.text = undefined;
      this.problem = sentenceOf(error);
    } finally {
      this.isRunning = false;
      const isStale = this.isAskedAgain;
      this.isAskedAgain = false;
      if (isStale) void this.compare();
      else if (this.characters === characters) this.isComparing = false;
    }
    this.calls.onChange();
  }

  private async shown(hunks: readonly LineHunk[], text: Blob, map: SourceMap): Promise<ChangedText> {
    const lines = new LineText(
      text,
      map.index,
      () => this.calls.onText(),
      () => undefined,
    );
    const { count } = map.index;
    // So that lines in view don't blink.
    await Promise.all(this.calls.inView().map((line) => lines.load(Math.min(line, count))));
    return { hunks, map, text, count, line: (line) => lines.get(line) };
  }
}
