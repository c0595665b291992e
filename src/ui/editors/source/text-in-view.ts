/** The text in view: a file as it came, or with what the page changed in it. */
import type { SourceMap } from '../../../model/source-map.ts';
import type { LineHunk } from '../../../model/text-changes.ts';
import type { ShownLine } from './line-text.ts';
import type { OpenedSource } from './opened-source.ts';
import type { ChangedText, TextChanges } from './text-changes.ts';

const NO_HUNKS: readonly LineHunk[] = [];

/** A text, either way. */
export interface ShownText {
  /** Undefined until it is read. */
  readonly map: SourceMap | undefined;
  readonly text: Blob | undefined;
  readonly count: number;
  /** A line, from 1; undefined while it is read. */
  line(line: number): ShownLine | undefined;
}

export class TextInView {
  /** The file as it came. */
  opened: OpenedSource | undefined;
  /** Whether the changes are shown once they are known. */
  showsChanges = true;

  constructor(private readonly changes: TextChanges) {}

  /** The text with the changes, if it is shown. */
  get changed(): ChangedText | undefined {
    return this.showsChanges ? this.changes.text : undefined;
  }

  get shown(): ShownText | undefined {
    return this.changed ?? this.opened;
  }

  /** The changes that are shown. */
  get hunks(): readonly LineHunk[] {
    return this.changed?.hunks ?? NO_HUNKS;
  }
}
