/** How joints compare with those of another program: a mark per row, and one for the rows that are collapsed below it. */

import type { Joint } from '../../../model/skeleton/skeleton.ts';
import { type JointMark, jointMarks, MARK_TEXTS } from '../../../teaching/compare/joint-marks.ts';
import type { DumpComparison, ShownComparison } from '../../state/dump-comparison.ts';
import { element } from '../../widgets/dom.ts';
import { plural } from '../../widgets/numbers/number-text.ts';
import type { OutlineRow } from './outline-rows.ts';

/** Of the joints of a character. */
export interface Marks {
  readonly characterId: string | undefined;
  /** One per joint; empty if none were compared. */
  readonly marks: readonly JointMark[];
}

export const NO_MARKS: Marks = { characterId: undefined, marks: [] };

export interface RowMark {
  readonly mark: JointMark;
  readonly text: string;
  /** Whether it is of rows that are collapsed below. */
  readonly isBelow: boolean;
}

/** The worst first. */
const WORST: readonly JointMark[] = ['own', 'differs', 'inherited', 'agrees'];

export function marksOf(shown: ShownComparison | undefined, comparing: DumpComparison | undefined): Marks {
  if (!shown || !comparing) return NO_MARKS;
  return { characterId: comparing.characterId, marks: jointMarks(shown.frame, shown.result.tolerance) };
}

/** @param joints of the row's character */
export function rowMarks(row: OutlineRow, { characterId, marks }: Marks, joints: readonly Joint[]): readonly RowMark[] {
  if (row.characterId !== characterId || marks.length === 0) return [];
  const { kind, key, index, expandable, expanded } = row;
  const isOfAll = kind === 'character' || key.endsWith('/joint');
  if (kind !== 'joint' && !isOfAll) return [];
  const own = kind === 'joint' ? marks[index] : undefined;
  const below = expandable && !expanded ? marks.slice(...descendantsOf(isOfAll ? -1 : index, joints)) : [];
  const worst = WORST.find((mark) => below.includes(mark));
  const isTold = worst !== undefined && (worst !== 'agrees' || own === undefined);
  return [
    ...(own === undefined ? [] : [{ mark: own, text: MARK_TEXTS[own], isBelow: false }]),
    ...(isTold ? [{ mark: worst, text: belowText(below), isBelow: true }] : []),
  ];
}

/** Of joints in pre-order: from, and up to excluding. @param joint −1: all */
function descendantsOf(joint: number, joints: readonly Joint[]): readonly [number, number] {
  let end = joint + 1;
  while (end < joints.length && joints[end].parent >= joint) end++;
  return [joint + 1, end];
}

/** `2 own errors, 3 inherited in descendants`; `all descendants agree`. */
function belowText(marks: readonly JointMark[]): string {
  const count = (mark: JointMark) => marks.filter((each) => each === mark).length;
  const [own, differs, inherited] = [count('own'), count('differs'), count('inherited')];
  const texts = [
    ...(own > 0 ? [plural(own, 'own error')] : []),
    ...(differs > 0 ? [`${differs} ${differs === 1 ? 'differs' : 'differ'}`] : []),
    ...(inherited > 0 ? [`${inherited} inherited`] : []),
  ];
  return texts.length > 0 ? `${texts.join(', ')} in descendants` : 'all descendants agree';
}

export function markElement({ mark, text, isBelow }: RowMark): HTMLElement {
  return element('span', {
    class: isBelow ? 'compare-swatch below' : 'compare-swatch',
    'data-mark': mark,
    role: 'img',
    'aria-label': text,
    tooltip: text,
  });
}
