/** Blocks of a dump that are values of channels. */
import type { DumpBlock } from '../../model/dump.ts';
import { lastDigitsIn } from '../../model/names/numbered-names.ts';
import type { FrameTime } from '../program/evaluator.ts';
import { isCount, isInRows, Misfit, widthOf } from './entries.ts';
import { counted } from './found.ts';

/**
 * Reads a block as values of channels: rows of a time and its values, lists with their times, pairs of one channel.
 * Throws a `Misfit` where it is none of these.
 *
 * @param channels how many there are
 * @param put called for each value
 */
export function readSamples(
  block: DumpBlock,
  time: FrameTime,
  channels: number,
  put: (channel: number, time: number, value: number) => void,
): void {
  const { values, starts, lines, times, channel, columns, labels } = block;
  const line = lines[0] ?? 0;
  if (channels === 0)
    throw new Misfit(
      'dump-length',
      'These look like channel values. Expected the .anim with these channels, found none among the files.',
      line,
    );
  const rows = lines.length;
  const width = widthOf(block);
  const known = (c: number, at: number) => {
    if (Number.isInteger(c) && c >= 0 && c < channels) return c;
    throw new Misfit('dump-index', `Expected a channel from 0 to ${channels - 1}, found ${c}.`, lines[at] ?? line);
  };
  if (times && times.length > 0) {
    const count = times.length;
    const isByTime = rows === count && width === channels && width !== count;
    if (isByTime) {
      for (let i = 0; i < values.length; i++) put(i % channels, times[Math.floor(i / channels)], values[i]);
      return;
    }
    const asked = labels?.every((label) => label?.index !== undefined)
      ? labels.map((label) => label?.index ?? 0)
      : undefined;
    if (values.length % count !== 0 || (asked ? asked.length : values.length / count) > channels)
      throw misfitOf(block, count, channels);
    if (rows > 1 && width !== count) throw misfitOf(block, count, channels);
    for (let i = 0; i < values.length; i++) {
      const row = Math.floor(i / count);
      put(known(channel ?? asked?.[row] ?? row, row), times[i % count], values[i]);
    }
    return;
  }
  if (channel !== undefined) {
    if (values.length % 2 !== 0) throw misfitOf(block, 1, channels);
    known(channel, 0);
    for (let i = 0; i < values.length; i += 2) put(channel, values[i], values[i + 1]);
    return;
  }
  if (labels && labels.length === rows && time !== undefined && width === 1) {
    for (let r = 0; r < rows; r++) put(known(labels[r]?.index ?? r, r), time, values[starts[r]]);
    return;
  }
  if (time !== undefined && isOfOneTime(block, channels)) {
    const each = values.length / channels;
    for (let c = 0; c < channels; c++) put(each === 2 ? known(values[2 * c], c) : c, time, values[each * (c + 1) - 1]);
    return;
  }
  const listed = numbersOfColumns(columns?.slice(1) ?? [], channels);
  const each = listed ? listed.length + 1 : channels + 1;
  if (!isInRows(block, each)) throw misfitOf(block, 0, channels);
  for (let i = 0; i < values.length; i += each) {
    for (let c = 0; c + 1 < each; c++)
      put(known(listed ? listed[c] : c, Math.floor(i / each)), values[i], values[i + 1 + c]);
  }
}

/** The channels that columns are of by their numbers. Undefined: they are in order, as those of all counted from 1 are. */
function numbersOfColumns(names: readonly string[], channels: number): readonly number[] | undefined {
  const numbered = names.map((name) => Number(lastDigitsIn(name) ?? Number.NaN));
  const isNumbered = numbered.length > 0 && new Set(numbered).size === names.length && !numbered.some(Number.isNaN);
  const areOthers = names.length === channels && numbered.some((n) => n >= channels);
  return isNumbered && !areOthers ? numbered : undefined;
}

/** Whether it states its time, and has a value for each channel, or its index and a value. */
export function isOfOneTime(block: DumpBlock, channels: number): boolean {
  const { values, time } = block;
  if (time === undefined || channels === 0) return false;
  if (values.length === channels) return true;
  const indices = Array.from(values.subarray(0, 2 * channels)).filter((_, i) => i % 2 === 0);
  return values.length === 2 * channels && widthOf(block) === 2 && isCount(indices);
}

function misfitOf({ values, starts, lines }: DumpBlock, times: number, channels: number): Misfit {
  const wrong = lines.findIndex((_, r) => starts[r + 1] - starts[r] !== channels + 1);
  const row = Math.max(0, wrong);
  const expected =
    times > 1
      ? `${times} values per channel, as many as times, of up to ${channels} channels`
      : times === 1
        ? 'rows of a time and a value'
        : `rows of a time and ${counted(channels, 'value')}`;
  const found = times > 1 ? counted(values.length, 'value') : counted(starts[row + 1] - starts[row], 'number');
  return new Misfit(
    'dump-length',
    `Expected ${expected}, found ${found}. A single channel can be labelled "channel N".`,
    lines[row] ?? 0,
  );
}
