import { describe, expect, it } from 'vitest';
import { CommandError } from '../../../src/edit/command-error.ts';
import {
  bakeExtrapolation,
  bakePreview,
  eulerFilter,
  eulerFilterSteps,
  makeLoop,
  resample,
  resamplePreview,
  simplify,
  simplifyPreview,
} from '../../../src/edit/commands/channels.ts';
import { Store } from '../../../src/edit/store.ts';
import { runToEnd } from '../../../src/evaluate/steps.ts';
import { type Document, shownTake } from '../../../src/model/document.ts';
import { type Channel, keysOf, restChannel } from '../../../src/model/takes/take.ts';
import { character, documentOf, joint, skeleton } from '../../helpers/builders.ts';
import { expectClose } from '../../helpers/close.ts';
import { channelOf } from '../keys/channels.ts';

const wave = (height: number) =>
  channelOf(Array.from({ length: 61 }, (_, i) => [i / 30, height * Math.sin(i / 10), 'linear']));
const jumping = channelOf([
  [0, 3],
  [1, -3],
]);
const calm = channelOf([
  [0, 0],
  [1, 0],
]);

/** Root translation, then rx ry rz of two joints. */
function documentWith(...channels: Channel[]) {
  const take = { name: 'walk', range: [0, 2] as const, channels };
  return documentOf(character({ skeleton: skeleton(2), takes: [take], shownTake: 0 }));
}
const channelsOf = (document: ReturnType<typeof documentWith>) => shownTake(document.characters[0])?.channels ?? [];
const none = restChannel();

describe('simplifying curves', () => {
  const before = documentWith(wave(10), calm, none, wave(1), wave(0.5));
  const args = { characterId: 'c1', channels: [4, 3, 2, 1, 0], tolerance: { angle: 0.01, length: 0.5, weight: 1 } };

  it('takes a tolerance for each unit, and says beforehand what will come of it', () => {
    const preview = simplifyPreview(before, args);
    const { document } = simplify.run(before, args);
    const after = channelsOf(document);
    expect(preview.changed).toBe(3);
    expect(preview.keysBefore).toBe(3 * 61 + 2);
    expect(preview.keysAfter).toBe(after.reduce((sum, c) => sum + keysOf(c).times.length, 0));
    expect(preview.largest.length).toMatchObject({ channel: 0 });
    expect(preview.largest.length?.largestError).toBeGreaterThan(0.01);
    expect(preview.largest.length?.largestError).toBeLessThanOrEqual(0.5);
    expect(preview.largest.angle?.largestError).toBeLessThanOrEqual(0.01);
    expect(preview.largest.weight).toBeUndefined();
  });

  it('selects all keys of the curves that changed, and leaves the others the objects they are', () => {
    const { document, keys } = simplify.run(before, args);
    const after = channelsOf(document);
    expect(keys.map((k) => k.channel)).toEqual([0, 3, 4]);
    expect(keys.map((k) => k.indices.length)).toEqual([0, 3, 4].map((c) => keysOf(after[c]).times.length));
    expect([1, 2].map((c) => after[c] === channelsOf(before)[c])).toEqual([true, true]);
  });

  it('simplifying curves makes no step if no key can be removed', () => {
    const store = new Store(documentWith(calm));
    store.apply(simplify, { characterId: 'c1', channels: [0], tolerance: 1 });
    expect(store.undoLabel).toBeUndefined();
  });

  it('names itself by the number of curves', () => {
    expect(simplify.label(before, args)).toBe('Simplify 5 curves');
    expect(simplify.label(before, { ...args, channels: [3] })).toBe('Simplify rx of joint0');
  });

  it('refuses no tolerance, a reversed range and a channel that is not there', () => {
    const refused = (more: object) => expect(() => simplify.run(before, { ...args, ...more })).toThrow(CommandError);
    refused({ tolerance: 0 });
    refused({ tolerance: { angle: 1 } });
    refused({ tolerance: 'much' });
    refused({ range: [2, 1] });
    refused({ channels: [5] });
  });
});

