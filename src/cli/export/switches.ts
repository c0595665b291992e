/** Options that say which takes are meant and what is done to them, of `export` and `convert`. */
import type { Crop, TakeOptions } from '../../dataset/take.ts';
import { type Kind, number, positive, text, whole } from '../options/kinds.ts';
import { flag, type Options, type OptionValues, option, section } from '../options/option.ts';
import type { TargetFiles } from './target.ts';

const SECONDS = number('T');

/** Seconds, of which either may be left out. */
const CROP: Kind<Crop> = {
  placeholder: 'FROM,TO',
  what: 'two times, FROM,TO, in seconds, the earlier one first',
  read(given, misfit) {
    const parts = given.split(',');
    if (parts.length !== 2) return misfit();
    const [from, to] = parts.map((part) => (part.trim() === '' ? undefined : SECONDS.read(part, () => misfit())));
    if (from !== undefined && to !== undefined && from > to) return misfit();
    return { ...(from !== undefined && { from }), ...(to !== undefined && { to }) };
  },
};

/** One of several processes that share a list: number `index`, from 1, of `count`. */
export interface Shard {
  readonly index: number;
  readonly count: number;
}

const SHARD: Kind<Shard> = {
  placeholder: 'I/N',
  what: 'a part and the number of parts, 1/4 to 4/4 for four',
  read(given, misfit) {
    const [, i, n] = /^(\d+)\/(\d+)$/.exec(given.trim()) ?? [];
    const [index, count] = [Number(i), Number(n)];
    return index >= 1 && index <= count ? { index, count } : misfit();
  },
};

/** More than machines have cores; each takes some 50 MB. */
const MAX_THREADS = 512;

/** What is done to takes before they are written. */
export const EDITING = section('Changes made to takes before they are written', {
  retarget: option(
    text('FILE', 'a file'),
    'Retargets takes to the character in this file, folder or zip; if it is in several files, name each.',
    { isRepeated: true },
  ),
  map: option(
    text('FILE', 'a file'),
    'Pairs joints for retargeting as this file says, one "target,source" per line, instead of by name and shape.',
    { needs: 'retarget' },
  ),
  rate: option(
    positive('N'),
    'Takes files that state no frame rate at N frames per second, instead of the usual 30 or 120; the frames stay the same.',
  ),
  space: option(
    text('FILE', 'a file'),
    'Uses the unit, up axis and ground of this file for all takes of its skeleton instead of guessing them for each take.',
  ),
  mirror: flag('Swaps left and right, before retargeting.'),
  crop: option(CROP, 'Keeps this part of each take, in seconds; either end may be left out.'),
});

/** Which takes are meant, and how the work is shared. */
export const SHARING = section('Which takes, and how the work is divided', {
  only: option(
    text('LIST', 'a list of takes'),
    'Limits the takes to those in LIST, except those with the verdict bad: a review as CSV or JSON, or plain paths; without inputs, its paths are the inputs.',
    { needs: 'to' },
  ),
  'files-from': option(
    text('FILE', 'a file, or - for standard input'),
    'Reads input paths from this file, one per line; - for standard input.',
    { needs: 'to' },
  ),
  shard: option(SHARD, 'Handles part I of N, every N-th take; all parts may run at the same time, on any machine.', {
    needs: 'to',
  }),
  jobs: option(whole('N', 1, MAX_THREADS), 'Runs this many threads instead of one per core.', {
    needs: 'to',
  }),
  resume: flag('Skips takes already written from the same input, options and version.', { needs: 'to' }),
  'no-times': flag('Leaves milliseconds out of the manifest, so that it depends only on inputs and options.', {
    needs: 'to',
  }),
});

/** The first of these options that is given; undefined if none is. */
export function firstGiven(values: Readonly<Record<string, unknown>>, options: Options): string | undefined {
  return Object.keys(options).find((name) => {
    const value = values[name];
    return Array.isArray(value) ? value.length > 0 : value !== undefined && value !== false;
  });
}

/** Of files that state none. */
export interface KnownRate {
  /** Frames per second. */
  readonly rate?: number;
}

/** What takes are edited by, with the target as its files. */
export function editingOf({
  retarget,
  map,
  rate,
  space,
  crop,
  mirror: isMirrored,
}: OptionValues<typeof EDITING>): TargetFiles & Pick<TakeOptions, 'crop' | 'isMirrored'> & KnownRate {
  return {
    ...(retarget.length > 0 && { retarget }),
    ...(map !== undefined && { map }),
    ...(space !== undefined && { space }),
    ...(rate !== undefined && { rate }),
    ...(crop && { crop }),
    isMirrored,
  };
}

/** The items of one part: every n-th, so that large and small ones are spread over all. */
export function inShard<T>(items: readonly T[], shard: Shard | undefined): readonly T[] {
  return shard ? items.filter((_, i) => i % shard.count === shard.index - 1) : items;
}
