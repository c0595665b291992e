/**
 * Which pixels of a row have keys, whether these are selected, and where its channels are constant. The cost depends on
 * the width of the dope sheet, not on the take: a channel with far more visible keys than pixels is searched from one
 * pixel's edge to the next (like the scrubber's `key-buckets.ts`).
 */
import type { CompiledTake } from '../../evaluate/compiled-take.ts';
import { firstNotBelow } from '../../math/search.ts';
import type { ChannelKeys } from '../../model/session.ts';
import { type Channel, keysOf } from '../../model/takes/take.ts';
import { indicesIn } from './row-keys.ts';
import { countNotAbove } from './same-time.ts';

/** Bits of a pixel's mark: a pixel with both has keys of which only some are selected. */
export const PLAIN = 1;
/** Bit of a pixel with a selected key. */
export const SELECTED = 2;

/** Keys per pixel above which a channel is searched. */
const DENSE = 4;

/** The pixels to examine. */
export interface PixelSpan {
  /** Take time at the left edge of pixel 0, seconds. */
  readonly from: number;
  /** Greater than 0. */
  readonly secondsPerPixel: number;
}

/**
 * Marks the pixels of a row that have keys, and those with selected ones.
 * @param out one entry per pixel; set to the bits PLAIN and SELECTED, or 0
 */
export function markKeys(
  channels: readonly Channel[],
  of: readonly number[],
  selected: readonly ChannelKeys[],
  span: PixelSpan,
  out: Uint8Array,
): void {
  out.fill(0);
  for (const channel of of) markChannel(keysOf(channels[channel]).times, indicesIn(selected, channel), span, out);
}

const NONE: readonly number[] = [];

function markChannel(
  times: Float64Array,
  selected: readonly number[] = NONE,
  { from, secondsPerPixel }: PixelSpan,
  out: Uint8Array,
): void {
  const pixels = out.length;
  let index = firstNotBelow(times, from);
  const end = firstNotBelow(times, from + pixels * secondsPerPixel);
  const dense = end - index > DENSE * pixels;
  let next = firstNotBelow(selected, index);
  while (index < end) {
    const pixel = Math.min(pixels - 1, Math.floor((times[index] - from) / secondsPerPixel));
    // The keys of one pixel are index … after.
    const after = dense
      ? Math.max(index + 1, firstTimeFrom(times, index, end, from + (pixel + 1) * secondsPerPixel))
      : index + 1;
    const nextAfter = selected[next] < after ? firstNotBelow(selected, after, next) : next;
    const chosen = nextAfter - next;
    if (chosen > 0) out[pixel] |= SELECTED;
    if (chosen < after - index) out[pixel] |= PLAIN;
    next = nextAfter;
    index = after;
  }
}

/** Index of the first time at or after `limit`, within low … high. */
function firstTimeFrom(times: Float64Array, low: number, high: number, limit: number): number {
  let from = low;
  let to = high;
  while (from < to) {
    const middle = (from + to) >>> 1;
    if (times[middle] < limit) from = middle + 1;
    else to = middle;
  }
  return from;
}

/** In `moves`: nothing changes here, although there are keys on both sides. */
export const STILL = 0;

/**
 * Marks with 1 the pixels in which any of the channels changes between its keys; the others are constant. Exact: a span
 * is constant if its cubic is.
 *
 * @returns first and last pixel between which the channels have keys, or undefined if no channel has two
 */
export function markMoves(
  compiled: CompiledTake,
  of: readonly number[],
  { from, secondsPerPixel }: PixelSpan,
  moves: Uint8Array,
): [number, number] | undefined {
  moves.fill(STILL);
  const pixels = moves.length;
  const pixelOf = (time: number) => Math.floor((time - from) / secondsPerPixel);
  let first = Infinity;
  let last = -Infinity;
  for (const channel of of) {
    const begin = compiled.firstKey[channel];
    const times = compiled.times.subarray(begin, compiled.firstKey[channel + 1]);
    if (times.length < 2) continue;
    first = Math.min(first, pixelOf(times[0]));
    last = Math.max(last, pixelOf(times[times.length - 1]));
    // Every span that is partly visible.
    let key = Math.max(0, countNotAbove(times, from) - 1);
    const end = Math.min(times.length - 1, firstNotBelow(times, from + pixels * secondsPerPixel));
    // Spans shorter than two pixels are too short for a bar.
    if (2 * (end - key) > pixels) {
      moves.fill(1, Math.max(0, pixelOf(times[key])), clampTo(pixelOf(times[end]) + 1, pixels));
      continue;
    }
    for (; key < end; key++) {
      const at = 4 * (begin + key);
      const { cubics } = compiled;
      if (cubics[at + 1] === 0 && cubics[at + 2] === 0 && cubics[at + 3] === 0) {
        // A step at the span's end is a change there, which the two keys show.
        if (cubics[at] === cubics[at + 4]) continue;
      }
      moves.fill(1, clampTo(pixelOf(times[key]), pixels), clampTo(pixelOf(times[key + 1]), pixels));
    }
  }
  return first < last ? [first, last] : undefined;
}

function clampTo(pixel: number, pixels: number): number {
  return Math.max(0, Math.min(pixels, pixel));
}