describe('resampling, looping and baking curves', () => {
  it('resamples, and says how far off that is', () => {
    const before = documentWith(wave(10), none);
    const args = {
      characterId: 'c1',
      channels: [0, 1],
      framesPerSecond: 5,
      from: 0,
      to: 2,
      tangents: 'smooth' as const,
    };
    expect(resamplePreview(before, args)).toMatchObject({ changed: 1, keysBefore: 61, keysAfter: 11 });
    expect(resample.run(before, args).keys).toEqual([{ channel: 0, indices: [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10] }]);
    expect(() => resample.run(before, { ...args, framesPerSecond: 0 })).toThrow('frame rate');
    expect(() => resample.run(before, { ...args, to: -1 })).toThrow('before its start');
  });

  it('resampling, looping and baking curves makes loops, keeping the offset of the named channels', () => {
    const before = documentWith(wave(1), wave(1));
    const { document } = makeLoop.run(before, { characterId: 'c1', channels: [0, 1], keepOffset: [1] });
    expect(channelsOf(document).map((c) => c.extrapolateOut)).toEqual(['cycle', 'cycle_offset']);
    expect(makeLoop.label(before, { characterId: 'c1', channels: [0, 1] })).toBe('Make 2 curves loop');
  });

  it('a loop of a walk goes on from where it ends: lengths that travel keep their offset, unless told otherwise', () => {
    const walk = channelOf(Array.from({ length: 11 }, (_, i) => [i / 10, i / 2 + Math.sin(i) / 9, 'linear']));
    const before = documentWith(walk, wave(1), wave(1), walk);
    const args = { characterId: 'c1', channels: [0, 1, 2, 3] };
    const made = channelsOf(makeLoop.run(before, args).document);
    // The fourth is an angle.
    expect(made.map((c) => c.extrapolateOut)).toEqual(['cycle_offset', 'cycle', 'cycle', 'cycle']);
    expect(keysOf(made[0]).values[10]).toBe(keysOf(walk).values[10]);
    const again = makeLoop.run(before, { ...args, keepOffset: false }).document;
    expect(channelsOf(again).map((c) => c.extrapolateOut)).toEqual(['cycle', 'cycle', 'cycle', 'cycle']);
  });

  it('bakes, and reports whose period has changed', () => {
    const loop = { ...jumping, extrapolateIn: 'cycle' as const, extrapolateOut: 'cycle' as const };
    const before = documentWith(loop, calm);
    const args = { characterId: 'c1', channels: [0, 1], from: 0, to: 3 };
    // 3, −3 and 3 at one time, and again.
    expect(bakePreview(before, args)).toEqual({ keysBefore: 4, keysAfter: 8, periodsChanged: [0] });
    expect(bakeExtrapolation.run(before, args).keys).toEqual([{ channel: 0, indices: [0, 1, 2, 3, 4, 5] }]);
  });
});

/** What it comes to, with the channels afterwards. */
function filteredBy(document: Document, args: { characterId: string; channels: readonly number[] }) {
  const { edit, keysChanged, notes } = runToEnd(eulerFilterSteps(document, args));
  return { channels: channelsOf(edit.document), keysChanged, notes };
}

describe('the Euler filter over a character', () => {
  const three = [none, none, none];
  const rotations = { characterId: 'c1', channels: [3, 4, 5, 6, 7, 8] };

  it('the Euler filter over a character takes each joint by itself', () => {
    const before = documentWith(...three, jumping, calm, calm, calm, jumping, calm);
    const { document, keys } = eulerFilter.run(before, rotations);
    const after = channelsOf(document);
    // 6 rad to −3 rad is less than a quarter turn.
    expect(keysOf(after[3]).values[1]).toBeCloseTo(2 * Math.PI - 3, 12);
    expect(keysOf(after[7]).values[1]).toBeLessThanOrEqual(2 * Math.PI);
    expect(after[8]).toBe(channelsOf(before)[8]);
    expect(keys.map((k) => k.channel)).toEqual([3, 7]);
    expect(filteredBy(before, rotations)).toMatchObject({ keysChanged: 2, notes: [] });
  });

  it('finds the angles of any joint that has three, and skips those for which a whole turn matters', () => {
    const order = 'yxz';
    const free = joint(-1, { motion: { kind: 'free', order } });
    const screw = joint(0, { motion: { kind: 'screw', axis: [1, 0, 0], pitch: 2 } });
    const hinge = joint(0, { motion: { kind: 'hinge', axis: [1, 0, 0] }, name: 'elbow' });
    const couples = [{ dof: 'r', joint: 2, follows: 'r', gain: 0.5, offset: 0 }];
    const follower = joint(2, { motion: hinge.motion, couples });
    const flipped = { x: [Math.PI - 0.1], y: [Math.PI], z: [Math.PI] };
    const turn = (to: readonly number[]) => channelOf([[0, 0], ...to.map((value) => [1, value] as const)]);
    const before = documentOf(
      character({
        skeleton: { name: 'hero', joints: [free, screw, hinge, follower] },
        takes: [
          {
            name: 'turns',
            range: [0, 1],
            channels: [none, none, none, turn(flipped.x), turn(flipped.y), turn(flipped.z), jumping, jumping, jumping],
          },
        ],
        shownTake: 0,
      }),
    );
    const { channels, notes } = filteredBy(before, { characterId: 'c1', channels: [3, 4, 5, 6, 7, 8] });
    expectClose(
      [3, 4, 5].map((c) => keysOf(channels[c]).values[1]),
      [0.1, 0, 0],
      1e-12,
    );
    expect(notes).toEqual([
      'r of joint1: a full turn of it is a different pose; left unchanged.',
      'r of elbow: another DOF is linked to it; left unchanged.',
    ]);
  });

  it('unrolls by whole turns the angles that are not keyed or selected together, and says why', () => {
    const later = channelOf([[0.5, 0]]);
    const before = documentWith(...three, jumping, later, calm, jumping, none, calm);
    const { channels, notes } = filteredBy(before, rotations);
    expect(notes).toEqual([
      'joint0 of hero: its angles have keys at different times; only full turns were removed.',
      'joint1 of hero: not all three of its angles have keys; only full turns were removed.',
    ]);
    expect([3, 6].map((c) => keysOf(channels[c]).values[1])).toEqual([2 * Math.PI - 3, 2 * Math.PI - 3]);
    expect(filteredBy(before, { ...rotations, channels: [3] }).notes).toEqual([
      'joint0 of hero: not all three of its angles are selected; only full turns were removed.',
    ]);
    expect(filteredBy(before, { ...rotations, channels: [1] }).notes).toEqual(['ty is not an angle; left unchanged.']);
  });
});
