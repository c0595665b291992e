import { beforeEach, describe, expect, it } from 'vitest';
import { keyPose } from '../../../src/edit/commands/keying.ts';
import { setDofs } from '../../../src/edit/commands/pose.ts';
import { copyKeys } from '../../../src/edit/keys/clipboard.ts';
import { period } from '../../../src/edit/keys/cycle.ts';
import { keysOf } from '../../../src/model/takes/take.ts';
import { keyNow } from '../../../src/ui/editors/posing/pose-edits.ts';
import { type CycleText, cycleText } from '../../../src/ui/editors/timeline/cycle-text.ts';
import { insertAtPlayhead, paste } from '../../../src/ui/editors/timeline/key-edits.ts';
import { askAboutCycles } from '../../../src/ui/shell/cycle-questions.ts';
import { runAction } from '../../../src/ui/state/actions/action.ts';
import { HandEdit } from '../../../src/ui/state/actions/hand-edit.ts';
import { addKeyed } from '../../../src/ui/state/add-keys.ts';
import type { Workbench } from '../../../src/ui/state/workbench.ts';
import { channel, character, documentOf, skeleton, take, workbench } from '../builders.ts';

const walk = { ...channel(0, 0.4, 0.8), extrapolateIn: 'cycle', extrapolateOut: 'cycle' } as const;
const still = channel(0, 0.8);
const dancer = character({
  skeleton: skeleton(['hips', -1]),
  takes: [take([0, 6.4], walk, walk, still, still, still, still)],
  shownTake: 0,
  timeOffsetSeconds: 1,
});
let wb: Workbench;
const channels = () => wb.store.document.characters[0].takes[0].channels;
const asked = () => {
  const question = wb.timeline.cycleQuestion.get();
  if (!question) throw new Error('nothing is asked');
  return question;
};

beforeEach(() => {
  ({ wb } = workbench(documentOf(dancer), { timeSeconds: 2, range: [0, 6.4] }));
  wb.timeline.change({ list: 'all' });
  // A drag listens for Escape on the page.
  Object.assign(globalThis, { window: { addEventListener: () => {}, removeEventListener: () => {} } });
  askAboutCycles(wb);
});

