/**
 * Problems found while reading a file: up to 100 of each severity, the rest only counted; equal ones about unknown
 * tokens are merged with a count. Without limits, a hundred megabytes with decimal commas would give ten million
 * messages.
 */

import { type Diagnostic, type Excerpt, MAX_KEPT, moreThanKept, type Severity } from '../model/diagnostic.ts';
import { cutMessage } from '../model/names/cut-text.ts';
import { UserError } from '../model/user-error.ts';
import { excerptOf, type Place } from './places.ts';

/** Thrown inside a reader when nothing after this place can be read; only the readers of `reader.ts` catch it. */
export class ParseError extends UserError {
  override readonly name = 'ParseError';
}

interface Entry {
  readonly severity: Severity;
  readonly code: string;
  readonly message: string;
  readonly place: Place;
  readonly assumed: string | undefined;
  /** Number of occurrences. */
  count: number;
}

/** Collects the diagnostics of one file, up to `MAX_KEPT` per severity. */
export class Report {
  private readonly entries: Entry[] = [];
  private readonly folded = new Map<string, Entry>();
  private readonly counts: Record<Severity, number> = { error: 0, warning: 0, info: 0 };

  constructor(private readonly file: string) {}

  /** Whether an error was reported so far, so that the file won't be loaded. */
  get hasErrors(): boolean {
    return this.errorCount > 0;
  }

  /** So far; to check whether what was just read was valid. */
  get errorCount(): number {
    return this.counts.error;
  }

  /** Whether another one of this severity would be kept, so that its place is worth finding. */
  hasRoom(severity: Severity): boolean {
    return this.counts[severity] < MAX_KEPT;
  }

  /**
   * Reports an error: the file won't be loaded, though reading may continue.
   * @param code stable, lower case, such as `number-expected`
   */
  error(code: string, message: string, place: Place): void {
    this.add('error', code, message, place);
  }

  /**
   * Reports a warning.
   * @param assumed what was used instead: "used 3"
   */
  warn(code: string, message: string, place: Place, assumed?: string): void {
    this.add('warning', code, message, place, assumed);
  }

  /**
   * Reports something worth knowing.
   * @param assumed what was used instead, if anything
   */
  info(code: string, message: string, place: Place, assumed?: string): void {
    this.add('info', code, message, place, assumed);
  }

  /** Whether an equal warning exists, with which this one is then counted. */
  foldsInto(code: string, key: string): boolean {
    const earlier = this.folded.get(`${code} ${key}`);
    if (earlier) earlier.count++;
    return earlier !== undefined;
  }

  /** A warning that may occur often in a file; call `foldsInto` first. Equal ones have the same `key`. */
  warnFolded(code: string, key: string, message: string, place: Place, assumed: string): void {
    const entry = this.add('warning', code, message, place, assumed);
    if (entry) this.folded.set(`${code} ${key}`, entry);
  }

  private add(severity: Severity, code: string, message: string, place: Place, assumed?: string): Entry | undefined {
    if (++this.counts[severity] > MAX_KEPT) return undefined;
    const used = assumed === undefined ? undefined : cutMessage(assumed);
    const entry: Entry = { severity, code, message: cutMessage(message), place, assumed: used, count: 1 };
    this.entries.push(entry);
    return entry;
  }

  /**
   * All kept ones from the top of the file to the bottom, then those without a place, then the counts of the others.
   */
  finish(): Diagnostic[] {
    const line = (d: Diagnostic) => d.line || Number.POSITIVE_INFINITY;
    const all = this.entries.map((entry) => this.diagnostic(entry));
    all.sort((a, b) => (line(a) === line(b) ? a.column - b.column : line(a) - line(b)));
    const { error, warning, info } = this.counts;
    return [
      ...all,
      ...moreThanKept('error', error, this.file),
      ...moreThanKept('warning', warning, this.file),
      ...moreThanKept('info', info, this.file),
    ];
  }

  private diagnostic({ severity, code, message, place, assumed, count }: Entry): Diagnostic {
    const excerpt: Excerpt | undefined = excerptOf(place);
    return {
      severity,
      code,
      message: count > 1 ? `${message} (${count} times in this file)` : message,
      file: this.file,
      line: place.line,
      column: place.column,
      ...(assumed === undefined ? {} : { assumed }),
      ...(excerpt === undefined ? {} : { excerpt }),
    };
  }
}
