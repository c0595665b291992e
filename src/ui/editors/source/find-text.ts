/** Search in a file's bytes, a piece at a time, so that a large one needs no memory and no long task. */
import { type LineIndex, lastUpTo } from '../../../model/source-map.ts';
import type { Bytes } from './line-text.ts';

const PIECE_BYTES = 1 << 21;

/**
 * The line of the next occurrence of a text after a line, continuing at the start of the file; undefined if there is
 * none. Upper and lower case of ASCII are the same.
 *
 * @param after a line, from 1; 0 to begin with the first one
 */
export async function findLine(
  bytes: Bytes,
  index: LineIndex,
  text: string,
  after: number,
  signal: AbortSignal,
): Promise<number | undefined> {
  const wanted = latin(new TextEncoder().encode(text));
  if (wanted === '') return undefined;
  const start = after >= index.count ? index.bytes : await offsetOfLine(bytes, index, after + 1);
  const found =
    (await findIn(bytes, wanted, start, index.bytes, signal)) ??
    (await findIn(bytes, wanted, 0, Math.min(index.bytes, start + wanted.length), signal));
  return found === undefined ? undefined : await lineOfOffset(bytes, index, found);
}

/** The offset of the first occurrence that begins and ends in [from, to). */
async function findIn(
  bytes: Bytes,
  wanted: string,
  from: number,
  to: number,
  signal: AbortSignal,
): Promise<number | undefined> {
  for (let at = from; at < to; at += PIECE_BYTES) {
    const stop = Math.min(to, at + PIECE_BYTES + wanted.length - 1);
    const piece = latin(new Uint8Array(await bytes.slice(at, stop).arrayBuffer()));
    signal.throwIfAborted();
    const found = piece.indexOf(wanted);
    if (found >= 0) return at + found;
  }
  return undefined;
}

async function lineOfOffset(bytes: Bytes, index: LineIndex, offset: number): Promise<number> {
  const entry = lastUpTo(index.offsets, offset);
  const before = latin(new Uint8Array(await bytes.slice(index.offsets[entry], offset).arrayBuffer()));
  return index.lines[entry] + (before.match(/\r*\n|\r/g)?.length ?? 0);
}

async function offsetOfLine(bytes: Bytes, index: LineIndex, line: number): Promise<number> {
  const entry = lastUpTo(index.lines, line);
  const from = index.offsets[entry];
  const to = index.offsets[entry + 1] ?? index.bytes;
  let left = line - index.lines[entry];
  if (left === 0) return from;
  const text = latin(new Uint8Array(await bytes.slice(from, to).arrayBuffer()));
  for (const end of text.matchAll(/\r*\n|\r/g)) if (--left === 0) return from + end.index + end[0].length;
  return to;
}

/** A character for each byte, in lower case. */
function latin(bytes: Uint8Array): string {
  return new TextDecoder('latin1').decode(bytes).replace(/[A-Z]+/g, (word) => word.toLowerCase());
}
