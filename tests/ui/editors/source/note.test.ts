import { describe, expect, it } from 'vitest';
import type { LineHunk } from '../../../../src/model/text-changes.ts';
import { type Noted, noteOf } from '../../../../src/ui/editors/source/note.ts';
import { problemsIn } from '../../../../src/ui/editors/source/problems.ts';

/** Line 3 was changed, and two were added below it. */
const HUNKS: readonly LineHunk[] = [{ oldFrom: 3, oldTo: 4, newFrom: 3, newTo: 6 }];

const TEXT = {
  hunks: HUNKS,
  map: { marks: [], index: { lines: new Float64Array(0), offsets: new Float64Array(0), count: 0, bytes: 0 }, rows: [] },
  text: new Blob([]),
  count: 9,
  line: () => undefined,
};

function note(noted: Partial<Noted>) {
  const changes = { text: undefined, problem: undefined, isComparing: false };
  const plain = { isEdited: false, hasDraft: false, hasErrors: false, showsChanges: true, changes };
  return noteOf({ state: 'edited', ...plain, ...noted });
}

describe('the note above a text', () => {
  it('is empty for a text that is what is in the page, and while the text is edited', () => {
    expect(note({ state: 'same' })).toEqual({ text: '' });
    expect(note({ isEdited: true, hasDraft: true })).toEqual({ text: '' });
  });

  it('counts the changes and leads to them, unless the file is shown as it came', () => {
    const changes = { text: TEXT, problem: undefined, isComparing: false };
    expect(note({ changes })).toEqual({
      text: '1 line changed, 2 added since it was opened. Click one to see what it was.',
      isOn: true,
      hasSteps: true,
    });
    const asItCame = note({ changes, showsChanges: false });
    expect(asItCame).toEqual({ text: expect.stringContaining('those of the original file'), isOn: false });
  });

  it('tells a problem of the comparison once the next one has ended', () => {
    const problem = 'It can’t be compared.';
    const told = note({ changes: { text: undefined, problem, isComparing: false } });
    expect(told).toEqual({ text: `${problem} Line numbers are those of the original file.` });
    const waits = note({ changes: { text: undefined, problem, isComparing: true } });
    expect(waits).toEqual({ text: 'Edited since it was opened. Comparing…', isOn: true });
  });

  it('says of another version why no lines are highlighted, and offers to correct one with errors', () => {
    expect(note({ state: 'other' }).text).toMatch(/not the version that is open.*no lines are highlighted\.$/);
    expect(note({ state: 'other', hasErrors: true }).text).toMatch(/has errors.*Edit corrects it here\.$/);
    expect(note({ state: 'other', hasDraft: true }).text).toMatch(/were not applied/);
  });
});

describe('the problems of a text with changes', () => {
  it('are at the lines where theirs are now, and gone where these were changed', () => {
    const at = (line: number, file = 'a.skel') =>
      ({ severity: 'warning', code: 'x', file, line, column: 1, message: `${line}` }) as const;
    const found = problemsIn([at(0), at(2), at(3), at(4), at(2, 'b.skel')], 'a.skel', HUNKS);
    expect([...found].map(([line, { message }]) => [line, message])).toEqual([
      [2, '2'],
      [6, '4'],
    ]);
    expect(problemsIn([at(2)], undefined, []).size).toBe(0);
  });
});
