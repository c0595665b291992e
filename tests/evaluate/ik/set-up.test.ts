import { describe, expect, it } from 'vitest';
import { IkError } from '../../../src/evaluate/ik/pins.ts';
import { ikProblem } from '../../../src/evaluate/ik/problem.ts';
import {
  draggedIndex,
  ikOf,
  ikPinsOf,
  pinTargets,
  pointAt,
  reachOfSkeleton,
  rootHold,
  stiffnessOf,
} from '../../../src/evaluate/ik/set-up.ts';
import { solve } from '../../../src/evaluate/ik/solve.ts';
import { compileSkeleton, worldMatrices } from '../../../src/evaluate/kinematics.ts';
import type { Pin } from '../../../src/model/ik.ts';
import { filePose } from '../../../src/model/skeleton/dofs.ts';
import type { Skeleton } from '../../../src/model/skeleton/skeleton.ts';
import { joint, skeleton } from '../../helpers/builders.ts';

const CHAIN = skeleton(3);
const pin = (id: number, more: Partial<Pin> = {}): Pin => ({
  id,
  joint: 2,
  point: [0, 1, 0],
  weight: 1,
  holdsOrientation: false,
  ...more,
});

function worldOf(own: Skeleton): Float64Array {
  const world = new Float64Array(16 * own.joints.length);
  worldMatrices(compileSkeleton(own), Float64Array.from(filePose(own, 0)), world);
  return world;
}

describe('where pins are', () => {
  it('targets of pins are their points in the pose, with the orientation only if it is held', () => {
    const targets = pinTargets(
      { pins: [pin(4), pin(7, { joint: 1, point: [0, 0, 2], holdsOrientation: true })] },
      worldOf(CHAIN),
    );
    expect(targets.get(4)).toEqual({ position: [0, 4, 0] });
    expect(targets.get(7)).toEqual({ position: [0, 2, 2], orientation: [0, 0, 0, 1] });
    expect(pointAt(worldOf(CHAIN), 0, [1, 0, 0])).toEqual([1, 1, 0]);
  });
});

describe('the pins of a drag', () => {
  const setup = { pins: [pin(4), pin(7, { joint: 1, weight: 3 })] };
  const targets = pinTargets(setup, worldOf(CHAIN));

  it('hold, all but the one in the hand', () => {
    const made = ikPinsOf(setup, targets, { pin: 7 });
    expect(made.map(({ holds }) => holds)).toEqual([true, false]);
    expect(made[1]).toMatchObject({ joint: 1, weight: 3, target: [0, 3, 0] });
    expect(draggedIndex(setup, { pin: 7 })).toBe(1);
  });

  it('the pins of a drag are followed by a point that nothing holds otherwise', () => {
    const dragged = { joint: 0, point: [1, 0, 0], target: [5, 5, 5] } as const;
    const made = ikPinsOf(setup, targets, dragged);
    expect(made.map(({ holds }) => holds ?? false)).toEqual([true, true, false]);
    expect(made[draggedIndex(setup, dragged)]).toEqual(dragged);
  });

  it('the pins of a drag are alike where nothing is dragged', () => {
    expect(ikPinsOf(setup, targets).map(({ holds }) => holds)).toEqual([false, false]);
  });

  it('the pins of a drag are refused without a target, and where the dragged one is none of them', () => {
    expect(() => ikPinsOf(setup, new Map())).toThrow(IkError);
    expect(() => ikPinsOf(setup, targets, { pin: 5 })).toThrow(IkError);
    expect(draggedIndex(setup, { pin: 5 })).toBe(-1);
  });

  it('bring a dragged point where it should be while the others stay', () => {
    const own = skeleton(5);
    const held = { pins: [pin(1, { joint: 0, point: [0, 0, 0] })] };
    const world = worldOf(own);
    const dragged = { joint: 4, point: [0, 0, 0], target: [2, 3, 0] } as const;
    const dofs = Float64Array.from(filePose(own, 0));
    const pins = ikPinsOf(held, pinTargets(held, world), dragged);
    const problem = ikProblem(own, pins, dofs, { stiffness: stiffnessOf(own, { stiff: [], rootIsFree: true }) });
    solve(problem, dofs, 'settle');
    worldMatrices(compileSkeleton(own), dofs, world);
    const near = 1e-3;
    expect(Math.hypot(...pointAt(world, 4, [0, 0, 0]).map((x, k) => x - dragged.target[k]))).toBeLessThan(near);
    expect(Math.hypot(...pointAt(world, 0, [0, 0, 0]).map((x, k) => x - [0, 1, 0][k]))).toBeLessThan(near);
  });
});

