import fc from 'fast-check';
import { expect, it } from 'vitest';
import { shownAt } from '../../../../src/edit/rig/shown.ts';
import { Pull } from '../../../../src/evaluate/ik/drag/pull.ts';
import { pinPoints } from '../../../../src/evaluate/ik/pin-points.ts';
import { pinTargets, pointAt } from '../../../../src/evaluate/ik/set-up.ts';
import { worldMatrices } from '../../../../src/evaluate/kinematics.ts';
import { readSkel } from '../../../../src/formats/skel/read.ts';
import { readSkin } from '../../../../src/formats/skin/read.ts';
import { add, subtract, type Vec3, ZERO } from '../../../../src/math/vec3.ts';
import { type Character, shownSkin } from '../../../../src/model/document.ts';
import type { IkSetup } from '../../../../src/model/ik.ts';
import { boneEnds } from '../../../../src/model/skeleton/bone-ends.ts';
import { filePose } from '../../../../src/model/skeleton/dofs.ts';
import { character as builtCharacter } from '../../../helpers/builders.ts';
import { describeShared, sharedBytes } from '../../../helpers/shared.ts';

/** Radians, parts of the reach: the end of the last step home. */
const HOME = 2e-3;
/** What several joints off by that come to. */
const SEEN = 5e-3;
/** The most that a pose may still move under a hand that is still. */
const FRAMES_TO_REST = 2;
/** Radians that a DOF goes in a frame of a slow hand. */
const LONGEST = 0.12;

function wasp(): Character {
  const [skeleton] = readSkel(sharedBytes('data/cse169/wasp.skel'), 'wasp.skel').value ?? [];
  const skin = readSkin(sharedBytes('data/cse169/wasp.skin'), 'wasp.skin').value;
  if (!skeleton || !skin) throw new Error('wasp could not be read');
  return builtCharacter({ skeleton, skins: [skin], pose: filePose(skeleton, 0) });
}

/** On all six feet. */
function pinned(character: Character): Character {
  const { skeleton } = character;
  if (!skeleton) throw new Error('no skeleton');
  const pins = skeleton.joints.flatMap(({ name }, joint) => {
    if (!name.startsWith('knee')) return [];
    const point = pinPoints(skeleton, joint, shownSkin(character)).find(({ kind }) => kind === 'skinEnd')?.point;
    return point ? [{ id: joint, joint, point, weight: 1, holdsOrientation: false }] : [];
  });
  const ik: IkSetup = { pins, stiff: [], rootIsFree: true };
  return { ...character, ik };
}

describeShared('a body that is led about on feet that hold', () => {
  it.each<[string, Vec3]>([
    ['up and out of reach', [0, 1.2, 0]],
    ['to the side', [1.2, 0, 0]],
    ['far away', [4, 3, 1]],
  ])('%s, is back where it was when the hand is', (_where, way) => {
    const character = pinned(wasp());
    const { skeleton, ik } = character;
    if (!skeleton || !ik) throw new Error('no skeleton');
    expect(ik.pins).toHaveLength(6);
    const { dofs, world } = shownAt(character, 0);
    const [x, y, z] = pointAt(world, 0, [0, 0, 0]);
    const grip = { joint: 0, point: [0, 0, 0] } as const;
    const pull = new Pull(character, skeleton, { dofs, world }, pinTargets(ik, world), grip);
    const to = (part: number) => pull.to([x + part * way[0], y + part * way[1], z + part * way[2]]);
    let furthest = 0;
    for (let f = 1; f <= 80; f++) {
      to(1 - Math.abs(f - 40) / 40);
      furthest = Math.max(furthest, off(pull.dofs, dofs));
    }
    expect(frames(pull)).toBeLessThanOrEqual(FRAMES_TO_REST);
    expect(furthest).toBeGreaterThan(0.5);
    expect(off(pull.dofs, dofs)).toBeLessThan(HOME);
  });
});

