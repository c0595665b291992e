/** What is done to joints of several selected characters. */
import { beforeEach, describe, expect, it, vi } from 'vitest';
import { addSet, setLocked } from '../../src/edit/commands/beside/sets.ts';
import { removeCharacter } from '../../src/edit/commands/characters.ts';
import { setDofs, tweenPose } from '../../src/edit/commands/pose.ts';
import { onEachCharacter } from '../../src/edit/in-turn.ts';
import { nextKey, previousKey, shownKeys } from '../../src/evaluate/plot/shown-keys.ts';
import { shownTake } from '../../src/model/document.ts';
import { keysOf } from '../../src/model/takes/take.ts';
import { meantOfEach } from '../../src/ui/editors/posing/pose-edits.ts';
import { followPeriods } from '../../src/ui/editors/timeline/period.ts';
import { runAction } from '../../src/ui/state/actions/action.ts';
import { allJointsText } from '../../src/ui/state/joints/selected-joint.ts';
import type { Workbench } from '../../src/ui/state/workbench.ts';
import { capture, character, documentOf } from './builders.ts';
import { OFFSET, withTwoCharacters } from './two-characters.ts';

let wb: Workbench;
const timesOf = (character: number, channel: number) => {
  const one = wb.store.document.characters[character];
  return [...keysOf(shownTake(one)?.channels[channel]).times];
};
const seek = (timeSeconds: number) => wb.transport.update((p) => ({ ...p, timeSeconds }));

beforeEach(() => {
  wb = withTwoCharacters();
});

describe('keys of the selected joints of several characters', () => {
  it.each(['key.changed', 'key.joint'])('%s keys those of each in one step, at the time of its own take', (id) => {
    const before = wb.store.document;
    seek(0.3);
    runAction(wb, id);
    expect(wb.store.undoLabel).toBe('Key pose of 2 characters');
    expect(timesOf(0, 6)).toEqual([0, 0.3, 1]);
    expect(timesOf(1, 6)).toEqual([0.5, 0.3 + OFFSET, 1]);
    expect(timesOf(0, 0)).toEqual([0, 1, 2]);
    expect(wb.store.selection.beside?.[0].keys?.[0]).toEqual({ channel: 6, indices: [1] });
    expect(wb.store.selection.keys?.[0]).toEqual({ channel: 6, indices: [1] });
    wb.store.undo();
    expect(wb.store.document).toEqual(before);
    expect(wb.store.undoLabel).toBeUndefined();
  });

  it('what was changed by hand is keyed, of either, and nothing else', () => {
    seek(0.3);
    wb.store.apply(setDofs, { characterId: 'walker', dofs: [{ index: 3, value: 1 }], timeSeconds: 0.3 });
    runAction(wb, 'key.changed');
    expect([timesOf(0, 3), timesOf(0, 6), timesOf(1, 6)]).toEqual([
      [0.3, 1],
      [0, 1],
      [0.5, 1],
    ]);
  });

  it('in a drag of the bar they are tweened together', () => {
    const each = ['walker', 'flyer'].map((characterId) => ({
      characterId,
      timeSeconds: 0.25,
      dofs: [6],
      u: 1,
      key: {},
    }));
    const command = onEachCharacter(tweenPose, 'Tween 2 characters');
    const before = wb.store.document;
    wb.store.apply(command, each);
    expect([timesOf(0, 6), timesOf(1, 6)]).toEqual([
      [0, 0.25, 1],
      [0.5, 0.75, 1],
    ]);
    expect(wb.store.undoLabel).toBe('Tween 2 characters');
    wb.store.undo();
    expect(wb.store.document).toEqual(before);
  });

  it('without joints the bar tweens the whole of each, as Shift+K keys it', () => {
    expect(meantOfEach(wb).map(({ dofs }) => dofs)).toEqual([
      [6, 7, 8],
      [6, 7, 8],
    ]);
    wb.store.select({ characterId: 'flyer', beside: [{ characterId: 'walker' }] });
    expect(meantOfEach(wb).map(({ character: { id }, dofs }) => [id, dofs])).toEqual([
      ['walker', undefined],
      ['flyer', undefined],
    ]);
  });

  it('of several captures, keying one is offered, and the others are named', async () => {
    wb.store.replace('Open', {
      ...wb.store.document,
      characters: wb.store.document.characters.map((one) => ({ ...one, takes: [capture(9, 0.1, 11)] })),
    });
    runAction(wb, 'key.joint');
    await vi.waitFor(() => expect(wb.messages.passing.get()).toBeDefined());
    expect(wb.messages.passing.get()).toBe(
      'The 3 curves of wing of Flyer are sampled: they have a value at every frame, and no single keys. So are those of Walker: select it alone to key them.',
    );
  });

  it('of one whose DOFs are all locked they are left alone and counted, and refused if those of all are', () => {
    const told: (number | undefined)[] = [];
    wb.store.onStep((_now, _before, { locked }) => void told.push(locked));
    seek(0.3);
    wb.store.apply(setLocked, { characterId: 'flyer', dofs: [6, 7, 8], locked: true });
    runAction(wb, 'key.joint');
    expect([timesOf(0, 6), timesOf(1, 6)]).toEqual([
      [0, 0.3, 1],
      [0.5, 1],
    ]);
    expect(told.at(-1)).toBe(3);
    wb.store.apply(setLocked, { characterId: 'walker', dofs: [6, 7, 8], locked: true });
    expect(() => runAction(wb, 'key.joint')).toThrow('All 6 DOFs are locked.');
  });

  it('what became of the cycles is told of each', () => {
    runAction(wb, 'timeline.extrapolation.both.cycle');
    const end = followPeriods(wb);
    wb.timeline.outsideCycle.set('lengthen');
    seek(1.5);
    runAction(wb, 'key.joint');
    expect(wb.messages.passing.get()).toBe(
      'Walker: leg rx now repeats every 1.5 s instead of every 1 s. Flyer: wing rx now repeats every 1.5 s instead of every 0.5 s.',
    );
    end();
  });

  it('the whole pose is keyed of each that has a skeleton', () => {
    seek(0.3);
    wb.store.replace('Add', documentOf(...wb.store.document.characters, character({ id: 'prop', name: 'Prop' })));
    wb.store.select({ ...wb.store.selection, beside: [{ characterId: 'prop' }, { characterId: 'walker' }] });
    runAction(wb, 'key.pose');
    expect([timesOf(0, 3), timesOf(1, 3)]).toEqual([
      [0.3, 1],
      [0.5, 0.8],
    ]);
  });

  it('keys at the current time are deleted of each in one step', () => {
    seek(0);
    runAction(wb, 'key.deleteJointHere');
    expect([timesOf(0, 6), timesOf(1, 6)]).toEqual([[1], [1]]);
    expect([timesOf(0, 0), timesOf(1, 1)]).toEqual([
      [0, 1, 2],
      [0.5, 1.5],
    ]);
    wb.store.undo();
    runAction(wb, 'key.deleteHere');
    expect([timesOf(0, 0), timesOf(1, 1)]).toEqual([[1, 2], [1.5]]);
  });

  it('the transport steps through the keys of all of them', () => {
    const keys = shownKeys(wb.store.document, wb.store.selection);
    expect(keys.filter(({ meant }) => meant)).toHaveLength(2);
    expect(nextKey(keys, 0)).toBe(1 - OFFSET);
    expect(nextKey(keys, 1 - OFFSET)).toBe(1);
    expect(previousKey(keys, 1)).toBe(1 - OFFSET);
  });
});

