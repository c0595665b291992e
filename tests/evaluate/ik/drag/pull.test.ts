import { describe, expect, it } from 'vitest';
import { inertia } from '../../../../src/evaluate/ik/drag/inertia.ts';
import { Pull } from '../../../../src/evaluate/ik/drag/pull.ts';
import { pinTargets, pointAt } from '../../../../src/evaluate/ik/set-up.ts';
import { compileSkeleton, worldMatrices } from '../../../../src/evaluate/kinematics.ts';
import { type Vec3, ZERO } from '../../../../src/math/vec3.ts';
import type { Character } from '../../../../src/model/document.ts';
import type { IkSetup, Pin } from '../../../../src/model/ik.ts';
import { filePose } from '../../../../src/model/skeleton/dofs.ts';
import {
  DEFAULT_BOX,
  DEFAULT_MOTION,
  type Joint,
  type Limit,
  type Skeleton,
} from '../../../../src/model/skeleton/skeleton.ts';
import { character } from '../../../ui/builders.ts';

const FREE: Limit = { min: -3, max: 3 };
const KNEE: Limit = { min: 0, max: 2.5 };
const STIFF: Limit = { min: 0, max: 0 };

function joint(name: string, parent: number, offset: Vec3, limits: readonly Limit[] = [FREE, FREE, FREE]): Joint {
  return { name, parent, offset, box: DEFAULT_BOX, motion: DEFAULT_MOTION, limits, pose: [0, 0, 0] };
}

/** Hips with a trunk above and two straight legs below: 2 from the ankles to the head. */
const PERSON: Skeleton = {
  name: 'person',
  joints: [
    joint('hips', -1, [0, 1, 0]),
    joint('chest', 0, [0, 0.5, 0]),
    joint('head', 1, [0, 0.5, 0]),
    joint('thigh_l', 0, [0.2, 0, 0]),
    joint('shin_l', 3, [0, -0.5, 0], [KNEE, STIFF, STIFF]),
    joint('foot_l', 4, [0, -0.5, 0]),
    joint('thigh_r', 0, [-0.2, 0, 0]),
    joint('shin_r', 6, [0, -0.5, 0], [KNEE, STIFF, STIFF]),
    joint('foot_r', 7, [0, -0.5, 0]),
  ],
};
const [HIPS, CHEST, HEAD, THIGH, SHIN, FOOT_L, , , FOOT_R] = PERSON.joints.keys();
const SIZE = 2;
/** Of the size. */
const PIN_HOLDS = 1e-3;

const pin = (id: number, on: number): Pin => ({ id, joint: on, point: [0, 0, 0], weight: 1, holdsOrientation: false });
const onFeet: IkSetup = { pins: [pin(1, FOOT_L), pin(2, FOOT_R)], stiff: [], rootIsFree: true };
const person = (ik: IkSetup = onFeet): Character => character({ skeleton: PERSON, ik });

function worldOf(dofs: ArrayLike<number>): Float64Array {
  const compiled = compileSkeleton(PERSON);
  const world = new Float64Array(16 * compiled.jointCount);
  worldMatrices(compiled, Float64Array.from(dofs), world);
  return world;
}

const placeOf = (dofs: ArrayLike<number>, on: number) => pointAt(worldOf(dofs), on, [0, 0, 0]);
const apart = (a: Vec3, b: Vec3) => Math.hypot(...a.map((v, k) => v - b[k]));

/** Angle of a joint from upright, radians. */
function leans(dofs: ArrayLike<number>, on: number): number {
  return Math.acos(Math.min(1, worldOf(dofs)[16 * on + 5]));
}

function pullOf(ch: Character, on: number, start = filePose(PERSON, 0)): Pull {
  const world = worldOf(start);
  const shown = { dofs: Float64Array.from(start), world };
  return new Pull(ch, PERSON, shown, pinTargets(ch.ik ?? onFeet, world), { joint: on, point: [0, 0, 0] });
}

/** Drags a point by that much, in so many moves; what is seen of each. */
function drag(pull: Pull, on: number, by: Vec3, moves: number, look: (dofs: Float64Array) => void = () => {}): void {
  const [x, y, z] = placeOf(pull.dofs, on);
  for (let i = 1; i <= moves; i++) {
    const part = i / moves;
    pull.to([x + part * by[0], y + part * by[1], z + part * by[2]]);
    look(pull.dofs);
  }
}

