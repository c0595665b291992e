/** Locators: they find the parts of a format in its tokens. Files with errors are read as far as they make sense. */
import type { SourceMark, SourceRows } from '../../model/source-map.ts';

/** The parts found in a file. */
export interface Located {
  readonly marks: SourceMark[];
  readonly rows: SourceRows[];
}

/** Receives the tokens of a file and marks the lines of its parts. Lines count from 1. */
export interface Locator {
  /**
   * Within rows, where words are values like numbers: all tokens but braces come by `value`. The scanner then makes no
   * strings.
   */
  readonly inRows: boolean;
  /** @param text in lower case; cut if it is very long */
  word(text: string, line: number): void;
  /** A number, or anything in rows. `read` returns its value: NaN for a word. */
  value(line: number, read: () => number): void;
  open(line: number): void;
  close(line: number): void;
  /** @param line the last one */
  end(line: number): void;
}
