/** Where an input is cut: drawn from its own bytes, so that a reproducer is cut as it was. */
import { randomFrom } from '../attack.ts';
import { below } from './mutate.ts';

/** Up to this size, a file is read byte by byte as well. */
const SINGLE_BYTES = 3000;
/** How often, of those. */
const SHARE_OF_SINGLE = 0.15;

/** Ascending offsets, for one or two readings in pieces. */
export function cutsOf(bytes: Uint8Array): readonly (readonly number[])[] {
  const random = randomFrom(hashOf(bytes));
  const all = [random() < 0.5 ? cutsInside(bytes, random) : cutsAnywhere(bytes.length, random)];
  if (bytes.length <= SINGLE_BYTES && random() < SHARE_OF_SINGLE) all.push(Array.from(bytes.keys()));
  return all;
}

/** FNV-1a, of up to a thousand bytes. */
export function hashOf(bytes: Uint8Array): number {
  const step = Math.ceil(bytes.length / 1000) || 1;
  let hash = 0x811c9dc5 ^ bytes.length;
  for (let i = 0; i < bytes.length; i += step) hash = Math.imul(hash ^ bytes[i], 0x01000193);
  return hash >>> 0;
}

/** Pieces from a byte to the whole. */
function cutsAnywhere(length: number, random: () => number): readonly number[] {
  const most = 2 ** (1 + below(random, Math.ceil(Math.log2(length + 2))));
  const cuts: number[] = [];
  for (let at = below(random, most); at < length; at += 1 + below(random, most)) cuts.push(at);
  return cuts;
}

/** Where it hurts: between CR and LF, in a character of several bytes, before and behind braces, in numbers. */
function cutsInside(bytes: Uint8Array, random: () => number): readonly number[] {
  const share = random() ** 2;
  const cuts: number[] = [];
  for (let at = 1; at < bytes.length; at++) {
    const [before, next] = [bytes[at - 1], bytes[at]];
    const isOdd = before === 13 || next >= 0x80 || isBrace(before) || isBrace(next) || next === 10 || next === 46;
    if (isOdd && random() < share) cuts.push(at);
  }
  return cuts;
}

function isBrace(byte: number): boolean {
  return byte === 0x7b || byte === 0x7d || byte === 0x22;
}
