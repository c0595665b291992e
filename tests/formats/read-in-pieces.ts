/** Reading helpers for the format tests: any format, in one piece or in many. */

import { formatOf } from '../../src/files/readers.ts';
import { isWorthDiagnosing } from '../../src/formats/diagnose/diagnose.ts';
import type { ReadResult } from '../../src/formats/reader.ts';
import type { FileContent } from '../../src/model/files.ts';

export function bytesOf(text: string): Uint8Array {
  return new TextEncoder().encode(text);
}

/** Reads a file of the format that its name tells, in one piece. */
export function read(fileName: string, bytes: Uint8Array | string): ReadResult<FileContent> {
  return readInPieces(fileName, typeof bytes === 'string' ? bytesOf(bytes) : bytes, []);
}

/** The same, cut at the given offsets; each piece is overwritten once it is read, as a stream may do. */
export function readInPieces(fileName: string, bytes: Uint8Array, cuts: readonly number[]): ReadResult<FileContent> {
  const format = formatOf(fileName);
  if (!format) throw new Error(`${fileName} is of no known format`);
  const reader = format.reader(fileName);
  let from = 0;
  for (const cut of [...cuts].sort((a, b) => a - b).concat(bytes.length)) {
    const piece = bytes.slice(from, cut);
    reader.feed(piece);
    piece.fill(0x7b);
    from = Math.max(from, cut);
  }
  return reader.end();
}

/** The same, with its problems where they really are, as the page and the command tell them. */
export function readAsOpened(
  fileName: string,
  bytes: Uint8Array | string,
  cuts: readonly number[] = [],
): ReadResult<FileContent> {
  const whole = typeof bytes === 'string' ? bytesOf(bytes) : bytes;
  const result = readInPieces(fileName, whole, cuts);
  const { diagnose } = formatOf(fileName) ?? {};
  if (!diagnose || !isWorthDiagnosing(result.diagnostics, whole.length)) return result;
  return { ...result, diagnostics: diagnose(fileName, whole, result.diagnostics) };
}

/** `severity code line:column` of each diagnostic. */
export function told({ diagnostics }: ReadResult<unknown>): string[] {
  return diagnostics.map((d) => `${d.severity} ${d.code} ${d.line}:${d.column}`);
}
