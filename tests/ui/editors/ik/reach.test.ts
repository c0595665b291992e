import { afterEach, beforeEach, describe, expect, it } from 'vitest';
import { HandPull } from '../../../../src/ui/editors/ik/hand-pull.ts';
import { whatMoves } from '../../../../src/ui/editors/ik/reach.ts';
import { runAction, tryById } from '../../../../src/ui/state/actions/action.ts';
import { documentOf } from '../../builders.ts';
import { BODY, BODY_JOINT, body, FORE_L, HAND_L, ikPage } from './ik-page.ts';

const FREE = { pins: [], stiff: [], rootIsFree: true };

let page: ReturnType<typeof ikPage>;
beforeEach(() => {
  page = ikPage(documentOf(body({ ik: FREE })));
});
afterEach(() => page.stop());

const set = (args: Readonly<Record<string, unknown>>) => runAction(page.wb, 'ik.setReach', args);
const reach = () => page.wb.settings.get().ikReach;
const moves = (joint: number) => whatMoves(page.wb, 'c1', joint);

/** Indices of the DOFs that a drag of a hand changes. */
function changed(joint: number): number[] {
  const before = page.pose();
  const hand = HandPull.begin(page.wb, { characterId: 'c1', placement: 0, joint, point: [0, 0, 0] });
  if (!hand) throw new Error('There is something to be dragged.');
  const [x, y, z] = hand.hand;
  for (let i = 1; i <= 5; i++) hand.to([x - 0.05 * i, y + 0.1 * i, z]);
  hand.finish();
  const dofs = [...page.pose().keys()].filter((dof) => page.pose()[dof] !== before[dof]);
  page.wb.store.undo();
  return dofs;
}

describe('the reach of IK', () => {
  it('is a limb until one is chosen, and names what a drag would move', async () => {
    expect(moves(HAND_L)).toBe('Bend arm_l to hand_l');
    // Three DOFs of the root's translation, three of each joint; arm_l is joint 1.
    expect(changed(HAND_L).every((dof) => dof >= 6 && dof < 15)).toBe(true);
    await set({ reach: 'body' });
    expect(moves(HAND_L)).toBe('Move the body while 1 foot holds');
    expect(changed(HAND_L).some((dof) => dof < 6)).toBe(true);
    await set({ reach: 'chain', top: FORE_L });
    expect(moves(HAND_L)).toBe('Bend fore_l to hand_l');
    expect(changed(HAND_L).every((dof) => dof >= 9 && dof < 15)).toBe(true);
    // That joint is not above the hips, which are the body.
    expect(moves(BODY_JOINT)).toBe('Move the body while 2 feet hold');
  });

  it('is no undo step, and toggles without arguments', async () => {
    await set({});
    expect(reach()).toBe('body');
    await set({});
    expect(reach()).toBe('limb');
    expect(page.wb.store.undoLabel).toBeUndefined();
  });

  it('ends a chain at the selected joint, else at the root', async () => {
    await set({ reach: 'chain' });
    expect(moves(HAND_L)).toBe('Bend body to hand_l');
    page.wb.store.select({ characterId: 'c1', joint: HAND_L });
    tryById(page.wb, 'ik.reachChain');
    await expect.poll(() => moves(HAND_L)).toBe('Bend hand_l alone');
  });

  it('refuses other arguments in words, and changes nothing', async () => {
    await expect(set({ reach: 'arm' })).rejects.toThrow('"reach" must be one of "limb", "body", "chain", found "arm".');
    await expect(set({ reach: 'chain', top: 7 })).rejects.toThrow('there are 7 joints, found 7');
    await expect(set({ top: 1 })).rejects.toThrow('"reach" must be one of');
    expect(reach()).toBe('usual');
  });

  it('is everything up to the root in IK mode for the axis-angle form until one is chosen', async () => {
    page.stop();
    page = ikPage(documentOf(body({ skeleton: { ...BODY, form: 'axis-angle' }, ik: FREE })));
    expect(moves(HAND_L)).not.toBe('Bend all up to the root');
    page.wb.posing.mode.set('ik');
    expect(moves(HAND_L)).toBe('Bend all up to the root');
    expect(changed(HAND_L).some((dof) => dof < 6)).toBe(true);
    await set({ reach: 'limb' });
    expect(changed(HAND_L).every((dof) => dof >= 6)).toBe(true);
  });
});
