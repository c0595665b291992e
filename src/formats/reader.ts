/**
 * The interface of every format's reader, and the only place where errors thrown inside become data.
 *
 *     const reader = skinReader('wasp.skin');
 *     for (const chunk of chunks) reader.feed(chunk);     // split anywhere, also inside a token or a character
 *     const { value, diagnostics } = reader.end();
 *
 * A reader follows the grammar: a generator that suspends when the bytes run out and is resumed by the next chunk. A
 * hand-written state machine would hide the grammar; reading the whole file into a string first takes twice its size
 * and is limited to 512 MB.
 */
import type { Diagnostic } from '../model/diagnostic.ts';
import { ParseError, Report } from './report.ts';
import { Tokens } from './tokens.ts';

/** Synchronous; a chunk's bytes are not retained after `feed` returns. */
export interface Reader<T> {
  feed(chunk: Uint8Array): void;
  /** Ends the file. Call once. */
  end(): ReadResult<T>;
}

/** The result of reading a file: its content, unless there are errors, and what was found on the way. */
export interface ReadResult<T> {
  /** Absent if and only if there is an error. */
  readonly value?: T;
  readonly diagnostics: readonly Diagnostic[];
}

/** The result of writing a text file. */
export interface WriteResult {
  readonly text: string;
  /** Infos: names that had to be changed for the format. */
  readonly diagnostics: readonly Diagnostic[];
}

/** A file in consecutive pieces. */
export interface WrittenPieces {
  /** Bytes; UTF-8 for text. Can be iterated once. */
  readonly pieces: Iterable<Uint8Array<ArrayBuffer>>;
  /** Complete once all pieces are consumed. */
  diagnostics(): readonly Diagnostic[];
}

/**
 * A format's grammar: suspends with `yield` when the available bytes run out, and returns the result; undefined only if
 * it reported an error.
 */
export type Grammar<T> = (t: Tokens) => Generator<void, T | undefined, void>;

/** A reader that runs a grammar over the bytes fed to it. */
export function grammarReader<T>(fileName: string, grammar: Grammar<T>): Reader<T> {
  const tokens = new Tokens(fileName);
  const reading = grammar(tokens);
  let value: T | undefined;
  let done = false;
  const resume = () => {
    if (done) return;
    try {
      const step = reading.next();
      if (step.done) {
        done = true;
        value = step.value;
      }
    } catch (error) {
      // Nothing more can be read; the diagnostic is already reported.
      if (!(error instanceof ParseError)) throw error;
      done = true;
    }
  };
  return {
    feed: (chunk) => tokens.feed(chunk, resume),
    end: () => {
      tokens.finish(resume);
      const { report } = tokens;
      const diagnostics = report.finish();
      return report.hasErrors || value === undefined ? { diagnostics } : { value, diagnostics };
    },
  };
}

/**
 * A reader that decodes all bytes of a file together, as most binary formats need.
 * @param decode must check every length before it reads, and may only throw a `ParseError`. Returns undefined only if it
 * reported an error.
 */
export function bytesReader<T>(
  fileName: string,
  decode: (bytes: Uint8Array<ArrayBuffer>, report: Report) => T | undefined,
): Reader<T> {
  const chunks: Uint8Array<ArrayBuffer>[] = [];
  return {
    feed: (chunk) => void chunks.push(chunk.slice()),
    end: () => readBytes(fileName, joined(chunks), decode),
  };
}

/** Reads the bytes of a whole file, without a copy of them. @param decode as of `bytesReader` */
export function readBytes<T>(
  fileName: string,
  bytes: Uint8Array<ArrayBuffer>,
  decode: (bytes: Uint8Array<ArrayBuffer>, report: Report) => T | undefined,
): ReadResult<T> {
  const report = new Report(fileName);
  let value: T | undefined;
  try {
    value = decode(bytes, report);
  } catch (error) {
    if (!(error instanceof ParseError)) throw error;
  }
  const diagnostics = report.finish();
  return report.hasErrors || value === undefined ? { diagnostics } : { value, diagnostics };
}

/**
 * A reader that is chosen by the start of the file, however this is cut.
 *
 * @param choose gets the first `headBytes` bytes, or more of them, or all of a shorter file
 */
export function readerByHead<T>(headBytes: number, choose: (head: Uint8Array) => Reader<T>): Reader<T> {
  let chosen: Reader<T> | undefined;
  let head: Uint8Array | undefined;
  let length = 0;
  const start = (bytes: Uint8Array) => {
    chosen = choose(bytes);
    chosen.feed(bytes);
    return chosen;
  };
  return {
    feed(chunk) {
      if (chosen) chosen.feed(chunk);
      // A file in one piece is handed over as it is.
      else if (length === 0 && chunk.length >= headBytes) start(chunk);
      else {
        head ??= new Uint8Array(headBytes);
        const taken = chunk.subarray(0, headBytes - length);
        head.set(taken, length);
        length += taken.length;
        if (length < headBytes) return;
        const reader = start(head);
        if (chunk.length > taken.length) reader.feed(chunk.subarray(taken.length));
      }
    },
    end: () => (chosen ?? start(head?.subarray(0, length) ?? new Uint8Array(0))).end(),
  };
}

function joined(chunks: readonly Uint8Array<ArrayBuffer>[]): Uint8Array<ArrayBuffer> {
  if (chunks.length === 1) return chunks[0];
  const bytes = new Uint8Array(chunks.reduce((sum, { length }) => sum + length, 0));
  let at = 0;
  for (const chunk of chunks) {
    bytes.set(chunk, at);
    at += chunk.length;
  }
  return bytes;
}

/** Reads a whole file at once. */
export function readWhole<T>(reader: Reader<T>, bytes: Uint8Array | string): ReadResult<T> {
  reader.feed(typeof bytes === 'string' ? new TextEncoder().encode(bytes) : bytes);
  return reader.end();
}
