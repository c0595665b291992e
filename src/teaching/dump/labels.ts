/** Meaning of a dump's labels: names of joints, indices, times, or words that name nothing here. */
import type { DumpBlock, DumpLabel } from '../../model/dump.ts';
import { lastDigitsIn } from '../../model/names/numbered-names.ts';
import { isCount, widthOf } from './entries.ts';

/** Finds names of joints in labels. */
export class JointNames {
  private readonly joints = new Map<string, number[]>();
  /** The longest first. */
  private readonly byLength: readonly string[];
  private readonly found = new Map<string, string | undefined>();

  constructor(readonly names: readonly string[]) {
    names.forEach((name, j) => {
      const plain = plainName(name);
      const same = this.joints.get(plain);
      if (same) same.push(j);
      else this.joints.set(plain, [j]);
    });
    this.byLength = [...this.joints.keys()].filter((name) => name.length > 1).sort((a, b) => b.length - a.length);
  }

  /** The joint of each label, each joint once, undefined where there is none: of that name, else with its name among its words. */
  placesOf(labels: readonly (DumpLabel | null)[]): (number | undefined)[] {
    const free = new Map([...this.joints].map(([name, joints]) => [name, [...joints]]));
    const places = labels.map((label) =>
      label?.name === undefined ? undefined : free.get(plainName(label.name))?.shift(),
    );
    return places.map((place, i) => {
      const name = labels[i]?.name;
      if (place !== undefined || name === undefined) return place;
      const within = this.within(name);
      return within === undefined ? undefined : free.get(within)?.shift();
    });
  }

  /** `world matrix of hip`, `hip (parent root)`: hip. Of several the first, and of those there the longest. */
  private within(label: string): string | undefined {
    if (!this.found.has(label)) {
      const plain = plainName(label);
      let first: string | undefined;
      let least = plain.length;
      for (const name of this.byLength) {
        const at = wordAt(plain, name);
        if (at >= 0 && at < least) [first, least] = [name, at];
      }
      this.found.set(label, first);
    }
    return this.found.get(label);
  }
}

function plainName(name: string): string {
  return name
    .trim()
    .toLowerCase()
    .replace(/[\s_]+/g, '_');
}

/** Where a word is in a text; −1 if nowhere. */
function wordAt(text: string, word: string): number {
  for (let at = text.indexOf(word); at >= 0; at = text.indexOf(word, at + 1)) {
    if (!isLetter(text, at - 1) && !isLetter(text, at + word.length)) return at;
  }
  return -1;
}

function isLetter(text: string, at: number): boolean {
  return /[a-z0-9\u00aa-\uffff]/.test(text.charAt(at));
}

/**
 * A block whose labels name joints or have indices. What belongs to other names is left out if every joint is named; of
 * labels that name nothing here only the numbers are kept.
 */
export function withKnownLabels(block: DumpBlock, joints: JointNames): DumpBlock {
  const { labels } = block;
  if (!labels) return block;
  const labelled = labels.filter((label) => label !== null);
  const indices = labelled.map(({ index }) => index ?? Number.NaN);
  const isIndexed = !indices.some(Number.isNaN);
  // A single index beside a name is that of a heading: `Homework 1:`.
  const areNumbers = labelled.every(({ name }) => name === undefined) || (labelled.length > 1 && isCount(indices));
  if (isIndexed && areNumbers) return block;
  const places = joints.placesOf(labels);
  const named = places.filter((place) => place !== undefined).length;
  if (named > 0) return named === joints.names.length ? withoutOthers(block, labels, places) : block;
  const digits = labelled.map(({ name }) => Number(lastDigitsIn(name ?? '') ?? Number.NaN));
  if (digits.length > 1 && isCount(digits)) return block;
  const { labels: _, ...unlabelled } = block;
  return unlabelled;
}

/** Without the rows of names that are no joint's, and those before the first name. */
function withoutOthers(
  block: DumpBlock,
  labels: readonly (DumpLabel | null)[],
  places: readonly (number | undefined)[],
): DumpBlock {
  const kept: number[] = [];
  let isOfJoint = false;
  for (let r = 0; r < block.lines.length; r++) {
    if (labels[r]) isOfJoint = places[r] !== undefined;
    if (isOfJoint) kept.push(r);
  }
  return kept.length === block.lines.length ? block : rowsOf(block, kept, (r) => labels[r] ?? null);
}

/** Some rows. */
function rowsOf(block: DumpBlock, rows: readonly number[], labelOf: (row: number) => DumpLabel | null): DumpBlock {
  const { values, starts, lines } = block;
  const ends = [0];
  for (const r of rows) ends.push(ends[ends.length - 1] + starts[r + 1] - starts[r]);
  const own = new Float64Array(ends[ends.length - 1]);
  rows.forEach((r, i) => {
    own.set(values.subarray(starts[r], starts[r + 1]), ends[i]);
  });
  return {
    ...block,
    values: own,
    starts: Uint32Array.from(ends),
    lines: Uint32Array.from(rows, (r) => lines[r]),
    labels: rows.map(labelOf),
  };
}

/**
 * Rows `T: value …` of all channels, or of the one that the block is of, as rows of a time and values; the same block
 * if they are none.
 *
 * @param isOther whether as many numbers may be of joints or vertices, whose indices are whole
 */
export function withTimes(block: DumpBlock, channels: number, isOther: boolean): DumpBlock {
  const { labels, values, lines, channel } = block;
  const count = channel === undefined ? channels : 1;
  if (!labels || labels.length < lines.length || count === 0 || widthOf(block) !== count) return block;
  const times = labels.map((label) => label?.index ?? Number.NaN);
  // `f(0.5) = …`: of one name, which is that of no joint.
  const named = new Set(labels.map((label) => label?.name?.replace(/[-+.(\d]+/g, '')));
  const isWhole = times.every((time) => Number.isInteger(time) && time >= 0);
  if (times.some(Number.isNaN) || named.size > 1 || (isWhole && isOther)) return block;
  const each = count + 1;
  const { labels: _, ...unlabelled } = block;
  return {
    ...unlabelled,
    values: Float64Array.from({ length: each * lines.length }, (_, i) => {
      const row = Math.floor(i / each);
      return i % each === 0 ? times[row] : values[count * row + (i % each) - 1];
    }),
    starts: Uint32Array.from({ length: lines.length + 1 }, (_, r) => each * r),
  };
}