describe('a point that is pulled', () => {
  it('bends legs that are straight where hips are pushed down on feet that hold', () => {
    const start = filePose(PERSON, 0);
    const pull = pullOf(person(), HIPS);
    drag(pull, HIPS, [0, -0.4, 0], 40, (dofs) => {
      for (const foot of [FOOT_L, FOOT_R])
        expect(apart(placeOf(dofs, foot), placeOf(start, foot))).toBeLessThan(PIN_HOLDS * SIZE);
    });
    expect(placeOf(pull.dofs, HIPS)[1]).toBeCloseTo(0.6, 3);
    expect(pull.dofs[3 + 3 * SHIN]).toBeGreaterThan(0.5);
  });

  it('bends the legs rather than tipping the whole body over', () => {
    const pull = pullOf(person(), HIPS);
    drag(pull, HIPS, [0.1, -0.2, 0.15], 40);
    expect(leans(pull.dofs, THIGH)).toBeGreaterThan(0.3);
    expect(leans(pull.dofs, CHEST)).toBeLessThan(0.2);
  });

  it('a point that is pulled comes as near as the pins let it, and they don’t give way to a hand far off', () => {
    const start = filePose(PERSON, 0);
    const pull = pullOf(person(), HEAD);
    drag(pull, HEAD, [0, 20, 0], 30, (dofs) => {
      for (const foot of [FOOT_L, FOOT_R])
        expect(apart(placeOf(dofs, foot), placeOf(start, foot))).toBeLessThan(PIN_HOLDS * SIZE);
    });
    expect(placeOf(pull.dofs, HEAD)[1]).toBeCloseTo(2, 2);
    const [gap, ...others] = pull.gaps();
    expect(others).toEqual([]);
    expect(gap.joint).toBe(HEAD);
    expect(apart(gap.to, [0, 22, 0])).toBeLessThan(1e-9);
  });

  it.each([
    ['the head', HEAD, [0.05, -0.26, 0.03], [0.08, 0.13, -0.47], 78],
    ['the head the other way', HEAD, [0.15, -0.17, -0.14], [-0.09, -0.1, 0.35], 48],
    ['the chest', CHEST, [-0.11, -0.27, -0.19], [-0.72, 0.34, 0.03], 77],
    ['the chest in fewer moves', CHEST, [0.07, -0.3, 0.12], [0.23, 0.36, -0.39], 30],
    ['the hips', HIPS, [0.17, -0.24, -0.19], [0.2, 0.57, 0.53], 67],
  ] as const)('moves %s in steps that belong to the hand’s, where legs come to their full length too', (...drags) => {
    const [, on, down, away, moves] = drags;
    const pull = pullOf(person(), on);
    drag(pull, on, down, 10);
    let before = pull.dofs.slice();
    let most = 0;
    drag(pull, on, away, moves, (dofs) => {
      most = Math.max(most, ...dofs.map((value, d) => Math.abs(value - before[d])));
      before = dofs.slice();
    });
    // Unbridled, a leg that is all but straight turns by 0.3 to 0.5 in one of these.
    expect(most).toBeLessThan(0.2);
  });

  it('reaches a hand that moved far in one frame, in at most two more', () => {
    const pull = pullOf(person(), HIPS);
    const goal = [0.5, 0.5, 1.2] as const;
    pull.to(goal);
    for (let frame = 0; frame < 2; frame++) pull.goOn();
    expect(pull.isOnItsWay).toBe(false);
    const rest = pull.dofs.slice();
    pull.goOn();
    expect(pull.dofs).toEqual(rest);
    expect(pull.gaps().map(({ to }) => to)).toEqual([goal]);
    for (const foot of [FOOT_L, FOOT_R])
      expect(apart(placeOf(pull.dofs, foot), placeOf(filePose(PERSON, 0), foot))).toBeLessThan(PIN_HOLDS * SIZE);
  });

  it('a point that is pulled does not shake where the hand is out of reach and stays there', () => {
    const pull = pullOf(person(), HIPS);
    drag(pull, HIPS, [0.5, 1, 0.4], 20);
    const { hand } = pull;
    for (let i = 0; i < 30; i++) pull.to(hand);
    const before = pull.dofs.slice();
    pull.to(hand);
    expect(Math.max(...pull.dofs.map((value, d) => Math.abs(value - before[d])))).toBeLessThan(1e-3);
  });

  it('a point that is pulled keeps the limits, and names the one that blocks', () => {
    const limits = new Map<number, readonly Limit[]>([
      [SHIN, [STIFF, STIFF, STIFF]],
      [THIGH, [KNEE, STIFF, STIFF]],
    ]);
    const joints = PERSON.joints.map((j, i) => ({ ...j, limits: limits.get(i) ?? j.limits }));
    const skeleton = { ...PERSON, joints };
    const ik: IkSetup = { pins: [], stiff: [{ joint: HIPS }], rootIsFree: false };
    const dofs = Float64Array.from(filePose(skeleton, 0));
    const grip = { joint: FOOT_L, point: [0, 0, 0] } as const;
    const pull = new Pull(character({ skeleton, ik }), skeleton, { dofs, world: worldOf(dofs) }, new Map(), grip);
    const thigh = 3 + 3 * THIGH;
    pull.to([0.2, 0.3, -0.7]);
    expect(pull.dofs[thigh]).toBeGreaterThan(0.5);
    // A leg that only swings back: forwards it is stopped by its limit.
    pull.to([0.2, 0.2, 0.6]);
    expect(pull.dofs[thigh]).toBe(0);
    expect(pull.binding()).toContain(thigh);
    expect(pull.gaps()).toHaveLength(1);
  });

  it('follows a hand in the world, wherever the character is placed', () => {
    const start = filePose(PERSON, 0);
    const world = worldOf(start);
    const shown = { dofs: Float64Array.from(start), world };
    // Twice as large, a quarter turn about z, and elsewhere.
    const placement = Float64Array.of(0, 2, 0, 0, -2, 0, 0, 0, 0, 0, 2, 0, 5, 6, 7, 1);
    const pull = new Pull(person(), PERSON, shown, pinTargets(onFeet, world), { joint: HIPS, point: ZERO }, placement);
    const [x, y, z] = pull.hand;
    expect([x, y, z]).toEqual([3, 6, 7]);
    for (let i = 1; i <= 20; i++) pull.to([x + 0.02 * i, y, z]);
    expect(placeOf(pull.dofs, HIPS)[1]).toBeCloseTo(0.8, 3);
    expect(pull.inOwnUnit([0, 0, 0], [0, 0, 4])).toBe(2);
    expect(pull.changes.every(({ index, value }) => value === pull.dofs[index])).toBe(true);
    expect(pull.held.size).toBe(2);
  });

  it('turns a pin that holds its orientation where it is, and comes back, also where the character is mirrored', () => {
    const ik: IkSetup = {
      pins: [{ ...pin(1, FOOT_L), holdsOrientation: true }, pin(2, FOOT_R)],
      stiff: [{ joint: HIPS }],
      rootIsFree: true,
    };
    const dofs = Float64Array.from(filePose(PERSON, 0));
    dofs[3 + 3 * THIGH] = -0.6;
    dofs[3 + 3 * SHIN] = 1;
    const world = worldOf(dofs);
    for (const side of [1, -1]) {
      const placement = Float64Array.of(side, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1);
      const grip = { joint: FOOT_L, point: ZERO, pin: 1 };
      const pull = new Pull(person(ik), PERSON, { dofs, world }, pinTargets(ik, world), grip, placement);
      for (let i = 1; i <= 10; i++) pull.turn([0, 1, 0], 0.05 * i);
      const now = worldOf(pull.dofs);
      const [before, after] = [world, now].map((w) => Math.atan2(-w[16 * FOOT_L + 2], w[16 * FOOT_L]));
      expect(after - before).toBeCloseTo(side * 0.5, 6);
      expect(apart(placeOf(pull.dofs, FOOT_L), pointAt(world, FOOT_L, ZERO))).toBeLessThan(1e-6);
      expect(apart(placeOf(pull.dofs, FOOT_R), pointAt(world, FOOT_R, ZERO))).toBeLessThan(PIN_HOLDS * SIZE);
      pull.turn([0, 1, 0], 0);
      pull.settle();
      expect(Math.max(...pull.dofs.map((value, d) => Math.abs(value - dofs[d])))).toBeLessThan(1e-3);
    }
  });

  it('a point that is pulled does not move for a hand that is not finite', () => {
    const pull = pullOf(person(), HEAD);
    const before = pull.dofs.slice();
    pull.to([Number.NaN, 0, 0]);
    pull.to([Infinity, 0, 0]);
    expect(pull.dofs).toEqual(before);
  });

  it('a point that is pulled has settled without a jump, even if a leg is almost straight', () => {
    const ik: IkSetup = { pins: [], stiff: [{ joint: HIPS }], rootIsFree: false };
    for (const start of [0.3, 0.6, 0.9]) {
      for (const short of [0, 3e-5, 1e-4, 2e-4, 4e-4, 1e-2]) {
        const pull = pullOf(character({ skeleton: PERSON, ik }), FOOT_L);
        drag(pull, FOOT_L, [0, start, -0.1], 20);
        const [x, y, z] = placeOf(pull.dofs, FOOT_L);
        const [hipX, hipY, hipZ] = placeOf(pull.dofs, THIGH);
        // The leg is 1 long: to so much short of that.
        const down = Math.sqrt((1 - short) ** 2 - 0.3 ** 2);
        drag(pull, FOOT_L, [hipX + 0.3 - x, hipY - down - y, hipZ - z], 40);
        const before = pull.dofs.slice();
        pull.settle();
        // The solver’s own last digits of the way go by the square root of what is left of it: 0.0134 and more here.
        expect(Math.max(...pull.dofs.map((value, d) => Math.abs(value - before[d])))).toBeLessThan(0.012);
      }
    }
  });
});

describe('how much a DOF moves', () => {
  it('how much a DOF moves is most for what carries the whole, and least for an end', () => {
    const list = inertia(PERSON);
    const of = (on: number) => list[3 + 3 * on];
    expect(list[0]).toBe(of(HIPS));
    expect(of(HIPS)).toBeGreaterThan(of(THIGH));
    expect(of(THIGH)).toBeGreaterThan(of(SHIN));
    expect(of(FOOT_L)).toBe(1);
  });

  it('how much a DOF moves is 1 where nothing has a length', () => {
    const dot: Skeleton = { name: 'dot', joints: [joint('dot', -1, [0, 0, 0])] };
    expect([...inertia(dot)]).toEqual([1, 1, 1, 1, 1, 1]);
  });
});
