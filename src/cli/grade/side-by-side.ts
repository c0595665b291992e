/** The numbers that differ first, theirs beside the right ones. */
import type { Comparison, FirstWrong } from '../../teaching/compare/compare.ts';
import type { Targets } from '../../teaching/compare/targets.ts';

/** Rows of numbers, with those of the program that was judged first. */
export interface SideBySide {
  /** `World matrix`, `Position`, `Values`. */
  readonly what: string;
  /** A matrix row by row; a point as one row; of a channel a row for each time. */
  readonly yours: readonly (readonly number[])[];
  readonly marrows: readonly (readonly number[])[];
  /** Times of a channel, in seconds. */
  readonly times?: readonly number[];
}

/** Samples of a channel that are shown, from the first that is wrong. */
const MAX_SAMPLES = 6;

/** Undefined if nothing that was compared differs. */
export function sideBySide(targets: Targets, comparison: Comparison): SideBySide | undefined {
  const { first, frames } = comparison;
  if (!first) return undefined;
  if (first.what === 'channel') return samplesOf(first, targets, comparison);
  const f = frames.findIndex(({ agrees }) => !agrees);
  const [theirs, { ours }] = [targets.frames[f], frames[f]];
  const { index } = first;
  if (first.what === 'joint') {
    if (theirs.world) return ofMatrices('World matrix', theirs.world, ours.world, index);
    if (theirs.local) return ofMatrices('Local matrix', theirs.local, ours.local, index);
    const own = [...ours.world.subarray(16 * index + 12, 16 * index + 15)];
    return theirs.positions && { what: 'Position', yours: [pointAt(theirs.positions, index)], marrows: [own] };
  }
  const [what, yours, marrows] =
    first.what === 'vertex' ? ['Position', theirs.vertices, ours.vertices] : ['Normal', theirs.normals, ours.normals];
  return yours && { what, yours: [pointAt(yours, index)], marrows: [pointAt(marrows, index)] };
}

function samplesOf({ index, time }: FirstWrong, { channels }: Targets, { ourChannels }: Comparison): SideBySide {
  const samples = [...channels.channels.keys()].filter((i) => channels.channels[i] === index);
  const at = samples.findIndex((i) => channels.times[i] === time);
  const shown = samples.slice(Math.max(0, at), Math.max(0, at) + MAX_SAMPLES);
  return {
    what: 'Values',
    yours: shown.map((i) => [channels.values[i]]),
    marrows: shown.map((i) => [ourChannels[i]]),
    times: shown.map((i) => channels.times[i]),
  };
}

function ofMatrices(what: string, yours: Float64Array, marrows: Float64Array, joint: number): SideBySide {
  return { what, yours: rowsAt(yours, joint), marrows: rowsAt(marrows, joint) };
}

/** Without the last row, which is 0 0 0 1. */
function rowsAt(matrices: Float64Array, joint: number): readonly (readonly number[])[] {
  return [0, 1, 2].map((row) => [0, 4, 8, 12].map((column) => matrices[16 * joint + column + row]));
}

function pointAt(points: Float64Array, index: number): readonly number[] {
  return [...points.subarray(3 * index, 3 * index + 3)];
}
