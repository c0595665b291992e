import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { compileSkeleton, worldMatrices } from '../../../src/evaluate/kinematics.ts';
import { limbInfos } from '../../../src/evaluate/limbs/infos.ts';
import { matchPose } from '../../../src/evaluate/limbs/match-pose.ts';
import { goalPlaces } from '../../../src/evaluate/limbs/places.ts';
import { dofCountOf, poseAt } from '../../../src/evaluate/pose.ts';
import type { Character } from '../../../src/model/document.ts';
import { between, channelOf } from '../../edit/keys/channels.ts';
import { CRAB, crabWith, goalOf, goalOfMatch, LIMBS, matchFor, poses, SIZE } from './crab.ts';

const compiled = compileSkeleton(CRAB);
const free = { clampsToLimits: false };
const CLOSED = ['leg', 'wing', 'arm'];

function poseOf(character: Character, time = 0): Float64Array {
  const dofs = new Float64Array(dofCountOf(character));
  poseAt(character, time, dofs);
  return dofs;
}

function worldOf(dofs: Float64Array): Float64Array {
  const world = new Float64Array(16 * compiled.jointCount);
  worldMatrices(compiled, dofs, world);
  return world;
}

/** DOFs of a limb's joints. */
const dofsIn = (name: string) =>
  LIMBS.find((limb) => limb.name === name)?.joints.flatMap((j) =>
    Array.from({ length: compiled.firstDof[j + 1] - compiled.firstDof[j] }, (_, k) => compiled.firstDof[j] + k),
  ) ?? [];

/** DOFs of middle and last joints that are not solved: another pose of the limb has them, too. */
const KEPT: Readonly<Record<string, readonly number[]>> = {
  leg: [],
  wing: dofsIn('wing').slice(5),
  arm: dofsIn('arm').filter((_, k) => k === 3 || k > 4),
  tail: [],
};

/** The pose with a limb as in another. */
const withLimbOf = (pose: readonly number[], other: readonly number[], limb: string) => {
  const own = new Set(dofsIn(limb).filter((dof) => !KEPT[limb].includes(dof)));
  return pose.map((value, dof) => (own.has(dof) ? other[dof] : value));
};

const sum = (a: ArrayLike<number>, b: ArrayLike<number>, dofs: readonly number[]) =>
  dofs.reduce((total, dof) => total + (a[dof] - b[dof]) ** 2, 0);

