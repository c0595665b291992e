import { beforeEach, describe, expect, it } from 'vitest';
import { setExtrapolation } from '../../../../src/edit/commands/extrapolation.ts';
import { addKey, moveKeys, removeKeys, setKeys } from '../../../../src/edit/commands/keys.ts';
import { keyForMoment } from '../../../../src/edit/commands/moment.ts';
import { setDofs } from '../../../../src/edit/commands/pose.ts';
import { addJoint, removeJoint } from '../../../../src/edit/commands/rig.ts';
import { setMotion } from '../../../../src/edit/commands/rig-joint.ts';
import { shownTake } from '../../../../src/model/document.ts';
import { keysOf, restChannel } from '../../../../src/model/takes/take.ts';
import { keyNow } from '../../../../src/ui/editors/posing/pose-edits.ts';
import { selectKeys } from '../../../../src/ui/editors/timeline/current-take.ts';
import { nudge } from '../../../../src/ui/editors/timeline/key-edits.ts';
import { followPeriods } from '../../../../src/ui/editors/timeline/period.ts';
import type { Workbench } from '../../../../src/ui/state/workbench.ts';
import { channel, character, documentOf, skeleton, take, workbench } from '../../builders.ts';

let wb: Workbench;
const said = () => {
  const text = wb.messages.passing.get();
  wb.messages.passing.set(undefined);
  return text;
};
const cycle = (...times: number[]) => ({ ...channel(...times), extrapolateOut: 'cycle' as const });
const last = { characterId: 'c1', keys: [{ channel: 0, indices: [2] }] };
const walker = () =>
  character({
    skeleton: skeleton(['hips', -1]),
    takes: [take([0, 2], cycle(0, 1, 2), cycle(0, 2), channel(0, 1), restChannel(), restChannel(), restChannel())],
  });

beforeEach(() => {
  ({ wb } = workbench(documentOf(walker()), { timeSeconds: 3 }));
  followPeriods(wb);
  wb.timeline.outsideCycle.set('lengthen');
});

