import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { branchEnd, canHangOn, possibleParents } from '../../../src/edit/rig/parents.ts';
import { skeleton } from '../../ui/builders.ts';

//   0 root
//   1   spine
//   2     head
//   3   leg_l
//   4     foot_l
//   5   leg_r
const { joints } = skeleton(['root', -1], ['spine', 0], ['head', 1], ['leg_l', 0], ['foot_l', 3], ['leg_r', 0]);

describe('valid parents of a joint', () => {
  it('valid parents of a joint are all but itself and its descendants', () => {
    expect(possibleParents(joints, 3)).toEqual([0, 1, 2, 5]);
    expect(possibleParents(joints, 2)).toEqual([0, 1, 3, 4, 5]);
  });

  it('valid parents of a joint do not exist for the root, and for missing joints', () => {
    expect(possibleParents(joints, 0)).toEqual([]);
    expect([canHangOn(joints, 9, 0), canHangOn(joints, 1, -1), canHangOn(joints, 1, 9)]).toEqual([false, false, false]);
  });

  it('valid parents of a joint never lets a joint hang on its own branch, however the tree is', () => {
    const trees = fc
      .array(fc.nat(), { minLength: 1, maxLength: 30 })
      .map((picks) => preOrder(picks.map((pick, i) => (i === 0 ? -1 : pick % i))));
    fc.assert(
      fc.property(trees, fc.nat(), (tree, pick) => {
        const joint = pick % tree.length;
        const below = new Set([joint]);
        tree.forEach(({ parent }, j) => {
          if (below.has(parent)) below.add(j);
        });
        expect(branchEnd(tree, joint) - joint).toBe(below.size);
        for (const parent of possibleParents(tree, joint)) expect(below.has(parent)).toBe(false);
      }),
    );
  });
});

/** Any tree, its joints in depth-first order. */
function preOrder(parents: readonly number[]): { parent: number }[] {
  const made: { parent: number }[] = [];
  const walk = (node: number, parent: number) => {
    const index = made.push({ parent }) - 1;
    parents.forEach((above, child) => {
      if (above === node) walk(child, index);
    });
  };
  walk(0, -1);
  return made;
}