describe('limbs', () => {
  it('reach what a pose of theirs reaches, in every space', () => {
    const spaces = fc.constantFrom('world', 'parent', 'body');
    fc.assert(
      fc.property(fc.constantFrom(...CLOSED), poses, poses, spaces, (limb, pose, other, space) => {
        const { goal, pole, bend } = matchFor(withLimbOf(pose, other, limb), limb, space);
        const [info] = limbInfos(crabWith(pose, [goalOfMatch(limb, { goal, pole, bend }, space)], free), 0);
        expect(info.gap).toBeLessThan(1e-6 * SIZE);
        expect(info.match).toEqual(matchFor(pose, limb, space));
      }),
    );
  });

  it('turn no joint when they are matched, by more than 1e-9', () => {
    fc.assert(
      fc.property(fc.constantFrom(...CLOSED), poses, (limb, pose) => {
        const fk = worldOf(poseOf(crabWith(pose, [], free)));
        const ik = worldOf(poseOf(crabWith(pose, [goalOfMatch(limb, matchFor(pose, limb))], free)));
        let worst = 0;
        for (let k = 0; k < fk.length; k++) worst = Math.max(worst, Math.abs(ik[k] - fk[k]));
        expect(worst).toBeLessThan(1e-9);
      }),
    );
  });

  it('are FK to the bit with a blend of 0 or less, and of characters without goals', () => {
    fc.assert(
      fc.property(poses, fc.constantFrom(0, -1), (pose, blend) => {
        const goals = LIMBS.map(({ name }) => goalOf(name, { blend, tx: 1 }));
        const { limbs: _limbs, ...bare } = crabWith(pose, []);
        const fk = poseOf(bare);
        expect(poseOf(crabWith(pose, goals))).toEqual(fk);
        expect(poseOf(crabWith(pose, []))).toEqual(fk);
        expect(poseOf(crabWith(pose, [goalOf('nobody', { tx: 1 })]))).toEqual(fk);
      }),
    );
  });

  it('blend their DOFs, at angles nearest to those of FK', () => {
    fc.assert(
      fc.property(poses, poses, between(0, 1), fc.constantFrom(...CLOSED), (pose, other, blend, limb) => {
        const goal = goalOfMatch(limb, matchFor(withLimbOf(pose, other, limb), limb));
        const fk = poseOf(crabWith(pose, [], free));
        const ik = poseOf(crabWith(pose, [goal], free));
        const mixed = poseOf(
          crabWith(pose, [{ ...goal, channels: { ...goal.channels, blend: { curve: blend } } }], free),
        );
        const own = dofsIn(limb);
        for (const dof of own) expect(mixed[dof]).toBeCloseTo(fk[dof] + blend * (ik[dof] - fk[dof]), 9);
        const near = sum(ik, fk, own);
        const world = worldOf(ik);
        for (const joint of LIMBS.find(({ name }) => name === limb)?.joints ?? []) {
          const [a, b, c, d] = Array.from({ length: 4 }, (_, k) => compiled.firstDof[joint] + k);
          const motion = CRAB.joints[joint].motion;
          const flipped = ik.slice();
          if (motion.kind === 'quaternion') for (const dof of [a, b, c, d]) flipped[dof] *= -1;
          else if (motion.kind === 'ball' && joint !== LIMBS[2].joints[1]) {
            const middle = a + 'xyz'.indexOf(motion.order[1]);
            for (const dof of [a, b, c]) flipped[dof] = dof === middle ? Math.PI - ik[dof] : ik[dof] + Math.PI;
            for (const dof of [a, b, c])
              flipped[dof] += 2 * Math.PI * Math.round((fk[dof] - flipped[dof]) / 2 / Math.PI);
          } else continue;
          expect(Math.hypot(...worldOf(flipped).map((x, k) => x - world[k]))).toBeLessThan(1e-9);
          expect(sum(flipped, fk, own)).toBeGreaterThan(near - 1e-9);
        }
      }),
    );
  });

  it('go straight towards what is out of reach, and stay finite wherever the goal is', () => {
    const far = goalOf('leg', { tx: 40, ty: -30, tz: 7 });
    const zero = poseOf(crabWith([], []));
    const world = worldOf(poseOf(crabWith([...zero], [far], free)));
    const [thigh, , foot] = LIMBS[0].joints;
    const at = (j: number) => [0, 1, 2].map((k) => world[16 * j + 12 + k]);
    const bone = at(foot).map((x, k) => x - at(thigh)[k]);
    const way = [40, -30, 7].map((x, k) => x - at(thigh)[k]);
    const cos = bone.reduce((total, x, k) => total + x * way[k], 0) / Math.hypot(...bone) / Math.hypot(...way);
    // Its end is the foot's pivot, for which the goal is turned by the tip.
    expect(cos).toBeGreaterThan(1 - 1e-5);
    fc.assert(
      fc.property(
        poses,
        fc.array(fc.constantFrom(0, 0.2, -0.1, 1e9, 1e-300), { minLength: 9, maxLength: 9 }),
        (pose, numbers) => {
          const [tx, ty, tz, rx, ry, rz, px, py, pz] = numbers;
          const goals = CLOSED.map((limb) => goalOf(limb, { tx, ty, tz, rx, ry, rz, px, py, pz }, 'parent'));
          expect([...poseOf(crabWith(pose, goals))].every(Number.isFinite)).toBe(true);
        },
      ),
    );
  });

  it('are looked up once for all poses that are matched to them', () => {
    const pose = [...poseOf(crabWith([], []))];
    let asked = 0;
    const goals = new Proxy([goalOfMatch('leg', matchFor(pose, 'leg'))], {
      get(list, key, receiver) {
        asked++;
        return Reflect.get(list, key, receiver);
      },
    });
    const crab = crabWith(pose, []);
    const match = () => matchPose(crab, goals, 0, Float64Array.from(pose)).get('leg')?.goal;
    const first = match();
    expect(asked).toBeGreaterThan(0);
    asked = 0;
    expect(match()).toEqual(first);
    expect(asked).toBe(0);
  });

  it('have their handles where they go, in the space of a limb that is only partly in IK, too', () => {
    fc.assert(
      fc.property(poses, poses, between(0.1, 0.9), (pose, other, blend) => {
        const leg = goalOfMatch('leg', matchFor(withLimbOf(pose, other, 'leg'), 'leg'));
        const part = { ...leg, channels: { ...leg.channels, blend: { curve: blend } } };
        const point = [0.1, 0.4, 0.2];
        const wing = goalOf('wing', { tx: point[0], ty: point[1], tz: point[2] }, 'toe');
        const both = crabWith(pose, [part, wing], free);
        const dofs = poseOf(both);
        const toe = 16 * CRAB.joints.findIndex(({ name }) => name === 'toe');
        const world = worldOf(dofs);
        const places = goalPlaces(both, 0, dofs);
        expect(places.map(({ limb }) => limb.name)).toEqual(['leg', 'wing']);
        for (let k = 0; k < 3; k++) {
          const meant = point.reduce((sum, part, c) => sum + part * world[toe + 4 * c + k], world[toe + 12 + k]);
          expect(places[1].point[k]).toBeCloseTo(meant, 9);
        }
      }),
    );
  });

  it('come after those that move their spaces, and after linked DOFs of these', () => {
    const pose = [...poseOf(crabWith([], []))];
    const leg = goalOf('leg', { tx: 0.3, ty: 0.5, tz: 0.3 });
    const wing = goalOf('wing', { tx: 0.1, ty: 0.4, tz: 0 }, 'toe');
    const both = crabWith(pose, [wing, leg]);
    for (const { gap, name } of limbInfos(both, 0)) expect(gap, name).toBeLessThan(1e-9);
    expect(limbInfos(both, 0).map(({ name }) => name)).toEqual(['leg', 'wing']);
    const [shin, toe] = ['shin', 'toe'].map((name) => compiled.firstDof[CRAB.joints.findIndex((j) => j.name === name)]);
    const dofs = poseOf(both);
    expect(dofs[toe]).toBeCloseTo(0.1 - 0.3 * dofs[shin], 12);
  });

  it('are pure functions of time, with spaces that change', () => {
    const pose = [...poseOf(crabWith([], []))];
    const space = [
      [0.5, 'world'],
      [1, 'body'],
    ] as const;
    const goal = goalOf('wing', { ty: 1.2, tz: 0.3, px: -1 }, space);
    const moving = {
      ...goal,
      channels: {
        ...goal.channels,
        tx: {
          curve: channelOf([
            [0, -0.4, 'flat'],
            [2, -0.7, 'flat'],
          ]),
        },
      },
    };
    const tail = goalOf('tail', { tx: 0.1, ty: 1.5, tz: -0.6 });
    const times = [1.7, 0, 0.999, 1, 0.2, 0];
    const inTurn = crabWith(pose, [moving, tail]);
    for (const time of times) expect(poseOf(inTurn, time)).toEqual(poseOf(crabWith(pose, [moving, tail]), time));
    expect(limbInfos(inTurn, 0)[0].space).toBe('world');
    expect(limbInfos(inTurn, 1)[0].space).toBe('body');
  });

  it('of many joints reach what is near, and move nothing else', () => {
    fc.assert(
      fc.property(poses, fc.array(between(-0.3, 0.3), { minLength: 4, maxLength: 4 }), (pose, turns) => {
        const own = dofsIn('tail');
        const other = pose.map((value, dof) => value + (turns[own.indexOf(dof)] ?? 0));
        const [info] = limbInfos(crabWith(pose, [goalOfMatch('tail', matchFor(other, 'tail'))], free), 0);
        expect(info.gap).toBeLessThan(1e-6 * SIZE);
        const dofs = poseOf(crabWith(pose, [goalOfMatch('tail', matchFor(other, 'tail'))], free));
        const fk = poseOf(crabWith(pose, [], free));
        dofs.forEach((value, dof) => {
          if (!own.includes(dof)) expect(value).toBe(fk[dof]);
        });
      }),
      { numRuns: 30 },
    );
  });

  it('keep their limits, and reach as far as these let them', () => {
    const elbow = dofsIn('arm')[4];
    const bent = [...poseOf(crabWith([], []))].map((value, dof) => (dof === elbow ? 0.45 : value));
    const { goal, pole } = matchFor(bent, 'arm');
    const [tx, ty, tz] = goal;
    const [px, py, pz] = pole;
    // The other side is within the limits only up to 0.5.
    const near = goalOf('arm', { tx, ty, tz, px, py, pz, bend: 1 });
    expect(limbInfos(crabWith(bent, [near]), 0)[0].gap).toBeLessThan(1e-9);
    const inside = goalOf('arm', { tx: 0.35, ty: 1.4, tz: 0.1, bend: 1 });
    for (const blend of [1, 0.999, 0.6]) {
      const character = crabWith(bent, [{ ...inside, channels: { ...inside.channels, blend: { curve: blend } } }]);
      expect(poseOf(character)[elbow]).toBeLessThanOrEqual(0.5);
      expect(poseOf(character)[elbow - 1]).toBe(0);
    }
    const gapAt = (blend: number) =>
      limbInfos(crabWith(bent, [{ ...inside, channels: { ...inside.channels, blend: { curve: blend } } }]), 0)[0].gap;
    expect(Math.abs(gapAt(1) - gapAt(0.99999))).toBeLessThan(1e-3);
  });
});
