/** Which joint or vertex each entry of a dump is of: by its index, by its name, or in order. */
import type { DumpBlock, DumpLabel } from '../../model/dump.ts';
import { lastDigitsIn } from '../../model/names/numbered-names.ts';
import { type Entry, isCount, Misfit } from './entries.ts';
import { counted } from './found.ts';
import type { JointNames } from './labels.ts';

/** The place of each entry. Throws a `Misfit` where labels name one twice, or none. */
export function placesOf(
  labels: readonly (DumpLabel | null)[],
  count: number,
  entries: readonly Entry[],
  block: DumpBlock,
  joints: JointNames,
): readonly number[] {
  const inOrder = labels.map((_, i) => i);
  if (labels.every((label) => label === null)) return inOrder;
  const indices = labels.map((label) => label?.index);
  if (indices.every((index) => index !== undefined)) {
    const least = Math.min(...indices.slice(0, 1), ...indices.filter((index) => index < 2));
    const from = least === 1 && indices.includes(count) ? 1 : 0;
    const places = indices.map((index) => index - from);
    if (isCount(indices)) return places;
    const wrong = places.findIndex(
      (place, i) => place < 0 || place >= count || !Number.isInteger(place) || places.indexOf(place) < i,
    );
    if (labels.every((label) => !label?.name)) {
      const found = `found ${indices[wrong]}`;
      throw new Misfit(
        'dump-index',
        `Expected each index from 0 to ${count - 1} once, ${found}.`,
        entries[wrong]?.line ?? block.lines[0],
      );
    }
  }
  return byNames(labels, entries, joints) ?? inOrder;
}

/** By the names of joints; undefined if none is one. */
function byNames(
  labels: readonly (DumpLabel | null)[],
  entries: readonly Entry[],
  joints: JointNames,
): readonly number[] | undefined {
  const places = joints.placesOf(labels);
  if (places.every((place) => place !== undefined)) return places;
  if (places.every((place) => place === undefined)) {
    // `joint7` of joints with other names.
    const numbers = labels.map((label) => Number(lastDigitsIn(label?.name ?? '') ?? Number.NaN));
    return isCount(numbers) ? numbers.map((n) => n - Math.min(...numbers.slice(0, 2), numbers[0])) : undefined;
  }
  const wrong = places.indexOf(undefined);
  const name = labels[wrong]?.name;
  const found = name === undefined ? 'found numbers without a name' : `found "${name}"`;
  throw new Misfit(
    'dump-name',
    `Expected the name of each of ${counted(joints.names.length, 'joint')} once, ${found}.`,
    entries[wrong].line,
  );
}
