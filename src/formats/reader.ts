/**
 * What every format's reader looks like from outside, and the one place where errors thrown inside become data.
 *
 *     const reader = skinReader('wasp.skin');
 *     for (const chunk of chunks) reader.feed(chunk);     // split anywhere, also inside a token or a character
 *     const { value, diagnostics } = reader.end();
 *
 * A reader is grammar-shaped: a generator that suspends when the bytes run out and is resumed by the next chunk. The
 * alternative, a state machine written by hand, hides the grammar; reading the whole file into a string first costs
 * its size twice over and ends at 512 MB.
 */
import type { Diagnostic } from '../model/diagnostic.ts';
import { ParseError } from './report.ts';
import { Tokens } from './tokens.ts';

/** Synchronous; a chunk's bytes are not kept after `feed` returns. */
export interface Reader<T> {
  feed(chunk: Uint8Array): void;
  /** Ends the file. Call it once. */
  end(): ReadResult<T>;
}

export interface ReadResult<T> {
  /** Absent if and only if there is an error. */
  readonly value?: T;
  readonly diagnostics: readonly Diagnostic[];
}

export interface WriteResult {
  readonly text: string;
  /** Infos: names that the format can't hold and that were changed. */
  readonly diagnostics: readonly Diagnostic[];
}

/** What a file is made of, one piece after the other. */
export interface WrittenPieces {
  /** Bytes; of a text in UTF-8. To be gone through once. */
  readonly pieces: Iterable<Uint8Array<ArrayBuffer>>;
  /** Complete when all pieces have been taken. */
  diagnostics(): readonly Diagnostic[];
}

/**
 * A format's grammar: suspends with `yield` when the bytes at hand run out, and returns what was read; undefined only
 * where it reported an error.
 */
export type Grammar<T> = (t: Tokens) => Generator<void, T | undefined, void>;

/** A reader that runs a grammar over the bytes it is fed. */
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
      // Structure that can't be read on; the diagnostic is in the report already.
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

/** Reads a whole file at once. */
export function readWhole<T>(reader: Reader<T>, bytes: Uint8Array | string): ReadResult<T> {
  reader.feed(typeof bytes === 'string' ? new TextEncoder().encode(bytes) : bytes);
  return reader.end();
}
