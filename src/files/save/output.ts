/** A file to be written, in any format; what `files/save` gives to page, command and scripts. */
import type { Diagnostic } from '../../model/diagnostic.ts';
import { writeFile } from '../writers.ts';
import type { Copy } from './copies.ts';

/** Generated lazily, while its pieces are consumed. */
export interface Output {
  readonly name: string;
  pieces(): Iterable<FilePiece>;
  /** Names changed for the format and the like. Complete once all pieces are consumed. */
  diagnostics(): readonly Diagnostic[];
}

/** Text, or bytes: of a text in UTF-8. */
export type FilePiece = string | Uint8Array<ArrayBuffer>;

/** A text file that is ready to be written. */
export interface SavedFile {
  readonly name: string;
  readonly text: string;
  readonly diagnostics: readonly Diagnostic[];
}

/**
 * A file in the format of its name.
 * @throws Error while its pieces are consumed, if nothing writes such content
 */
export function outputOf({ name, content, diagnostics = [] }: Copy): Output {
  let written: readonly Diagnostic[] = [];
  return {
    name,
    *pieces() {
      const result = writeFile(content(), name);
      if (!result) throw new Error(`There is no format for ${name}.`);
      if ('text' in result) {
        written = result.diagnostics;
        yield result.text;
      } else {
        yield* result.pieces;
        written = result.diagnostics();
      }
    },
    diagnostics: () => [...diagnostics.map((d) => ({ ...d, file: name })), ...written],
  };
}

/** The whole file as one text. */
export function savedFileOf(output: Output): SavedFile {
  const decoder = new TextDecoder();
  let text = '';
  for (const piece of output.pieces()) {
    text += typeof piece === 'string' ? piece : decoder.decode(piece, { stream: true });
  }
  return { name: output.name, text, diagnostics: output.diagnostics() };
}
