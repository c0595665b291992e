/** Several joints posed at once: each by the same amount, within its own limits, in one step. */
import fc from 'fast-check';
import { expect, it } from 'vitest';
import { setDofs } from '../../../src/edit/commands/pose.ts';
import { matchingDofs, sameChange } from '../../../src/edit/pose/same-change.ts';
import { Store } from '../../../src/edit/store.ts';
import type { Limit, Motion, Skeleton } from '../../../src/model/skeleton/skeleton.ts';
import { character, documentOf, joint } from '../../ui/builders.ts';

const hinge: Motion = { kind: 'hinge', axis: [0, 1, 0] };
/** Root translation 0 1 2, hips 3 4 5, left 6 7 8, right 9 10 11, and a hinge at 12. */
const bones: Skeleton = {
  name: 'test',
  joints: [
    joint('hips', -1),
    joint('left', 0),
    joint('right', 0),
    { ...joint('knee', 2), motion: hinge, limits: [{ min: -1, max: 1 }], pose: [0] },
  ],
};
const [RX_LEFT, RX_RIGHT] = [6, 9];

it('DOFs match by name and unit, and a joint without such a DOF matches none', () => {
  expect(matchingDofs(bones, [0, 2, 3], RX_LEFT)).toEqual([3, RX_RIGHT]);
  expect(matchingDofs(bones, [2, 1], RX_LEFT)).toEqual([RX_RIGHT]);
  expect(matchingDofs(bones, [1, 2], 12)).toEqual([]);
  expect(matchingDofs(bones, [], RX_LEFT)).toEqual([]);
  expect(matchingDofs(bones, [1, 2], 99)).toEqual([]);
});

it('linked DOFs and quaternion components match nothing', () => {
  const couples = [{ dof: 'rx', joint: 0, follows: 'rx', gain: 1, offset: 0 }];
  const [hips, left, right] = bones.joints;
  const linked = { ...bones, joints: [hips, left, { ...right, couples }] };
  expect(matchingDofs(linked, [0, 2], RX_LEFT)).toEqual([3]);
  expect(matchingDofs(linked, [0, 1], RX_RIGHT)).toEqual([]);
  const quaternion = { motion: { kind: 'quaternion' } as const, limits: [], pose: [0, 0, 0, 1] };
  const turned = { ...bones, joints: [hips, { ...left, ...quaternion }, { ...right, ...quaternion }] };
  expect(matchingDofs(turned, [2], 6)).toEqual([]);
});

const angle = fc.double({ min: -3, max: 3, noNaN: true });
const limit = fc.tuple(angle, angle).map(([a, b]): Limit => ({ min: Math.min(a, b), max: Math.max(a, b) }));

it('a change of several joints is the same amount for each that its limits allow, and one exact undo step', () => {
  fc.assert(
    fc.property(fc.tuple(limit, limit, limit), fc.tuple(angle, angle, angle), angle, (limits, start, by) => {
      const of = [3, RX_LEFT, RX_RIGHT];
      const free = { min: -9, max: 9 };
      const joints = bones.joints.map((one, j) => (j < 3 ? { ...one, limits: [limits[j], free, free] } : one));
      const within = (value: number, k: number) => Math.min(limits[k].max, Math.max(limits[k].min, value));
      const pose = Array<number>(13).fill(0);
      of.forEach((dof, k) => {
        pose[dof] = within(start[k], k);
      });
      const posed = character({ skeleton: { ...bones, joints }, pose, shownTake: -1 });
      const store = new Store(documentOf(posed));
      const before = store.document;
      const dofs = (amount: number) => {
        const own = { index: RX_LEFT, value: pose[RX_LEFT] + amount };
        return [own, ...sameChange(pose, own, matchingDofs(bones, [0, 2], RX_LEFT))];
      };
      const args = (amount: number) => ({ characterId: 'c1', dofs: dofs(amount), timeSeconds: 0 });
      const drag = store.begin('Rotate 3 joints');
      drag.preview(setDofs.run(drag.base, args(by)));
      drag.preview(setDofs.run(drag.base, args(-by)));
      drag.preview(setDofs.run(drag.base, args(by)));
      drag.commit();
      const after = store.document.characters[0].pose;
      of.forEach((dof, k) => {
        expect(after[dof]).toBeCloseTo(within(pose[dof] + by, k), 12);
      });
      if (store.document !== before) {
        store.undo();
        expect(store.document).toEqual(before);
      }
    }),
  );
});

it('a drag of several joints there and back is the identity, though a limit was met on the way', () => {
  const limited = bones.joints.map((one, j) => (j === 2 ? { ...one, limits: [{ min: -0.1, max: 0.1 }] } : one));
  const store = new Store(documentOf(character({ skeleton: { ...bones, joints: limited } })));
  const before = store.document;
  const drag = store.begin('Rotate 2 joints');
  for (const value of [0.5, 2, 0]) {
    const own = { index: RX_LEFT, value };
    const dofs = [own, ...sameChange(before.characters[0].pose, own, [RX_RIGHT])];
    drag.preview(setDofs.run(drag.base, { characterId: 'c1', dofs, timeSeconds: 0 }));
    expect(store.document.characters[0].pose[RX_RIGHT]).toBe(Math.min(0.1, value));
  }
  drag.commit();
  expect(store.document).toBe(before);
  expect(store.undoLabel).toBeUndefined();
});
