/** Errors of FBX files: a binary file has byte offsets, a text has lines. */
import { NO_PLACE, type Place } from '../../formats/places.ts';
import { ParseError, type Report } from '../../formats/report.ts';
import { Budget } from '../budget.ts';

const SHOWN = 800;
const LF = 10;

/** Reports problems of one file at offsets of its bytes. */
export class FbxReport {
  /** Budget of all that is read from the file. */
  readonly budget: Budget;

  constructor(
    private readonly report: Report,
    private readonly bytes: Uint8Array,
    /** Whether offsets are told as lines. */
    private readonly isText: boolean,
  ) {
    this.budget = new Budget(bytes.length, (message) => {
      report.error('file-too-large', message, NO_PLACE);
      throw new ParseError(message);
    });
  }

  /** Reports an error after which nothing can be read. */
  fail(code: string, message: string, offset: number): never {
    this.error(code, message, offset);
    throw new ParseError(message);
  }

  /** Reports an error at a byte offset of the file. */
  error(code: string, message: string, offset: number): void {
    this.report.error(code, this.located(message, offset), this.placeOf(offset));
  }

  /**
   * Reports a warning at a byte offset of the file.
   * @param assumed what was done instead
   */
  warn(code: string, message: string, offset: number, assumed: string): void {
    if (this.report.hasRoom('warning')) {
      this.report.warn(code, this.located(message, offset), this.placeOf(offset), assumed);
    }
  }

  /** About the file as a whole. */
  info(code: string, message: string): void {
    this.report.info(code, message, NO_PLACE);
  }

  private located(message: string, offset: number): string {
    return this.isText ? message : `${message.replace(/\.$/, '')}, at byte ${offset}.`;
  }

  private placeOf(offset: number): Place {
    if (!this.isText) return NO_PLACE;
    const { bytes } = this;
    const at = Math.min(offset, bytes.length);
    const start = at > 0 ? bytes.lastIndexOf(LF, at - 1) + 1 : 0;
    let line = 1;
    for (let i = bytes.indexOf(LF); i >= 0 && i < start; i = bytes.indexOf(LF, i + 1)) line++;
    const end = bytes.indexOf(LF, at);
    return {
      line,
      column: at - start + 1,
      before: bytes.slice(Math.max(start, at - SHOWN), at),
      after: bytes.slice(at, Math.min(end < 0 ? bytes.length : end, at + SHOWN)),
    };
  }
}
