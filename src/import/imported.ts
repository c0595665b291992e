/** Input and result of reading a file of another program: its reader may wait for other files and for decoders. */

import { type Diagnostic, withoutPlace } from '../model/diagnostic.ts';
import type { SourceFile } from '../model/files.ts';
import { UserError } from '../model/user-error.ts';
import type { Scene } from './scene.ts';

/** A file of another program, and how its reader gets those beside it. */
export interface Import {
  /** Without folders. */
  readonly fileName: string;
  readonly bytes: Uint8Array<ArrayBuffer>;
  /**
   * A file that this one names, by its path relative to it, `/` between folders; undefined if it was not given.
   */
  beside(path: string): Promise<Beside | undefined>;
  /** Names of the files of its folder with an extension, which it may belong to; absent: none are known. */
  near?(extension: string): readonly string[];
}

/** A file that another one names. */
export interface Beside {
  readonly source: SourceFile;
  readonly bytes: Uint8Array<ArrayBuffer>;
}

/** The result of reading a file of another program. */
export interface Imported {
  /** Absent if and only if there is an error. */
  readonly scene?: Scene;
  /** Other files that were used. */
  readonly beside?: readonly SourceFile[];
  readonly diagnostics: readonly Diagnostic[];
}

/** Thrown inside a reader when nothing of the file can be used; what it says is told as an error. */
export class ImportError extends UserError {
  override readonly name = 'ImportError';
  constructor(
    /** As of a diagnostic. */
    readonly code: string,
    message: string,
  ) {
    super(message);
  }
}

/** Collects what is wrong with or lost of a file, while it is read. Each sentence is told once. */
export class Remarks {
  private readonly told = new Map<string, Diagnostic>();
  private readonly lost = new Set<string>();

  constructor(private readonly fileName: string) {}

  /**
   * Adds a warning, once.
   * @param assumed what is used instead
   */
  warn(code: string, message: string, assumed: string): void {
    const key = `${code} ${message}`;
    if (!this.told.has(key)) this.told.set(key, withoutPlace('warning', code, message, this.fileName, assumed));
  }

  /**
   * Adds something worth knowing, once.
   * @param assumed what is used instead, if anything
   */
  tell(code: string, message: string, assumed?: string): void {
    const key = `${code} ${message}`;
    if (!this.told.has(key)) this.told.set(key, withoutPlace('info', code, message, this.fileName, assumed));
  }

  /** Names something that a character can't hold: "2 cameras". */
  leaveOut(what: string): void {
    this.lost.add(what);
  }

  /** A thrown error as a diagnostic. */
  error({ code, message }: ImportError): Diagnostic {
    return withoutPlace('error', code, message, this.fileName);
  }

  /** All of it; what is left out in one message. */
  finish(): readonly Diagnostic[] {
    const shown = [...this.told.values()].slice(0, MAX_SHOWN);
    const more = this.told.size - shown.length;
    if (more > 0) shown.push(withoutPlace('warning', 'more-warnings', `And ${more} more warnings.`, this.fileName));
    if (this.lost.size === 0) return shown;
    const lost = [...this.lost].slice(0, MAX_SHOWN);
    if (lost.length < this.lost.size) lost.push(`${this.lost.size - lost.length} more`);
    const message = `Not read: ${lost.join(', ')}.`;
    return [...shown, withoutPlace('info', 'content-left-out', message, this.fileName, 'left out')];
  }
}

const MAX_SHOWN = 20;

/** "1 camera", "2 cameras". */
export function counted(count: number, one: string, many = `${one}s`): string {
  return `${count} ${count === 1 ? one : many}`;
}
