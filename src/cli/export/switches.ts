/** Switches that say which takes are meant and what is done to them, of `export` and `convert`. */
import type { Crop, TakeOptions } from '../../dataset/take.ts';
import { type Arguments, numberOf, type OptionTypes, UsageError } from '../arguments.ts';
import type { TargetFiles } from './target.ts';

/** What is done to takes before they are written. */
export const EDITING = { retarget: 'value', map: 'value', space: 'value', mirror: 'flag', crop: 'value' } as const;

/** Which takes are meant, and how the work is shared. */
export const SHARING = {
  only: 'value',
  'files-from': 'value',
  shard: 'value',
  jobs: 'value',
  resume: 'flag',
  'no-times': 'flag',
} as const;

/** The first of these options that is given; undefined if none is. */
export function firstGiven(given: Arguments, types: OptionTypes): string | undefined {
  return Object.keys(types).find((name) =>
    types[name] === 'flag' ? given.flag(name) : given.value(name) !== undefined,
  );
}

/** What takes are edited by, with the target as its files. @throws UsageError */
export function editingOf(given: Arguments): TargetFiles & Pick<TakeOptions, 'crop' | 'isMirrored'> {
  const [map, space] = ['map', 'space'].map((name) => given.value(name));
  const retarget = given.values('retarget');
  if (map !== undefined && retarget.length === 0) throw new UsageError('--map needs --retarget.');
  const crop = cropOf(given);
  return {
    ...(retarget.length > 0 && { retarget }),
    ...(map !== undefined && { map }),
    ...(space !== undefined && { space }),
    ...(crop && { crop }),
    isMirrored: given.flag('mirror'),
  };
}

/** One of several processes that share a list: number `index`, from 1, of `count`. */
export interface Shard {
  readonly index: number;
  readonly count: number;
}

/** @throws UsageError unless it is greater than 0 */
export function positive(given: Arguments, name: string): number | undefined {
  const text = given.value(name);
  const value = text === undefined ? undefined : numberOf(name, text);
  if (value !== undefined && !(value > 0)) throw new UsageError(`--${name} must be greater than 0, found ${value}.`);
  return value;
}

/** `--crop FROM,TO`: seconds, either of which may be left out. @throws UsageError */
function cropOf(given: Arguments): Crop | undefined {
  const text = given.value('crop');
  if (text === undefined) return undefined;
  const parts = text.split(',');
  if (parts.length !== 2) throw new UsageError(`--crop takes two times, FROM,TO, in seconds; found "${text}".`);
  const [from, to] = parts.map((part) => (part.trim() === '' ? undefined : numberOf('crop', part)));
  if (from !== undefined && to !== undefined && from > to) {
    throw new UsageError(`--crop takes an earlier and a later time, found ${from} and ${to}.`);
  }
  return { ...(from !== undefined && { from }), ...(to !== undefined && { to }) };
}

/** `--shard i/n`. @throws UsageError */
export function shardOf(given: Arguments): Shard | undefined {
  const text = given.value('shard');
  if (text === undefined) return undefined;
  const [, i, n] = /^(\d+)\/(\d+)$/.exec(text.trim()) ?? [];
  const [index, count] = [Number(i), Number(n)];
  if (!(index >= 1 && index <= count)) {
    throw new UsageError(`--shard takes a part and their number, 1/4 to 4/4 for four; found "${text}".`);
  }
  return { index, count };
}

/** More than machines have cores; each takes some 50 MB. */
const MAX_THREADS = 512;

/** `--jobs N`: number of threads. @throws UsageError */
export function jobsOf(given: Arguments): number | undefined {
  const jobs = positive(given, 'jobs');
  if (jobs !== undefined && jobs > MAX_THREADS) {
    throw new UsageError(`--jobs takes a number up to ${MAX_THREADS}, found ${jobs}.`);
  }
  if (jobs !== undefined && !Number.isInteger(jobs)) throw new UsageError(`--jobs takes a whole number, not ${jobs}.`);
  return jobs;
}

/** The items of one part: every n-th, so that large and small ones are spread over all. */
export function inShard<T>(items: readonly T[], shard: Shard | undefined): readonly T[] {
  return shard ? items.filter((_, i) => i % shard.count === shard.index - 1) : items;
}
