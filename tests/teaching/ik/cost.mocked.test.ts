/** How much is computed to judge a solver, by how many matrices of joints are written: it grows with the joints alone. */
import { beforeEach, describe, expect, it, vi } from 'vitest';
import type { Vec3 } from '../../../src/math/vec3.ts';
import { compareGoal } from '../../../src/teaching/ik/compare-goal.ts';
import { SolverStart } from '../../../src/teaching/ik/start.ts';
import { bestLength, transposed } from '../../../src/teaching/ik/steps.ts';
import { characterFrom } from '../lesson-files.ts';

const written = vi.hoisted(() => ({ matrices: 0 }));
vi.mock(import('../../../src/evaluate/kinematics.ts'), async (original) => {
  const real = await original();
  return {
    ...real,
    worldMatrices: (skeleton, dofs, world, rotations) => {
      written.matrices += skeleton.jointCount;
      real.worldMatrices(skeleton, dofs, world, rotations);
    },
    writeLocal: (...all) => {
      written.matrices++;
      real.writeLocal(...all);
    },
  };
});
vi.mock(import('../../../src/evaluate/ik/chain.ts'), async (original) => {
  const real = await original();
  return {
    ...real,
    writeMatrices: (problem, ...others) => {
      written.matrices += problem.slots.count;
      real.writeMatrices(problem, ...others);
    },
  };
});
beforeEach(() => {
  written.matrices = 0;
});

/** A chain, or limbs of six joints on a spine of a fourth of them, turned by ever other angles. */
function skeletonOf(count: number, isChain: boolean): string {
  const spine = isChain ? count : Math.ceil(count / 4);
  const children = Array.from({ length: count }, (): number[] => []);
  for (let j = 1; j < count; j++) {
    const limb = (j - spine) % 6;
    children[j < spine ? j - 1 : limb === 0 ? (j - spine) / 6 : j - 1].push(j);
  }
  const text = (j: number): string => {
    const own =
      j % 3 === 1
        ? `hingejoint j${j} { axis 1 0 ${j % 2} pose ${0.1 + 0.02 * (j % 7)}`
        : `balljoint j${j} { pose ${0.05 * (j % 4)} ${0.03 * (j % 5)} -0.04`;
    return `${own} offset ${j % 2 ? 0.1 : 0.05} 0.3 ${0.02 * (j % 5)} ${children[j].map(text).join(' ')} }`;
  };
  return text(0);
}

/** Matrices of each joint: a few hundred for each kind of step that is tried, for eight points. */
const MAX_EACH = 6000;
const CASES = ['a solution', 'another pose', 'a step', 'a step for another point', 'any step'] as const;

function costOf(count: number, isChain: boolean, what: (typeof CASES)[number], kind: 'world' | 'positions') {
  const character = characterFrom('long.skel', skeletonOf(count, isChain));
  const { skeleton } = character;
  if (!skeleton) throw new Error('It has no skeleton.');
  const start = new SolverStart(character, skeleton, undefined);
  const joint = count - 2;
  const [x, y, z] = start.matrices(start.pose).subarray(16 * joint + 12);
  const at = (index: number) => ({ joint: index, point: [0, 0, 0] as const });
  const target: Vec3 = what === 'a solution' ? [x, y, z] : [0.8 * x + 0.2, 0.85 * y, z + 0.2];
  const stepFor = (index: number) => {
    const seen = start.see(at(index), target);
    return transposed(seen).map((part) => 0.5 * bestLength(seen) * part);
  };
  const any = start.variables.map((_, v) => 0.05 * Math.sin(7.1 * v));
  const other = skeleton.joints[skeleton.joints[joint].parent].parent;
  const steps = {
    'a solution': any.map(() => 0),
    'another pose': any,
    'a step': stepFor(joint),
    'a step for another point': stepFor(other),
    'any step': any,
  };
  const world = start.matrices(start.after(steps[what])).slice();
  const positions = Float64Array.from({ length: 3 * count }, (_, i) => world[16 * Math.floor(i / 3) + 12 + (i % 3)]);
  const numbers = kind === 'world' ? { world } : { positions };
  written.matrices = 0;
  const goal = { ...at(joint), target };
  const found = compareGoal(character, skeleton, { time: undefined, ...numbers }, goal, what.includes('step'), 1e-4);
  return { written: written.matrices, agrees: found.agrees, codes: found.causes.map(({ code }) => code) };
}

describe.each([true, false])('a skeleton that is one chain (%s)', (isChain) => {
  describe.each(['world', 'positions'] as const)('by %s', (kind) => {
    it.each(CASES)('takes no more for each joint, however many there are: %s', (what) => {
      for (const count of [24, 192]) {
        const { written: matrices, agrees, codes } = costOf(count, isChain, what, kind);
        expect(agrees).toBe(what === 'a solution' || what === 'a step');
        if (what === 'a step for another point') expect(codes).toEqual(['ik-end-effector']);
        expect(matrices / count).toBeLessThan(MAX_EACH);
      }
    });
  });
});