describe('another period', () => {
  it('another period is said of whatever makes it: keying, auto-key, typed times, deleted and added keys', () => {
    keyNow(wb, [{ character: wb.store.document.characters[0], dofs: [0] }]);
    expect(said()).toBe('hips tx now repeats every 3 s instead of every 2 s.');
    wb.store.apply(removeKeys, { characterId: 'c1', keys: [{ channel: 0, indices: [3] }], timeSeconds: 0 });
    expect(said()).toBe('hips tx now repeats every 2 s instead of every 3 s.');
    wb.store.apply(setKeys, { ...last, timeSeconds: 2.5 });
    expect(said()).toBe('hips tx now repeats every 2.5 s instead of every 2 s.');
    wb.store.apply(setDofs, { characterId: 'c1', dofs: [{ index: 1, value: 1 }], timeSeconds: 4, key: {} });
    expect(said()).toBe('hips ty now repeats every 4 s instead of every 2 s.');
    wb.store.apply(addKey, { characterId: 'c1', channel: 1, timeSeconds: 5, value: 0 });
    expect(said()).toBe('hips ty now repeats every 5 s instead of every 4 s.');
    selectKeys(wb, [{ channel: 1, indices: [3] }]);
    nudge(wb, 30, 0);
    expect(said()).toBe('hips ty now repeats every 6 s instead of every 5 s.');
  });

  it('another period is said of several channels at once', () => {
    keyNow(wb, [{ character: wb.store.document.characters[0] }]);
    expect(said()).toBe('2 channels, including hips tx, now repeat every 3 s instead of every 2 s.');
  });

  it('another period is said after what a pose for a moment has keyed, whatever the step is called', () => {
    const args = { characterId: 'c1', dofs: [{ index: 0, value: 1 }], timeSeconds: 0, easeIn: 0.1, easeOut: 0.1 };
    const tried = wb.store.begin('Try');
    tried.preview(keyForMoment.run(tried.base, args));
    tried.commit();
    expect(said()).toBe('Keyed tx of hips for a moment. hips tx now repeats every 2.1 s instead of every 2 s.');
    const drag = wb.store.begin('Move for a moment');
    drag.preview(moveKeys.run(drag.base, { characterId: 'c1', keys: [{ channel: 1, indices: [1] }], seconds: 1 }));
    drag.commit();
    expect(said()).toBe('hips ty now repeats every 3 s instead of every 2 s.');
  });

  it('another period is said at the end of a drag, and not while it lasts nor when it is given up', () => {
    const drag = wb.store.begin('Move');
    drag.preview(moveKeys.run(drag.base, { ...last, seconds: 1 }));
    expect(said()).toBeUndefined();
    drag.preview(moveKeys.run(drag.base, { ...last, seconds: 2 }));
    drag.commit();
    expect(said()).toBe('hips tx now repeats every 4 s instead of every 2 s.');
    const other = wb.store.begin('Move');
    other.preview(moveKeys.run(other.base, { ...last, seconds: 1 }));
    other.cancel();
    expect(said()).toBeUndefined();
  });

  it('another period is not said of channels that come to stand elsewhere, as joints are added, removed or move otherwise', () => {
    const lengths = [1, 1, 1, 2, 2, 2, 3, 3, 3, 4, 4, 4, 5, 5, 5, 6, 6, 6];
    const legs = character({
      skeleton: skeleton(['hips', -1], ['thigh', 0], ['toe', 1], ['tail', 0], ['tip', 3]),
      takes: [take([0, 2], ...lengths.map((length) => cycle(0, length)))],
    });
    ({ wb } = workbench(documentOf(legs)));
    followPeriods(wb);
    const periods = () => shownTake(wb.store.document.characters[0])?.channels.map((c) => keysOf(c).times.at(-1));
    const rigging = { characterId: 'c1', timeSeconds: 0, skin: 'follows' } as const;
    wb.store.apply(addJoint, { ...rigging, parent: 1, offset: [0, 1, 0] });
    expect(periods()?.[15]).toBe(5);
    wb.store.apply(removeJoint, { ...rigging, joint: 2, children: 'too' });
    wb.store.apply(removeJoint, { ...rigging, joint: 2, children: 'too' });
    expect(periods()?.[9]).toBe(5);
    wb.store.apply(setMotion, { ...rigging, joint: 1, motion: { kind: 'hinge', axis: [1, 0, 0] } });
    expect(periods()?.[9]).toBe(5);
    expect(said()).toBeUndefined();
  });

  it('another period is not said of undo and redo, nor of files that are read again', () => {
    keyNow(wb, [{ character: wb.store.document.characters[0], dofs: [0] }]);
    said();
    wb.store.undo();
    wb.store.redo();
    wb.store.replace('Reload', documentOf(walker()));
    expect(said()).toBeUndefined();
  });

  it('another period is none where all keys moved together, nothing repeats, or no two keys are left', () => {
    const all = [{ channel: 0, indices: [0, 1, 2] }];
    wb.store.apply(moveKeys, { characterId: 'c1', keys: all, seconds: 0.1 });
    wb.store.apply(addKey, { characterId: 'c1', channel: 2, timeSeconds: 3, value: 0 });
    wb.store.apply(setExtrapolation, { characterId: 'c1', channels: [2], side: 'out', extrapolation: 'cycle' });
    wb.store.apply(removeKeys, {
      characterId: 'c1',
      keys: [{ channel: 0, indices: [0, 1] }],
      timeSeconds: 0,
    });
    wb.store.apply(removeKeys, { characterId: 'c1', keys: [{ channel: 0, indices: [0] }], timeSeconds: 0 });
    expect(keysOf(shownTake(wb.store.document.characters[0])?.channels[0]).times.length).toBe(0);
    expect(said()).toBeUndefined();
  });
});

it('keying an end of a closed cycle changes both ends in one step, which is said', () => {
  const values = (index: number) => [...keysOf(shownTake(wb.store.document.characters[0])?.channels[index]).values];
  const key = (...dofs: number[]) => {
    const args = dofs.map((index) => ({ index, value: 5 + index }));
    wb.store.apply(setDofs, { characterId: 'c1', dofs: args, timeSeconds: 0, key: {} });
  };
  const before = values(1);
  key(0, 1);
  expect(values(1)).toEqual([6, 6]);
  expect(values(0)[0]).toBe(5);
  expect(values(0).at(-1)).toBe(5);
  expect(said()).toBe('First and last key of 2 cycles, including hips tx, changed together.');
  wb.store.undo();
  expect(values(1)).toEqual(before);
  key(0);
  expect(said()).toBe('First and last key of the cycle of hips tx changed together.');
});
