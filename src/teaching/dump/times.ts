/**
 * Dumps of several times that state none: the frames are those of the times asked for, in order. A file has a list for
 * each, or one list for all; or there is a file for each.
 */
import type { Character } from '../../model/document.ts';
import { type DumpBlock, isUntimed } from '../../model/dump.ts';
import { type Fitted, fitDumps, type NamedDump } from './fit-dump.ts';

/**
 * Finds out what the numbers of dumps are, at one of several times each.
 * @param times of dumps that state none; empty: the only time that others state, else the file pose
 */
export function fitDumpsAt(character: Character, dumps: readonly NamedDump[], times: readonly number[]): Fitted {
  if (times.length < 2) return fitDumps(character, dumps, times[0]);
  const within = fitDumps(
    character,
    dumps.map((dump) => timed(dump, times)),
    undefined,
  );
  if (within.targets) return within;
  const plain = fitDumps(character, dumps, undefined);
  if (plain.targets?.frames.length === 0) return plain;
  const untimed = dumps.filter(({ dump }) => dump.time === undefined && dump.blocks.every(isUntimed));
  if (untimed.length !== times.length) return within;
  const each = dumps.map(({ fileName, dump }): NamedDump => {
    const time = times[untimed.findIndex((one) => one.dump === dump)];
    return { fileName, dump: time === undefined ? dump : { ...dump, time } };
  });
  const between = fitDumps(character, each, undefined);
  return between.targets ? between : within;
}

function timed({ fileName, dump }: NamedDump, times: readonly number[]): NamedDump {
  if (dump.time !== undefined) return { fileName, dump };
  const untimed = dump.blocks.filter(isUntimed);
  const blocks = dump.blocks.flatMap((block): readonly DumpBlock[] => {
    if (!isUntimed(block)) return [block];
    if (untimed.length % times.length === 0) {
      // World and local matrices of each time, say.
      const perTime = untimed.length / times.length;
      return [{ ...block, time: times[Math.floor(untimed.indexOf(block) / perTime)] }];
    }
    return parts(block, times.length).map((part, i) => ({ ...part, time: times[i] }));
  });
  return { fileName, dump: { ...dump, blocks } };
}

/** A list as `count` lists of as many rows, or, of one row, as many numbers; as it is if it doesn't divide. */
function parts(block: DumpBlock, count: number): readonly DumpBlock[] {
  const { values, starts, lines, labels } = block;
  const rows = lines.length;
  if (rows === 1) {
    const each = values.length / count;
    if (!Number.isInteger(each)) return [block];
    return Array.from({ length: count }, (_, i) => ({
      ...block,
      values: values.subarray(i * each, (i + 1) * each),
      starts: Uint32Array.of(0, each),
    }));
  }
  const each = rows / count;
  if (!Number.isInteger(each)) return [block];
  return Array.from({ length: count }, (_, i) => {
    const [from, to] = [i * each, (i + 1) * each];
    return {
      ...block,
      values: values.subarray(starts[from], starts[to]),
      starts: starts.slice(from, to + 1).map((start) => start - starts[from]),
      lines: lines.subarray(from, to),
      ...(labels && { labels: labels.slice(from, to) }),
    };
  });
}
