/** A file to be written, in any format; what `project/save` gives to page, command and scripts. */
import { writeBvhPieces } from '../../formats/bvh/write.ts';
import type { Diagnostic } from '../../model/diagnostic.ts';
import type { FileContent } from '../../model/files.ts';
import type { NamedFigure } from './character-files.ts';
import { writeFile } from './writers.ts';

/** Generated lazily, while its pieces are consumed. */
export interface Output {
  readonly name: string;
  pieces(): Iterable<FilePiece>;
  /** Names changed for the format and the like. Complete once all pieces are consumed. */
  diagnostics(): readonly Diagnostic[];
}

/** Text, or bytes in UTF-8. */
export type FilePiece = string | Uint8Array<ArrayBuffer>;

export interface SavedFile {
  readonly name: string;
  readonly text: string;
  readonly diagnostics: readonly Diagnostic[];
}

/** A file written as a single text, of any content except textures. */
export function textOutput(name: string, content: () => FileContent): Output {
  let written: readonly Diagnostic[] = [];
  return {
    name,
    *pieces() {
      const result = writeFile(content(), name);
      if (!result) throw new Error(`There is no format for ${name}.`);
      written = result.diagnostics;
      yield result.text;
    },
    diagnostics: () => written,
  };
}

/** Several figures with the same frames as one file. */
export function bvhOutput(name: string, figures: readonly NamedFigure[]): Output {
  let written: readonly Diagnostic[] = [];
  return {
    name,
    *pieces() {
      const { pieces, diagnostics } = writeBvhPieces(
        figures.map(({ figure }) => figure),
        name,
      );
      yield* pieces;
      written = diagnostics();
    },
    diagnostics: () => [
      ...figures.flatMap((figure) => figure.diagnostics.map((d) => ({ ...d, file: name }))),
      ...written,
    ],
  };
}

/** The whole file as one text. */
export function textOf(output: Output): SavedFile {
  const decoder = new TextDecoder();
  let text = '';
  for (const piece of output.pieces()) {
    text += typeof piece === 'string' ? piece : decoder.decode(piece, { stream: true });
  }
  return { name: output.name, text, diagnostics: output.diagnostics() };
}
