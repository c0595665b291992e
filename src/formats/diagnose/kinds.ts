/** Recognises text files by their words: one of another kind, for whose extension the reader was chosen. */
import { SKEL_TYPES } from '../skel/joint-types.ts';
import type { TextKind } from './layouts.ts';
import type { TextLines } from './text-lines.ts';

/** Blocks that only a skin has. */
const OF_SKIN = ['texcoords', 'skinweights', 'triangles', 'bindings', 'material'];
/** Rows that are looked at for their length. */
const SOME = 50;

/** Words that start a line only in files of this kind. */
const OPENINGS: readonly (readonly [TextKind, ReadonlySet<string>])[] = [
  ['bvh', new Set(['hierarchy'])],
  ['anim', new Set(['animation'])],
  ['rig', new Set(['rig'])],
  ['skel', new Set(SKEL_TYPES.map(({ keyword }) => keyword))],
  ['pose', new Set(['pose'])],
  ['skin', new Set(OF_SKIN)],
  ['morph', new Set(['positions', 'normals'])],
];

/** The kind that the lines look like, if it is another one. */
export function otherKind(lines: TextLines, own: TextKind): TextKind | undefined {
  const kinds = textKinds(lines);
  const [kind] = kinds;
  if (kind === undefined || kinds.includes(own)) return undefined;
  // A skeleton's reader takes both forms.
  const areForms = (own === 'skel' || own === 'axskel') && (kinds.includes('skel') || kind === 'axskel');
  return areForms ? undefined : kind;
}

/** The kinds of which a file has openings, none if it has none. */
function textKinds(lines: TextLines): readonly TextKind[] {
  const words = firstWords(lines);
  if (words.length === 0) return usualRow(lines) === 6 ? ['axskel'] : [];
  const found = OPENINGS.filter(([, openings]) => words.some((word) => openings.has(word))).map(([kind]) => kind);
  // A rig names its animation.
  if (found.includes('rig')) return found.filter((kind) => kind !== 'anim');
  if (found.includes('skin')) return found.filter((kind) => kind !== 'morph');
  // Both have positions and normals.
  return found.map((kind) => (kind === 'morph' && usualRow(lines) === 3 ? 'skin' : kind));
}

/** The first words of all lines that start with one and, as `pose` is a word of skeletons too, open a block. */
function firstWords(lines: TextLines): readonly string[] {
  const words = new Set<string>();
  for (const line of lines.filled) {
    const { first, hasBrace } = lines.row(line);
    if (first !== 'w') continue;
    const word = lines.text(lines.head(line)).toLowerCase();
    if (word !== 'pose' || hasBrace) words.add(word);
  }
  return [...words];
}

/** The length of most rows of numbers. */
function usualRow(lines: TextLines): number {
  const votes = new Map<number, number>();
  let seen = 0;
  for (const line of lines.filled) {
    const { first, count } = lines.row(line);
    if (first !== 'n') continue;
    votes.set(count, (votes.get(count) ?? 0) + 1);
    if (++seen === SOME) break;
  }
  return [...votes].sort((a, b) => b[1] - a[1])[0]?.[0] ?? 0;
}
