import { afterEach, beforeEach, describe, expect, it } from 'vitest';
import { setStiffness } from '../../../../src/edit/commands/ik.ts';
import type { Vec3 } from '../../../../src/math/vec3.ts';
import { solvePins } from '../../../../src/ui/editors/ik/solve-pins.ts';
import { documentOf } from '../../builders.ts';
import { apart, body, FORE_L, HAND_L, HAND_R, ikPage, pin } from './ik-page.ts';

/** Of a body that is 6 wide. */
const THERE = 1e-3;

let page: ReturnType<typeof ikPage>;
beforeEach(() => {
  page = ikPage();
});
afterEach(() => page.stop());

/** As if an earlier drag had left the left hand's target there. */
function wantLeftHandAt(position: Vec3): void {
  const { wb } = page;
  const [{ ik }] = wb.store.document.characters;
  const targets = new Map([[1, { position }]]);
  wb.posing.ik.targets.leave('c1', { pins: ik?.pins ?? [] }, Float64Array.from(page.pose()), targets, {
    binding: [],
    holders: [],
    locks: [],
    canMove: true,
    rootStays: false,
  });
}
const solve = () => solvePins(page.wb, page.wb.store.document.characters[0]);
const said = () => page.wb.messages.passing.get();

describe('solving all pins', () => {
  it('brings pins to their targets, however far, in one undo step', () => {
    const { wb, placeOf, pose } = page;
    const before = pose();
    wantLeftHandAt([-1, 1.5, 0.5]);
    solve();
    expect(apart(placeOf(HAND_L), [-1, 1.5, 0.5])).toBeLessThan(THERE);
    expect(apart(placeOf(HAND_R), [-3, 0, 0])).toBeLessThan(THERE);
    expect(said()).toBeUndefined();
    expect(wb.store.undoLabel).toBe('Re-solve pins of wasp');
    wb.store.undo();
    expect(pose()).toEqual(before);
    expect(wb.store.undoLabel).toBeUndefined();
  });

  it('reports if there is nothing to do', () => {
    solve();
    expect(page.wb.store.undoLabel).toBeUndefined();
    expect(said()).toBe('All pins are reached.');
  });

  it('names unreachable pins, and keeps their targets', () => {
    const { wb } = page;
    wantLeftHandAt([30, 0, 0]);
    solve();
    expect(said()).toMatch(/^hand_[lr] is as close as possible: out of reach\.$/);
    const left = wb.posing.ik.targets.leftOf('c1', Float64Array.from(page.pose()));
    expect(left?.targets.get(1)?.target.position).toEqual([30, 0, 0]);
  });

  it('names the lock that keeps a pin from its target', () => {
    page.stop();
    const ik = { pins: [pin(1, HAND_L)], stiff: [{ joint: FORE_L }], rootIsFree: false };
    page = ikPage(documentOf(body({ ik })));
    // Closer to the centre than a straight arm gets.
    wantLeftHandAt([0.3, 0.2, 0]);
    solve();
    expect(said()).toBe('hand_l is as close as possible: fore_l is locked.');
  });

  it('solving all pins keeps locked joints', () => {
    const { wb } = page;
    wb.store.apply(setStiffness, { characterId: 'c1', joints: [2], stiffness: 'locked' });
    wantLeftHandAt([2, 1, 0]);
    const dofs = [9, 10, 11];
    const before = dofs.map((dof) => page.pose()[dof]);
    solve();
    expect(apart(page.placeOf(HAND_L), [2, 1, 0])).toBeLessThan(THERE);
    expect(dofs.map((dof) => page.pose()[dof])).toEqual(before);
  });
});
