/** Actions on all selected joints: keys, poses, pins and the skeleton, each in one step. */
import { describe, expect, it } from 'vitest';
import { withJoints } from '../../../../src/model/skeleton/joint-selection.ts';
import { keysOf } from '../../../../src/model/takes/take.ts';
import { actionLabel, actionsOf } from '../../../../src/ui/state/actions/action.ts';
import { character, documentOf, skeleton, workbench } from '../../builders.ts';

const offsets = [
  [0, 1, 0],
  [1, 0, 0],
  [0, -1, 0],
  [-1, 0, 0],
  [0, -1, 0],
] as const;
const bare = skeleton(['hips', -1], ['leg_l', 0], ['foot_l', 1], ['leg_r', 0], ['foot_r', 3]);
const bones = { ...bare, joints: bare.joints.map((one, j) => ({ ...one, offset: offsets[j] })) };
/** Root translation 0 1 2, hips 3, leg_l 6, foot_l 9, leg_r 12, foot_r 15. */
const POSE = Array.from({ length: 18 }, (_, dof) => (dof < 6 ? 0 : 0.01 * dof));

function selecting(...joints: readonly number[]) {
  return selectingIn(bones, joints);
}

function selectingIn(rig: typeof bones, joints: readonly number[]) {
  const before = documentOf(character({ skeleton: rig, pose: POSE, shownTake: -1 }));
  const { wb } = workbench(before);
  wb.store.select(withJoints({ characterId: 'c1' }, joints));
  const action = (id: string) => {
    const found = actionsOf(wb).find((a) => a.id === id);
    if (!found) throw new Error(`There is no ${id}.`);
    return found;
  };
  return {
    wb,
    now: () => wb.store.document.characters[0],
    names: () => wb.store.document.characters[0].skeleton?.joints.map(({ name }) => name),
    label: (id: string) => actionLabel(wb, action(id)),
    run: async (id: string) => action(id).run(wb),
    /** Everything is as it was after one undo. */
    expectOneStep() {
      wb.store.undo();
      expect(wb.store.document).toEqual(before);
      expect(wb.store.undoLabel).toBeUndefined();
    },
  };
}