/** Where the last joint's bone ends, out there and back in small steps, then until the pose is at rest. */
function thereAndBack(name: string, way: Vec3, far: number) {
  const [skeleton] = readSkel(sharedBytes(`data/axis-skel/${name}.axskel`), `${name}.axskel`).value ?? [];
  if (!skeleton) throw new Error(`${name} could not be read`);
  const character = builtCharacter({ skeleton, pose: filePose(skeleton, 0) });
  const { compiled, dofs, world } = shownAt(character, 0);
  const joint = skeleton.joints.length - 1;
  const point = boneEnds(skeleton).find((end) => end.joint === joint)?.at ?? ZERO;
  const pull = new Pull(character, skeleton, { dofs, world }, new Map(), { joint, point });
  const start = pull.hand;
  for (let f = 1; f <= 120; f++) pull.to(add(start, way, far * pull.reach * (1 - Math.abs(f - 60) / 60)));
  const still = frames(pull);
  const rest = pull.dofs.slice();
  for (let f = 0; f < 10; f++) pull.to(start);
  const now = new Float64Array(world.length);
  worldMatrices(compiled, pull.dofs, now);
  // Axes of joints, and places in parts of the reach.
  const differences = now.map((v, k) => Math.abs(v - world[k]) / (k % 16 < 12 ? 1 : pull.reach));
  return { still, moved: off(pull.dofs, rest), away: Math.max(...differences) };
}

describeShared('an end that is led out and back', () => {
  const ways: readonly Vec3[] = [
    [1, 0, 0],
    [0, 1, 0],
    [0, -1, 0],
    [0.6, -0.64, 0.48],
  ];
  it.each(['single', 'arm3', 'chain10', 'chain30', 'hand', 'hexapod', 'human', 'tree3'])(
    'dragging an end of %s out and back leaves the pose as it was',
    (name) => {
      for (const way of ways) {
        for (const far of [0.5, 1.5]) {
          const { still, moved, away } = thereAndBack(name, way, far);
          expect(still).toBeLessThanOrEqual(FRAMES_TO_REST);
          expect(moved).toBe(0);
          expect(away, `${way} ${far}`).toBeLessThan(SEEN);
        }
      }
    },
  );
});

interface Drag {
  readonly pull: Pull;
  /** World matrices as shown. */
  readonly world: () => Float64Array;
}

/** A drag of an end, others of which may be pinned; or of the root with all ends pinned. */
function dragOf(name: string, pinned: number, ofRoot: boolean): Drag {
  const [skeleton] = readSkel(sharedBytes(`data/axis-skel/${name}.axskel`), `${name}.axskel`).value ?? [];
  if (!skeleton) throw new Error(`${name} could not be read`);
  const ends = boneEnds(skeleton);
  const held = ofRoot ? ends : ends.slice(0, Math.min(pinned, ends.length - 1));
  const pins = held.map(({ joint, at: point }, i) => ({ id: i, joint, point, weight: 1, holdsOrientation: false }));
  const ik: IkSetup = { pins, stiff: [], rootIsFree: ofRoot };
  const character = builtCharacter({ skeleton, pose: filePose(skeleton, 0), ik });
  const { compiled, dofs, world } = shownAt(character, 0);
  const end = ends[ends.length - 1];
  const grip = ofRoot ? { joint: 0, point: ZERO } : { joint: end.joint, point: end.at };
  const pull = new Pull(character, skeleton, { dofs, world }, pinTargets(ik, world), grip);
  const now = new Float64Array(world.length);
  return {
    pull,
    world: () => {
      worldMatrices(compiled, pull.dofs, now);
      return now.slice();
    },
  };
}

/** Frames of a hand that is still in which the pose moves. */
function frames(pull: Pull): number {
  let count = 0;
  for (let f = 0; f < 10; f++) {
    const before = pull.dofs.slice();
    pull.goOn();
    if (off(pull.dofs, before) > 0) count = f + 1;
  }
  expect(pull.isOnItsWay).toBe(false);
  return count;
}

