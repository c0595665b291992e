import { describe, expect, it } from 'vitest';
import { EMPTY_DOCUMENT } from '../../../../src/model/document.ts';
import type { JointMark } from '../../../../src/teaching/compare/joint-marks.ts';
import { groupKey, jointKey, outlineRows } from '../../../../src/ui/editors/outliner/outline-rows.ts';
import { rowMarks } from '../../../../src/ui/editors/outliner/row-marks.ts';
import { characterFrom } from '../../../teaching/lesson-files.ts';

/** 0 root, 1 hip, 2 knee, 3 foot below it, and 4 arm. */
const TEXT = 'balljoint root { balljoint hip { balljoint knee { balljoint foot { } } } balljoint arm { } }';
const character = characterFrom('figure.skel', TEXT);
const joints = character.skeleton?.joints ?? [];
const { id } = character;

/** The marks of a row while some rows are collapsed. */
function marked(key: string, marks: readonly JointMark[], closed: readonly string[], of = id) {
  const rows = outlineRows({ ...EMPTY_DOCUMENT, characters: [character] }, (each) => !closed.includes(each));
  const row = rows.find((each) => each.key === key);
  if (!row) throw new Error(`There is no row ${key}.`);
  return rowMarks(row, { characterId: of, marks }, joints).map(({ text }) => text);
}

const hip = jointKey(id, 1);
const MARKS: readonly JointMark[] = ['agrees', 'agrees', 'own', 'inherited', 'own'];

describe('the marks of the outliner’s rows', () => {
  it('a row that is expanded has its own mark', () => {
    expect(marked(hip, MARKS, [])).toEqual(['agrees']);
    expect(marked(jointKey(id, 2), MARKS, [])).toEqual(['own error']);
    expect(marked(groupKey(id, 'joint'), MARKS, [])).toEqual([]);
  });

  it('a collapsed row also sums up those of its hierarchy, and of no other', () => {
    expect(marked(hip, MARKS, [hip])).toEqual(['agrees', '1 own error, 1 inherited in descendants']);
    expect(marked(hip, ['agrees', 'own', 'agrees', 'agrees', 'own'], [hip])).toEqual(['own error']);
    expect(marked(hip, ['differs', 'differs', 'differs', 'differs', 'agrees'], [hip])).toEqual([
      'differs',
      '2 differ in descendants',
    ]);
  });

  it('a collapsed character or list of joints sums up all of them, also if they agree', () => {
    const group = groupKey(id, 'joint');
    expect(marked(group, MARKS, [group])).toEqual(['2 own errors, 1 inherited in descendants']);
    expect(marked(id, MARKS, [id])).toEqual(['2 own errors, 1 inherited in descendants']);
    expect(
      marked(
        id,
        joints.map((): JointMark => 'agrees'),
        [id],
      ),
    ).toEqual(['all descendants agree']);
  });

  it('another character has none, nor has one whose joints were not compared', () => {
    expect(marked(hip, MARKS, [hip], 'other')).toEqual([]);
    expect(marked(hip, [], [hip])).toEqual([]);
  });
});