describe('actions on several selected joints', () => {
  it('keys of several joints are made and deleted together', async () => {
    const { now, run, label, wb } = selecting(4, 1);
    expect(label('key.joint')).toBe('Key all DOFs of 2 joints');
    await run('key.joint');
    const keyed = () => now().takes[0].channels.flatMap((c, i) => (keysOf(c).times.length ? i : []));
    expect(keyed()).toEqual([6, 7, 8, 15, 16, 17]);
    wb.store.select(withJoints({ characterId: 'c1' }, [4, 2]));
    await run('key.deleteJointHere');
    expect(keyed()).toEqual([6, 7, 8]);
  });

  it('K keys the selected joints where nothing was changed', async () => {
    const { now, run } = selecting(2, 3);
    await run('key.changed');
    expect(now().takes[0].channels.flatMap((c, i) => (keysOf(c).times.length ? i : []))).toEqual([
      9, 10, 11, 12, 13, 14,
    ]);
  });

  it('several joints are reset to the file pose in one step, the others stay', async () => {
    const { now, run, label, wb, expectOneStep } = selecting(1, 4);
    expect(label('pose.resetJoints')).toBe('Reset 2 joints to file pose');
    await run('pose.resetJoints');
    expect(now().pose).toEqual(POSE.map((value, dof) => ((dof >= 6 && dof < 9) || dof >= 15 ? 0 : value)));
    expect(wb.store.undoLabel).toBe('Reset 2 joints to file pose');
    expectOneStep();
  });

  it('the copied pose of several joints changes only these when it is pasted', async () => {
    const { now, run, label } = selecting(1, 4);
    expect(label('pose.copyJoints')).toBe('Copy pose of 2 joints');
    await run('pose.copyJoints');
    await run('pose.resetToFile');
    await run('pose.paste');
    expect(now().pose).toEqual(POSE.map((value, dof) => ((dof >= 6 && dof < 9) || dof >= 15 ? value : 0)));
  });

  it.each(['leg', ''])('the copied pose of one of several joints called "%s" is pasted on that one', async (name) => {
    const alike = { ...bones, joints: bones.joints.map((one) => ({ ...one, name })) };
    const { now, run, wb } = selectingIn(alike, [3]);
    await run('pose.copyJoints');
    await run('pose.resetToFile');
    await run('pose.paste');
    expect(now().pose).toEqual(POSE.map((value, dof) => (dof >= 12 && dof < 15 ? value : 0)));
    expect(wb.messages.passing.get() ?? '').not.toContain('skipped');
  });

  it('the copied pose of a joint that the other character lacks is told by this joint alone', async () => {
    const { wb, run } = selecting(1, 4);
    await run('pose.copyJoints');
    const short = { ...bones, joints: bones.joints.slice(0, 2) };
    wb.store.replace('Open', documentOf(character({ skeleton: short, pose: POSE.slice(0, 9), shownTake: -1 })));
    await run('pose.resetToFile');
    await run('pose.paste');
    expect(wb.messages.list.get().at(-1)?.text ?? wb.messages.passing.get()).toContain(
      'Pasted 1 joint; wasp has no “foot_r”, which was skipped.',
    );
  });

  it('mirroring both legs swaps them once, as mirroring either does', async () => {
    const one = selecting(1);
    await one.run('pose.mirrorBranch');
    const both = selecting(1, 2, 3);
    await both.run('pose.mirrorBranch');
    expect(both.now().pose).toEqual(one.now().pose);
    expect(both.now().pose).not.toEqual(POSE);
    both.expectOneStep();
  });

  it('both sides can’t be copied to each other, and a message says so', async () => {
    const { wb, run } = selecting(1, 3);
    const before = wb.store.document;
    await run('pose.copyToOther');
    expect(wb.store.document).toBe(before);
    expect(wb.messages.list.get().at(-1)?.text ?? wb.messages.passing.get()).toContain('Both sides are selected');
  });

  it('several joints are pinned and locked together; again unpins and unlocks them', async () => {
    const { now, run, label } = selecting(2, 4);
    expect(label('ik.pinJoint')).toBe('Pin 2 joints');
    await run('ik.pinJoint');
    expect(now().ik?.pins.map((pin) => pin.joint)).toEqual([2, 4]);
    expect(label('ik.pinJoint')).toBe('Unpin 2 joints');
    await run('ik.pinJoint');
    expect(now().ik?.pins ?? []).toEqual([]);
    const locks = selecting(2, 4);
    await locks.run('ik.lockJoint');
    expect(locks.now().ik?.stiff.map((one) => one.joint)).toEqual([2, 4]);
    locks.expectOneStep();
  });

  it('one pinned joint among several leaves the others to be pinned', async () => {
    const { wb, now, run } = selecting(2);
    await run('ik.pinJoint');
    wb.store.select(withJoints({ characterId: 'c1' }, [2, 4]));
    await run('ik.pinJoint');
    expect(now().ik?.pins.map((pin) => pin.joint)).toEqual([2, 4]);
  });

  it('several joints are deleted in one step, with or without their descendants', async () => {
    const kept = selecting(3, 1);
    kept.wb.posing.mode.set('rig');
    expect(kept.label('rigging.delete')).toBe('Delete 2 joints, keep children');
    await kept.run('rigging.delete');
    expect(kept.names()).toEqual(['hips', 'foot_l', 'foot_r']);
    expect(kept.wb.store.selection).toEqual({ characterId: 'c1', joint: 0 });
    kept.expectOneStep();
    const all = selecting(1, 2, 3);
    all.wb.posing.mode.set('rig');
    await all.run('rigging.deleteBranch');
    expect(all.names()).toEqual(['hips']);
    all.expectOneStep();
  });
});