describe('keys outside a cycle', () => {
  it.each([
    ['bake', 8],
    ['inside', 0.8],
    ['lengthen', 3],
  ] as const)('%s is one step once it is answered', (how, length) => {
    keyNow(wb, [{ character: wb.store.document.characters[0], dofs: [0] }]);
    expect(wb.dialog.get()).toBe('outsideCycle');
    // Seen already, and no step yet.
    expect(period(channels()[0])).toBe(3);
    asked().show('bake');
    expect(period(channels()[0])).toBeCloseTo(8, 12);
    expect(wb.store.undoLabel).toBeUndefined();
    asked().answer(how);
    expect(wb.dialog.get()).toBeUndefined();
    expect(period(channels()[0])).toBeCloseTo(length, 12);
    expect(channels()[1]).toBe(walk);
    wb.store.undo();
    expect(wb.store.document.characters[0]).toBe(dancer);
    expect(wb.store.undoLabel).toBeUndefined();
  });

  it('for a moment is one step too, eased over whole frames, and the first answer', () => {
    wb.store.apply(setDofs, { characterId: 'c1', dofs: [{ index: 0, value: 3 }], timeSeconds: 2 });
    const posed = wb.store.document.characters[0];
    keyNow(wb, [{ character: wb.store.document.characters[0], dofs: [0] }]);
    asked().moment?.show({ easeIn: 0.3, easeOut: 0.51 });
    expect(wb.store.undoLabel).not.toContain('moment');
    asked().moment?.answer({ easeIn: 0.3, easeOut: 0.51 });
    expect(wb.dialog.get()).toBeUndefined();
    expect(wb.store.undoLabel).toBe('Key tx of hips for a moment');
    const channel = channels()[0];
    if (channel.kind !== 'keys') throw new Error('It has keys.');
    expect(period(channel)).toBeCloseTo(8, 12);
    const around = [...channel.times].filter((time) => time > 3 && time < 3.9);
    expect(around.some((time) => Math.abs(time - 3.5) < 1e-9)).toBe(true);
    wb.store.undo();
    expect(wb.store.document.characters[0]).toBe(posed);
  });

  it('a moment beside the last is eased from its pose on, which stays', () => {
    const pose = (timeSeconds: number, value: number) => {
      wb.transport.update((p) => ({ ...p, timeSeconds }));
      wb.store.apply(setDofs, { characterId: 'c1', dofs: [{ index: 0, value }], timeSeconds });
      runAction(wb, 'key.forMoment');
      return asked().moment;
    };
    pose(2, 3)?.answer({ easeIn: 0.3, easeOut: 0.3 });
    const before = pose(1.9, 4);
    expect(before?.easing).toEqual({ easeIn: 0.3, easeOut: 0.1 });
    asked().cancel();
    const beside = pose(2.2, -3);
    expect(beside?.easing).toEqual({ easeIn: 0.2, easeOut: 0.3 });
    beside?.answer(beside.easing);
    const { times, values } = keysOf(channels()[0]);
    expect([3, 3.2].map((time) => values[times.findIndex((t) => Math.abs(t - time) < 1e-9)])).toEqual([3, -3]);
    // The last one is that now, and what is further away is eased as ever.
    expect(pose(2.3, 3)?.easing.easeIn).toBe(0.1);
    asked().cancel();
    expect(pose(4, 3)?.easing).toEqual({ easeIn: 0.3, easeOut: 0.3 });
    asked().cancel();
    // Nor does what was undone count.
    while (wb.store.undoLabel) wb.store.undo();
    expect(pose(2.3, 3)?.easing.easeIn).toBe(0.3);
  });

  it('change nothing when the dialog is closed, nor when the document changes meanwhile', () => {
    keyNow(wb, [{ character: wb.store.document.characters[0] }]);
    wb.dialog.set(undefined);
    expect(wb.store.document.characters[0]).toBe(dancer);
    expect(wb.timeline.cycleQuestion.get()).toBeUndefined();
    keyNow(wb, [{ character: wb.store.document.characters[0] }]);
    const question = asked();
    wb.store.apply(keyPose, { characterId: 'c1', dofs: [2], timeSeconds: 3 });
    const after = wb.store.document;
    question.answer('bake');
    expect(wb.store.document).toBe(after);
    expect(channels()[0]).toBe(walk);
  });

  it('keys inside the cycle or on channels that don’t repeat raise no question', () => {
    keyNow(wb, [{ character: wb.store.document.characters[0], dofs: [2] }]);
    expect(wb.timeline.cycleQuestion.get()).toBeUndefined();
    wb.transport.update((p) => ({ ...p, timeSeconds: -0.4 }));
    keyNow(wb, [{ character: wb.store.document.characters[0], dofs: [0] }]);
    expect(wb.timeline.cycleQuestion.get()).toBeUndefined();
    expect(wb.store.undoLabel).toBe('Key tx of hips');
  });

  it('keys outside the cycle raise one question for each command that adds some', () => {
    const ways: Readonly<Record<string, () => void>> = {
      'a key on the curves': () => insertAtPlayhead(wb, [0, 1]),
      'pasted keys': () => paste(wb, 'merge', undefined, copyKeys(dancer.takes[0], [{ channel: 1, indices: [1] }])),
      'the whole pose': () => runAction(wb, 'key.pose'),
      'auto-key': () => {
        runAction(wb, 'key.auto');
        runAction(wb, 'pose.resetToZero');
        runAction(wb, 'key.auto');
      },
    };
    for (const [way, add] of Object.entries(ways)) {
      add();
      expect(wb.timeline.cycleQuestion.get(), way).toBeDefined();
      asked().cancel();
      expect(wb.store.document.characters[0], way).toBe(dancer);
    }
  });

  it('keys outside a cycle go where it was said once for all', () => {
    runAction(wb, 'timeline.outsideCycle.inside');
    keyNow(wb, [{ character: wb.store.document.characters[0], dofs: [0] }]);
    insertAtPlayhead(wb, [1]);
    expect(wb.timeline.cycleQuestion.get()).toBeUndefined();
    expect(channels().slice(0, 2).map(period)).toEqual([0.8, 0.8]);
    expect(keysOf(channels()[0]).times).toHaveLength(4);
  });

  it('a drag with auto-key outside the cycle asks at its release, and Escape reverts it', () => {
    const edit = new HandEdit(wb.store, wb.messages);
    const drag = (value: number) => {
      const args = { characterId: 'c1', dofs: [{ index: 0, value }], timeSeconds: 2, key: {} };
      edit.preview(setDofs, args, () => addKeyed(wb, setDofs, args));
    };
    for (const answer of [undefined, 'bake'] as const) {
      drag(0.5);
      drag(1);
      expect(wb.timeline.cycleQuestion.get()).toBeUndefined();
      edit.commit();
      if (answer) asked().answer(answer);
      else asked().cancel();
      expect(wb.store.undoLabel).toBe(answer && 'Key tx of hips');
    }
    const { times, values } = keysOf(channels()[0]);
    expect(values[times.indexOf(3)]).toBe(1);
    wb.store.undo();
    expect(wb.store.document.characters[0]).toBe(dancer);
  });
});

/** With spaces that may break. */
const plain = (text: CycleText): CycleText => JSON.parse(JSON.stringify(text).replaceAll('\u00a0', ' '));

describe('what is asked', () => {
  it('names the channel, its cycle and what each answer does, in times of the transport', () => {
    keyNow(wb, [{ character: wb.store.document.characters[0], dofs: [0] }]);
    expect(plain(cycleText(asked(), [0, 6.4]))).toEqual({
      about: 'hips tx repeats every 0.8 s. A key at 2 s would make it repeat every 3 s.',
      answers: {
        bake: 'Repeats from −1 to 7 s become keys, and nothing is eased: the motion changes from the key before 2 s to the one after.',
        inside: 'The key is set at −0.4 s instead, and every repeat shows it.',
        lengthen: 'All keys repeat together, the new one included: the motion changes at other times too.',
      },
    });
  });

  it('speaks of several channels at once', () => {
    keyNow(wb, [{ character: wb.store.document.characters[0] }]);
    expect(plain(cycleText(asked(), [0, 6.4])).about).toBe(
      'hips tx and 1 more channel repeat every 0.8 s. A key at 2 s would make them repeat every 3 s.',
    );
  });

  it('offers no repeats as keys where there would be endlessly many', () => {
    keyNow(wb, [{ character: wb.store.document.characters[0], dofs: [0] }]);
    const { answers } = cycleText(asked(), [0, 1e308]);
    expect(Object.keys(answers)).toEqual(['inside', 'lengthen']);
    expect(answers.inside).toBe(cycleText(asked(), [0, 6.4]).answers.inside);
  });
});