describe('the selection of several characters', () => {
  it('its joints are counted with their characters', () => {
    expect(allJointsText(wb)).toBe('2 joints of 2 characters');
  });

  it('what is for the active character alone says so, and no more', () => {
    const labelOf = (id: string) => wb.actions.all().flatMap((one) => (one.id === id ? wb.actions.label(one) : []));
    const ofAll = wb.actions.all().filter((action) => wb.actions.label(action).includes('of 2 characters'));
    expect(ofAll.map(({ id }) => id).sort()).toEqual(['key.deleteJointHere', 'key.joint', 'timeline.jointCurves']);
    expect(labelOf('pose.resetJoints')).toEqual(['Reset wing of Flyer to file pose']);
    wb.store.select({ characterId: 'flyer', joint: 1, beside: [{ characterId: 'walker' }] });
    expect(labelOf('pose.resetJoints')).toEqual(['Reset wing to file pose']);
  });

  it('joints are selected from those of each, and all joints of each', () => {
    runAction(wb, 'select.parent');
    expect(wb.store.selection).toMatchObject({ characterId: 'flyer', joint: 0, beside: [{ joint: 0 }] });
    runAction(wb, 'select.allJoints');
    expect(allJointsText(wb)).toBe('4 joints of 2 characters');
  });

  it('a set that is added leaves the joints of others selected', () => {
    wb.store.apply(addSet, { characterId: 'flyer', name: 'all', joints: [0, 1] });
    runAction(wb, 'sets.select', { set: 0, add: true });
    expect(allJointsText(wb)).toBe('3 joints of 2 characters');
    runAction(wb, 'sets.select', { set: 0 });
    expect(wb.store.selection).toEqual({ characterId: 'flyer', joint: 1, others: [0] });
  });

  it('a removed character leaves it, and undo brings it back', () => {
    const before = wb.store.selection;
    wb.store.apply(removeCharacter, { characterId: 'walker' });
    expect(wb.store.selection).toEqual({ characterId: 'flyer', joint: 1 });
    wb.store.undo();
    expect(wb.store.selection).toEqual(before);
    wb.store.apply(removeCharacter, { characterId: 'flyer' });
    expect(wb.store.selection).toEqual({ characterId: 'walker', joint: 1 });
  });
});
