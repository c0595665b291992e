/** Where the error is largest, of which kind it is, and in which unit. */

import { shownSkin } from '../../../model/document.ts';
import { characterDofs } from '../../../model/skeleton/dofs.ts';
import type { FirstWrong } from '../../../teaching/compare/compare.ts';
import type { ComparedResult } from '../../state/dump-comparison.ts';
import { numberText, placeText } from './banner-text.ts';

/** `vertex 12: 3 apart, 2.7 along y, of a size of 40`; if all agree the largest error. */
export function largestText(result: ComparedResult): string {
  const { frames, largest, worst } = result.comparison;
  if (!largest)
    return `${numberText(worst)}${frames.length > 0 ? `, over a size of ${numberText(frames[0].size)}` : ''}`;
  const place = placeText(largest, result.character);
  if (!Number.isFinite(largest.error)) return `${place}: not a number`;
  return `${place}: ${errorText(result, largest)}`;
}

function errorText(result: ComparedResult, largest: FirstWrong): string {
  const { what, index, error } = largest;
  if (what === 'channel') return `${numberText(error)}${unitOf(result, index)}`;
  const f = result.comparison.frames.findIndex((frame) => frame.largest === largest);
  const apart = f < 0 ? undefined : differenceOf(result, f, largest);
  if (!apart) return `${numberText(error)} in its rotation`;
  const length = Math.hypot(...apart);
  const most = apart.reduce((k, part, i) => (Math.abs(part) > Math.abs(apart[k]) ? i : k), 0);
  const along = `${numberText(length)} apart, ${numberText(Math.abs(apart[most]))} along ${'xyz'[most]}`;
  return what === 'normal' ? along : `${along}, for a size of ${numberText(result.comparison.frames[f].size)}`;
}

/** Theirs − ours, of a point; undefined if the largest element is one of a rotation. */
function differenceOf(
  { comparison, targets }: ComparedResult,
  frame: number,
  { what, index, length }: FirstWrong,
): readonly number[] | undefined {
  const { ours } = comparison.frames[frame];
  const { world, local, positions, vertices, normals } = targets.frames[frame];
  const from = (theirs: Float64Array, at: number, own: Float64Array, ownAt: number) =>
    [0, 1, 2].map((k) => theirs[at + k] - own[ownAt + k]);
  if (what === 'vertex') return vertices && from(vertices, 3 * index, ours.vertices, 3 * index);
  if (what === 'normal') return normals && from(normals, 3 * index, ours.normals, 3 * index);
  if (length === undefined) return undefined;
  const o = 16 * index + 12;
  const candidates = [
    ...(world ? [from(world, o, ours.world, o)] : []),
    ...(local ? [from(local, o, ours.local, o)] : []),
    ...(positions ? [from(positions, 3 * index, ours.world, o)] : []),
  ];
  const mostOf = (parts: readonly number[]) => Math.max(...parts.map(Math.abs));
  return candidates.sort((a, b) => mostOf(b) - mostOf(a)).at(0);
}

/** Angles are radians, as in files. */
function unitOf({ character }: ComparedResult, channel: number): string {
  const dof = characterDofs(character.skeleton, shownSkin(character) ? character.morphs : [])[channel];
  if (!dof) return '';
  return { angle: ' rad', length: ' of length', weight: ' of a weight', factor: '' }[dof.unit];
}
