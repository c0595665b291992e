/** Selecting joints from those selected, by actions and keys. */
import { expect, it } from 'vitest';
import { withJoints } from '../../../src/model/skeleton/joint-selection.ts';
import { jointsIn } from '../../../src/model/skeleton/selected-joints.ts';
import { listedChannels } from '../../../src/ui/editors/timeline/channels.ts';
import { actionsOf, tryAction } from '../../../src/ui/state/actions/action.ts';
import { addsToSelection, selectHit } from '../../../src/ui/state/joints/select-joints.ts';
import { character, documentOf, joint, workbench } from '../builders.ts';

const at = (name: string, parent: number, x: number) => ({ ...joint(name, parent), offset: [x, 1, 0] as const });
const bones = {
  name: 'test',
  joints: [
    at('hips', -1, 0),
    at('leg_l', 0, 1),
    at('foot_l', 1, 0),
    at('leg_r', 0, -1),
    at('foot_r', 3, 0),
    at('head', 0, 0),
  ],
};
const walker = character({ skeleton: bones });

function selecting(...joints: readonly number[]) {
  const { wb } = workbench(documentOf(walker));
  wb.store.select(withJoints({ characterId: 'c1' }, joints));
  const run = async (id: string) => {
    const action = actionsOf(wb).find((a) => a.id === id);
    if (!action) throw new Error(`There is no ${id}.`);
    await action.run(wb);
    return jointsIn(wb.store.selection);
  };
  return { wb, run };
}

it('a hierarchy is selected from each selected joint on, and the active joint stays active', async () => {
  expect(await selecting(3, 1).run('select.hierarchy')).toEqual([3, 2, 4, 1]);
  expect(await selecting(0).run('select.hierarchy')).toEqual([1, 2, 3, 4, 5, 0]);
});

it('mirrored joints are selected instead of theirs; twice is the identity', async () => {
  const { run } = selecting(2, 5, 1);
  expect(await run('select.mirrored')).toEqual([4, 5, 3]);
  expect(await run('select.mirrored')).toEqual([2, 5, 1]);
});

it('all joints are selected, with the active one still active', async () => {
  const { run } = selecting(2);
  expect(await run('select.allJoints')).toEqual([0, 1, 3, 4, 5, 2]);
});

it('parents, children and siblings are selected for each selected joint that has one', async () => {
  expect(await selecting(2, 4).run('select.parent')).toEqual([1, 3]);
  expect(await selecting(1, 3).run('select.parent')).toEqual([0]);
  expect(await selecting(1, 2, 3).run('select.child')).toEqual([2, 4]);
  expect(await selecting(1).run('select.nextSibling')).toEqual([3]);
});

it('Escape leaves the active of several selected joints, then none', async () => {
  const { run, wb } = selecting(1, 2, 3);
  expect(await run('posing.leave')).toEqual([3]);
  expect(wb.store.selection).toEqual({ characterId: 'c1', joint: 3 });
  await run('posing.leave');
  expect(wb.store.selection).toEqual({});
});

it('what selects no other joint says so', () => {
  const { wb } = selecting(5);
  const action = actionsOf(wb).find((a) => a.id === 'select.hierarchy');
  if (action) tryAction(wb, action);
  expect(wb.messages.passing.get()).toContain('already');
});

it('a click with Shift or Ctrl adds a joint, but for what the mode does with that key', () => {
  const { wb } = selecting(1);
  const keys = { shiftKey: false, ctrlKey: false, metaKey: false };
  const adds = (mode: 'fk' | 'ik' | 'rig' | 'select') => {
    wb.posing.mode.set(mode);
    return [keys, { ...keys, shiftKey: true }, { ...keys, ctrlKey: true }, { ...keys, metaKey: true }].map((pressed) =>
      addsToSelection(wb, pressed),
    );
  };
  expect(adds('fk')).toEqual([false, true, true, true]);
  expect(adds('select')).toEqual([false, true, true, true]);
  expect(adds('ik')).toEqual([false, false, true, true]);
  expect(adds('rig')).toEqual([false, true, false, false]);
});

it('a click on the ground keeps the joints only if it would have added one', () => {
  const { wb } = selecting(1, 3);
  selectHit(wb, undefined, true);
  expect(jointsIn(wb.store.selection)).toEqual([1, 3]);
  selectHit(wb, { characterId: 'c1', placement: 0, joint: 1, vertex: 7 }, true);
  expect(wb.store.selection).toEqual({ characterId: 'c1', placement: 0, joint: 3 });
  selectHit(wb, undefined, false);
  expect(wb.store.selection).toEqual({ characterId: 'c1' });
});

it('the timeline lists the channels of all selected joints, in the order of the character', () => {
  const list = { list: 'selected', pinned: [], filter: '' } as const;
  const listed = listedChannels(walker, { characterId: 'c1', joint: 1, others: [3] }, list);
  expect(listed.map((c) => c.channel)).toEqual([6, 7, 8, 12, 13, 14]);
});
