/** Rows of the tables: what was compared, with its errors. */

import { type Character, shownSkin } from '../../../model/document.ts';
import { characterDofs } from '../../../model/skeleton/dofs.ts';
import { jointName } from '../../../model/skeleton/joint-name.ts';
import type { FrameComparison } from '../../../teaching/compare/compare.ts';
import { type JointMark, jointMarks } from '../../../teaching/compare/joint-marks.ts';
import type { ComparedResult } from '../../state/dump-comparison.ts';
import type { SortOrder } from '../../widgets/table/sort-heads.ts';

export const ROW_KINDS = ['joints', 'vertices', 'normals', 'channels'] as const;
export type RowKind = (typeof ROW_KINDS)[number];

/** What of a joint, vertex or channel differs. */
export interface ComparedRow {
  /** Index of the joint, vertex or channel. */
  readonly index: number;
  /** Name of the joint, or of the DOF that the channel drives; of a vertex the joint that it follows most. */
  readonly name: string;
  readonly mark: JointMark;
  /** The largest, as `FirstWrong.error`. */
  readonly error: number;
  /** First time at which a channel is wrong, in seconds of the take; absent if it agrees. */
  readonly firstTime?: number;
}

export type RowColumn = 'index' | 'name' | 'mark' | 'error';

export type RowOrder = SortOrder<RowColumn>;

/** Vertices listed at most: the first that is wrong, and the worst. */
export const MAX_VERTICES = 100;

/** Whether a frame has such numbers. Channels are of no frame. */
export function hasRows(kind: RowKind, { jointErrors, vertexErrors, normalErrors }: FrameComparison): boolean {
  const errors = { joints: jointErrors, vertices: vertexErrors, normals: normalErrors };
  return kind !== 'channels' && errors[kind].length > 0;
}

/** What the dumps have. */
export function kindsIn({ comparison: { compared } }: ComparedResult): readonly RowKind[] {
  const { world, local, positions, vertices, normals, channels } = compared;
  const counts: Readonly<Record<RowKind, number>> = {
    joints: world + local + positions,
    vertices,
    normals,
    channels,
  };
  return ROW_KINDS.filter((kind) => counts[kind] > 0);
}

/**
 * Unordered; of vertices the worst, with the first that is wrong.
 *
 * @param frame undefined where channels alone were compared
 */
export function rowsOf(
  kind: RowKind,
  result: ComparedResult,
  frame: FrameComparison | undefined,
  character: Character,
): readonly ComparedRow[] {
  const { tolerance } = result;
  if (kind === 'channels') return channelRows(result, character);
  if (!frame) return [];
  if (kind === 'joints') {
    const marks = jointMarks(frame, tolerance);
    return Array.from(frame.jointErrors, (error, index) => ({
      index,
      name: jointName(character.skeleton, index),
      mark: marks[index],
      error,
    }));
  }
  const errors = kind === 'vertices' ? frame.vertexErrors : frame.normalErrors;
  return listedOf(errors, tolerance).map((index) => ({
    index,
    name: followedBy(character, index),
    mark: errors[index] <= tolerance ? 'agrees' : 'differs',
    error: errors[index],
  }));
}

/** The joint with the largest weight at a vertex; empty if it has none. */
function followedBy(character: Character, vertex: number): string {
  const attachments = shownSkin(character)?.attachments;
  if (!attachments) return '';
  const { start, joints, weights } = attachments;
  let most = start[vertex];
  for (let a = most; a < start[vertex + 1]; a++) if (weights[a] > weights[most]) most = a;
  return most < start[vertex + 1] ? jointName(character.skeleton, joints[most]) : '';
}

/** How many of the vertices or normals differ, and how many there are. */
export function countsOf(kind: RowKind, frame: FrameComparison, tolerance: number): { wrong: number; of: number } {
  const errors = kind === 'vertices' ? frame.vertexErrors : frame.normalErrors;
  return { wrong: errors.reduce((sum, error) => sum + (error <= tolerance ? 0 : 1), 0), of: errors.length };
}

/** The worst of those that differ and the first of them; if all agree the worst. */
function listedOf(errors: Float64Array, tolerance: number): readonly number[] {
  const first = errors.findIndex((error) => !(error <= tolerance));
  const worst = worstOf(errors, MAX_VERTICES);
  if (first < 0) return worst;
  const wrong = worst.filter((index) => !(errors[index] <= tolerance));
  return wrong.includes(first) ? wrong : [...wrong.slice(0, MAX_VERTICES - 1), first];
}

/** How a row is called where it is alone. */
export function rowTitle(kind: RowKind, { index, name }: ComparedRow): string {
  if (kind === 'vertices') return `vertex ${index}`;
  return kind === 'normals' ? `normal of vertex ${index}` : name;
}

/** Indices of the largest, NaN first; ties by index. */
function worstOf(errors: Float64Array, most: number): readonly number[] {
  const worst: number[] = [];
  for (let i = 0; i < errors.length; i++) {
    const last = worst[worst.length - 1];
    if (worst.length === most && !(errors[i] > errors[last])) continue;
    let at = worst.length;
    while (at > 0 && errors[i] > errors[worst[at - 1]]) at--;
    worst.splice(at, 0, i);
    if (worst.length > most) worst.pop();
  }
  return worst;
}

function channelRows({ comparison, targets, tolerance }: ComparedResult, character: Character): ComparedRow[] {
  const { channels, times, values } = targets.channels;
  const { ourChannels } = comparison;
  const dofs = characterDofs(character.skeleton, shownSkin(character) ? character.morphs : []);
  const rows = new Map<number, ComparedRow>();
  channels.forEach((index, i) => {
    const difference = Math.abs(ourChannels[i] - values[i]);
    const error = Number.isNaN(difference) ? Number.POSITIVE_INFINITY : difference;
    const known = rows.get(index);
    const isWrong = !(error <= tolerance);
    const before = known?.firstTime;
    const firstTime = isWrong && !(before !== undefined && before <= times[i]) ? times[i] : before;
    const time = firstTime === undefined ? {} : { firstTime };
    if (known && !(error > known.error)) {
      if (firstTime !== before) rows.set(index, { ...known, ...time });
      return;
    }
    const dof = dofs[index];
    const joint = dof && dof.joint >= 0 ? `${jointName(character.skeleton, dof.joint)}.` : '';
    const name = dof ? `${joint}${dof.name}` : `channel ${index}`;
    rows.set(index, { index, name, mark: isWrong ? 'differs' : 'agrees', error, ...time });
  });
  return [...rows.values()];
}

const MARK_ORDER: readonly JointMark[] = ['own', 'differs', 'inherited', 'agrees'];

/** In order; ties by index. */
export function inOrder(rows: readonly ComparedRow[], { column, descending }: RowOrder): readonly ComparedRow[] {
  const names = new Intl.Collator('en', { numeric: true });
  const compare = (a: ComparedRow, b: ComparedRow): number => {
    switch (column) {
      case 'index':
        return a.index - b.index;
      case 'name':
        return names.compare(a.name, b.name);
      case 'mark':
        return MARK_ORDER.indexOf(a.mark) - MARK_ORDER.indexOf(b.mark);
      case 'error':
        // Infinite ones are equal.
        return a.error === b.error ? 0 : a.error - b.error;
    }
  };
  const sign = descending ? -1 : 1;
  return [...rows].sort((a, b) => sign * compare(a, b) || a.index - b.index);
}