describe('how unwilling DOFs are', () => {
  it('how unwilling DOFs are is as usual, but for joints that are locked or stiffened', () => {
    const stiff = [{ joint: 1 }, { joint: 2, stiffness: 4 }];
    const all = stiffnessOf(CHAIN, { stiff, rootIsFree: true });
    expect([...all]).toEqual([1, 1, 1, 1, 1, 1, Infinity, Infinity, Infinity, 4, 4, 4]);
  });

  it('uses only the root switch for what moves the character, whichever root it has', () => {
    expect([...stiffnessOf(CHAIN, { stiff: [{ joint: 0 }], rootIsFree: true })].slice(0, 6)).toEqual([
      1,
      1,
      1,
      Infinity,
      Infinity,
      Infinity,
    ]);
    const free: Skeleton = {
      name: 'free',
      joints: [joint(-1, { motion: { kind: 'free', order: 'xyz' }, pose: [0, 0, 0, 0, 0, 0] })],
    };
    expect([...stiffnessOf(free, { stiff: [{ joint: 0, stiffness: 2 }], rootIsFree: true })]).toEqual([
      1, 1, 1, 2, 2, 2,
    ]);
  });

  it('keeps position and turn of a fixed root; in the axis-angle form, whose root is a bone, its turn once that is locked', () => {
    const fixed = { stiff: [], rootIsFree: false };
    const ends = [Infinity, Infinity, Infinity];
    expect([...stiffnessOf(CHAIN, fixed)]).toEqual([...ends, ...ends, 1, 1, 1, 1, 1, 1]);
    const axes = { ...CHAIN, form: 'axis-angle' } as const;
    expect([...stiffnessOf(axes, fixed)]).toEqual([...ends, 1, 1, 1, 1, 1, 1, 1, 1, 1]);
    expect([rootHold(CHAIN, fixed), rootHold(axes, fixed)]).toEqual(['fixed', 'in place']);
    expect(rootHold(axes, { stiff: [], rootIsFree: true })).toBe('moves');
    expect(rootHold(axes, { stiff: [{ joint: 0, stiffness: 4 }], rootIsFree: false })).toBe('in place');
    const locked = { stiff: [{ joint: 0 }], rootIsFree: false };
    expect(rootHold(axes, locked)).toBe('fixed');
    expect([...stiffnessOf(axes, locked)]).toEqual([...ends, ...ends, 1, 1, 1, 1, 1, 1]);
  });

  it('locks what a locked joint follows, however far', () => {
    const follow = (j: number) => [{ dof: 'rx', joint: j, follows: 'rx', gain: 0.5, offset: 0 }];
    const coupled: Skeleton = {
      name: 'coupled',
      joints: [joint(-1), joint(0, { couples: follow(0) }), joint(1, { couples: follow(1) })],
    };
    const all = stiffnessOf(coupled, { stiff: [{ joint: 2 }], rootIsFree: true });
    expect([all[3], all[6], all[9]]).toEqual([Infinity, Infinity, Infinity]);
    expect([all[4], all[7]]).toEqual([1, 1]);
  });

  it('passes over joints that are not there', () => {
    expect(() => stiffnessOf(CHAIN, { stiff: [{ joint: 9 }], rootIsFree: true })).not.toThrow();
  });
});

describe('a setup that nobody made', () => {
  it('lets characters travel, but for the axis-angle form', () => {
    expect(ikOf({ skeleton: CHAIN }).rootIsFree).toBe(true);
    expect(ikOf({ skeleton: { ...CHAIN, form: 'axis-angle' } }).rootIsFree).toBe(false);
  });
});

describe('the reach of a skeleton', () => {
  it('the reach of a skeleton is its longest way along bones; a box, or 1, where there is none', () => {
    expect(reachOfSkeleton(CHAIN)).toBe(2);
    expect(reachOfSkeleton({ name: '', joints: [joint(-1, { length: 3 }), joint(0, { endSites: [[0, 0, 9]] })] })).toBe(
      10,
    );
    expect(reachOfSkeleton({ name: '', joints: [joint(-1, { box: { min: [0, 0, 0], max: [0, 3, 4] } })] })).toBe(5);
    expect(reachOfSkeleton({ name: '', joints: [joint(-1, { box: { min: [0, 0, 0], max: [0, 0, 0] } })] })).toBe(1);
  });
});