const part = fc.double({ min: -0.7, max: 0.7, noNaN: true });
const place: fc.Arbitrary<Vec3> = fc.tuple(part, part, part);
const anyDrag = fc.record({
  name: fc.constantFrom('arm3', 'chain10', 'chain30', 'hand', 'hexapod', 'human', 'tree3'),
  pinned: fc.constantFrom(0, 0, 1, 2),
  ofRoot: fc.constantFrom(false, false, true),
  places: fc.array(fc.tuple(place, fc.integer({ min: 1, max: 25 })), { minLength: 1, maxLength: 4 }),
});

/** Along straight lines from place to place, in fractions of the reach from where the point was. */
function lead(pull: Pull, places: readonly (readonly [Vec3, number])[], look: () => void = () => {}): void {
  const start = pull.hand;
  for (const [to, moves] of places) {
    const from = pull.hand;
    const goal = add(start, to, pull.reach);
    for (let f = 1; f <= moves; f++) {
      pull.to(f === moves ? goal : add(from, subtract(goal, from), f / moves));
      look();
    }
  }
}

describeShared('a hand that is led anywhere', () => {
  it('the same place of the hand gives the same pose, whatever the way there, within two frames; a release leaves it', () => {
    fc.assert(
      fc.property(anyDrag, ({ name, pinned, ofRoot, places }) => {
        const around = dragOf(name, pinned, ofRoot);
        const straight = dragOf(name, pinned, ofRoot);
        lead(around.pull, places);
        lead(straight.pull, [[places[places.length - 1][0], 7]]);
        const seen = around.pull.dofs.slice();
        expect(frames(around.pull)).toBeLessThanOrEqual(FRAMES_TO_REST);
        frames(straight.pull);
        expect(furthest(around.world(), straight.world(), around.pull.reach)).toBeLessThan(1e-9);
        const released = dragOf(name, pinned, ofRoot);
        lead(released.pull, places);
        released.pull.settle();
        expect([...released.pull.dofs]).toEqual([...seen]);
        expect(frames(released.pull)).toBe(0);
      }),
      { numRuns: 20 },
    );
  });

  it('a pose that would jump under a moving hand goes there in short steps, follows it, and stays as it is seen on release', () => {
    let jumps = 0;
    for (const to of [
      [0, 0, 0.6],
      [0.5, -0.3, 0.3],
      [-0.4, 0.2, -0.5],
      [0.3, -0.7, 0],
    ] as const) {
      const { pull } = dragOf('hand', 0, false);
      let before = pull.dofs.slice();
      lead(
        pull,
        [
          [to, 400],
          [[0, 0.1, 0], 400],
        ],
        () => {
          // Whole turns are the same pose.
          const most = off(
            pull.dofs.map((v, d) => Math.abs(Math.sin((v - before[d]) / 2))),
            [...before].fill(0),
          );
          expect(most).toBeLessThan(Math.sin(LONGEST / 2));
          before = pull.dofs.slice();
          if (pull.isOnItsWay) jumps++;
        },
      );
    }
    expect(jumps).toBeGreaterThan(10);
  });

  it('a release while the pose approaches leaves what is seen', () => {
    const { pull } = dragOf('hand', 0, false);
    let released: Float64Array | undefined;
    const start = pull.hand;
    for (let f = 1; f <= 400 && !released; f++) {
      pull.to(add(start, [0, 0, 0.6], (pull.reach * f) / 400));
      if (pull.isOnItsWay) released = pull.dofs.slice();
    }
    expect(released).toBeDefined();
    pull.settle();
    expect(pull.dofs).toEqual(released);
    expect(frames(pull)).toBe(0);
  });
});

/** Of world matrices: axes, and places in fractions of the reach. */
function furthest(a: Float64Array, b: Float64Array, reach: number): number {
  return a.reduce((most, v, k) => Math.max(most, Math.abs(v - b[k]) / (k % 16 < 12 ? 1 : reach)), 0);
}

function off(a: Float64Array, b: ArrayLike<number>): number {
  return a.reduce((most, value, d) => Math.max(most, Math.abs(value - b[d])), 0);
}
