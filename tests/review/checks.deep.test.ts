/** Faults planted in real takes are found at their moment, and takes without faults have no flags. */
import { describe, expect, it } from 'vitest';
import { bakeRetarget } from '../../src/edit/commands/retarget.ts';
import { guessSpace } from '../../src/evaluate/space/space-guess.ts';
import { firstDofs } from '../../src/model/skeleton/dofs.ts';
import { positionsMeant, withPositions } from '../../src/model/skeleton/position-channels.ts';
import type { BvhChannel, Skeleton } from '../../src/model/skeleton/skeleton.ts';
import type { Space } from '../../src/model/space.ts';
import type { Samples } from '../../src/model/takes/samples.ts';
import type { Take } from '../../src/model/takes/take.ts';
import { checkTake } from '../../src/review/check-take.ts';
import { type Flag, type FlagKind, flagText } from '../../src/review/flags.ts';
import { captured, retargeted } from '../evaluate/retarget/captures.ts';
import { documentOf } from '../helpers/builders.ts';
import { BVH_FILES, sharedCaptures } from '../helpers/bvh-files.ts';
import { personSkeleton } from '../helpers/mocap.ts';
import { describeShared } from '../helpers/shared.ts';

interface ReadTake {
  readonly skeleton: Skeleton;
  readonly take: Take & { readonly samples: Samples };
  readonly space: Space;
}

function takeOf(file: string): ReadTake {
  const [{ skeleton: read, take }] = sharedCaptures(file);
  if (!take?.samples) throw new Error(`${file} has no frames.`);
  const skeleton = withPositions(read, positionsMeant(read, take));
  return { skeleton, take: { ...take, samples: take.samples }, space: guessSpace(skeleton, take) };
}

/** A value of a frame as the file has it: degrees, file units. */
type Change = (frame: number, was: number) => number;

/** The take with the values of one channel changed from frame to frame, last one included. */
function planted(
  { take, skeleton }: ReadTake,
  joint: string,
  channel: BvhChannel,
  [first, last]: readonly [number, number],
  change: Change,
) {
  const { samples } = take;
  const j = skeleton.joints.findIndex(({ name }) => name === joint);
  const { motion } = skeleton.joints[j];
  const c = motion.kind === 'bvh' ? motion.channels.indexOf(channel) : -1;
  expect(c).toBeGreaterThanOrEqual(0);
  const column = firstDofs(skeleton)[j] + c - samples.firstChannel;
  const values = samples.values.slice();
  for (let f = first; f <= last; f++) {
    const at = f * samples.scales.length + column;
    values[at] = change(f, values[at]);
  }
  return withValues(take, values);
}

function withValues(take: ReadTake['take'], values: Float64Array): ReadTake['take'] {
  return { ...take, samples: { ...take.samples, values } };
}

function newFlags(read: ReadTake, take: Take, kind: FlagKind): readonly Flag[] {
  const before = checkTake(read.skeleton, read.take, read.space).map(flagText);
  return checkTake(read.skeleton, take, read.space).filter((f) => f.kind === kind && !before.includes(flagText(f)));
}

describeShared('faults planted in real takes', () => {
  const mixamo = takeOf('mixamo-names.bvh');
  const whole = (read: ReadTake) => [0, read.take.samples.frameCount - 1] as const;

  it.each([
    ['toes up the shin', 'LeftFoot', 'rx', -90],
    ['toes to the back', 'RightFoot', 'rx', 100],
    ['heels in front', 'LeftFoot', 'ry', 180],
    ['a hand folded back', 'RightHand', 'rz', 140],
  ] as const)('a foot or a hand that points where none can is found: %s', (_, joint, channel, degrees) => {
    const name = `mixamorig:${joint}`;
    const take = planted(mixamo, name, channel, whole(mixamo), (_f, was) => was + degrees);
    expect(newFlags(mixamo, take, 'turned').map((flag) => flag.joint)).toContain(name);
    // A heel strikes for a moment only.
    const short = planted(mixamo, name, channel, [10, 20], (_f, was) => was + degrees);
    expect(newFlags(mixamo, short, 'turned')).toEqual([]);
  });

  it.each(['lafan1-dance-10frames.bvh', 'rokoko-dance.bvh'])(
    'a retarget that takes a lying file pose for a standing one is found from its start, a right one is not: %s',
    (file) => {
      const source = captured('cmu-01_01.bvh');
      const document = documentOf(source, retargeted(source, captured(file)));
      const [, { skeleton, takes, space }] = bakeRetarget.run(document, { characterId: file }).characters;
      const take = takes.at(-1);
      if (!skeleton || !space || !take?.samples) throw new Error(`${file} is not baked.`);
      const right: ReadTake = { skeleton, take: { ...take, samples: take.samples }, space };
      expect(checkTake(skeleton, take, space).filter(({ kind }) => kind === 'turned')).toEqual([]);
      // The bone from ankle to toe is in line with the shin there, so that toes come out up the shin.
      const wrong = planted(right, 'LeftFoot', 'rz', whole(right), (_f, was) => was + 2.2);
      expect(newFlags(right, wrong, 'turned')[0]).toMatchObject({ joint: 'LeftFoot', from: 0 });
    },
  );

  it.each(BVH_FILES)('no foot or hand of a real capture is called turned: %s', (file) => {
    const { skeleton, take, space } = takeOf(file);
    expect(checkTake(skeleton, take, space).filter(({ kind }) => kind === 'turned')).toEqual([]);
  });

  const bow = takeOf('bandai-namco-bow-normal.bvh');
  const chair = takeOf('xsens-armchair.bvh');
  const walk = takeOf('cmu-01_01.bvh');
  const neuron = takeOf('perception-neuron-course.bvh');

  it.each([
    ['an elbow', bow, 'LowerArm_R', 'rx', 40],
    ['hips that turn', chair, 'Hips', 'ry', 25],
    ['a shoulder', walk, 'LeftArm', 'rz', 30],
  ] as const)('a spike of %s is found at its frame, at its joint', (_, take, joint, channel, degrees) => {
    const frame = Math.floor(take.take.samples.frameCount / 2);
    const found = newFlags(
      take,
      planted(take, joint, channel, [frame, frame], (_f, was) => was + degrees),
      'spike',
    );
    expect(found).toHaveLength(1);
    expect(found[0].from).toBeCloseTo(frame * take.take.samples.frameSeconds, 9);
    expect(found[0].joint).toBe(joint);
  });

  it('a jump that stays is a spike of the root where it jumps', () => {
    const take = planted(bow, 'joint_Root', 'tx', [60, bow.take.samples.frameCount - 1], (_f, was) => was + 40);
    const found = newFlags(bow, take, 'spike');
    expect(found.map(({ from }) => Math.round(from * 30))).toEqual([60]);
    expect(found[0].amount).toBeCloseTo(0.4, 1);
  });

  it('a joint that trembles has jitter for as long as it does', () => {
    const take = planted(walk, 'RightForeArm', 'ry', [600, 720], (f, was) => was + (f % 2 === 0 ? 3 : -3));
    const [flag, ...others] = newFlags(walk, take, 'jitter');
    expect(others).toEqual([]);
    expect(Math.abs(flag.from - 600 / 120)).toBeLessThan(0.05);
    expect(Math.abs(flag.to - 720 / 120)).toBeLessThan(0.05);
  });

  it('standing feet that drift sideways by half a metre in a second slide', () => {
    const { frameCount } = bow.take.samples;
    const take = planted(
      bow,
      'joint_Root',
      'tx',
      [0, frameCount - 1],
      (f, was) => was + 50 * Math.min(1, Math.max(0, (f - 40) / 30)),
    );
    const found = newFlags(bow, take, 'slide');
    expect(found.length).toBeGreaterThan(0);
    for (const { from, amount } of found) {
      expect(from).toBeGreaterThan(1.2);
      expect(from).toBeLessThan(2.4);
      expect(amount).toBeLessThan(0.51);
    }
  });

  it('a character that sinks 20 cm for half a second is below the floor meanwhile', () => {
    const { frameSeconds } = chair.take.samples;
    const take = planted(chair, 'Hips', 'ty', [100, 130], (_f, was) => was - 20);
    const found = newFlags(chair, take, 'floor');
    expect(found.map(({ from, to }) => [Math.round(from / frameSeconds), Math.round(to / frameSeconds)])).toEqual([
      [100, 130],
    ]);
    expect(found[0].amount).toBeGreaterThan(0.12);
  });

  it('frames that repeat the one before are duplicates, and frozen from 0.3 s on', () => {
    const { samples } = chair.take;
    const width = samples.scales.length;
    const held = (from: number, to: number) => {
      const values = samples.values.slice();
      for (let f = from; f <= to; f++) values.copyWithin(f * width, (from - 1) * width, from * width);
      return withValues(chair.take, values);
    };
    const [duplicate, ...more] = newFlags(chair, held(80, 80), 'duplicate');
    expect([Math.round(duplicate.from / samples.frameSeconds), duplicate.amount, more]).toEqual([80, 1, []]);
    const [frozen, ...others] = newFlags(chair, held(80, 110), 'frozen');
    expect([
      Math.round(frozen.from / samples.frameSeconds),
      Math.round(frozen.to / samples.frameSeconds),
      others,
    ]).toEqual([79, 110, []]);
    expect(frozen.amount).toBeCloseTo(31 * samples.frameSeconds, 9);
  });

  it('an elbow folded flat is beyond what a joint can do', () => {
    const axes = ['rx', 'ry', 'rz'] as const;
    const folded = axes.flatMap((axis) => {
      const take = axes.reduce<ReadTake['take']>(
        (before, each) =>
          planted({ ...walk, take: before }, 'RightForeArm', each, [300, 330], () => (each === axis ? 175 : 0)),
        walk.take,
      );
      return newFlags(walk, take, 'limit').filter(({ joint }) => joint === 'RightForeArm');
    });
    expect(folded.length).toBeGreaterThan(0);
    for (const { from } of folded) expect(Math.abs(from - 2.5)).toBeLessThan(0.3);
  });

  it('hips that move below a root that stays have no bone to it', () => {
    // Bandai Namco's: the root stays at the origin of the studio.
    const take = takeOf('bandai-namco-bow-normal.bvh');
    const { joints } = take.skeleton;
    const hips = joints.findIndex(({ parent }) => parent === 0);
    expect(hips).toBe(1);
    const travelling = planted(take, joints[hips].name, 'tz', [0, 60], (frame, was) => was + frame);
    expect(newFlags(take, travelling, 'bone')).toEqual([]);
  });

  it('a bone that is stretched has a flag while it is', () => {
    const take = planted(neuron, 'LeftForeArm', 'tx', [100, 110], (_f, was) => was * 1.3);
    const found = newFlags(neuron, take, 'bone').filter(({ joint }) => joint === 'LeftForeArm');
    expect(found.map(({ from, to }) => [Math.round(from * 125), Math.round(to * 125)])).toEqual([[100, 110]]);
  });
});

describeShared('real takes as they are', () => {
  it.each([
    'bandai-namco-bow-normal.bvh',
    'xsens-armchair.bvh',
    'mixamo-names.bvh',
    'geno-stance.bvh',
    'lafan1-dance-10frames.bvh',
    'makehuman-tpose-add.bvh',
    'dialect-rows.bvh',
  ])('%s has no flags', (file) => {
    const { skeleton, take, space } = takeOf(file);
    expect(checkTake(skeleton, take, space).map(flagText)).toEqual([]);
  });

  it('a Kinect capture trembles, and its left and right shins differ', () => {
    const { skeleton, take, space } = takeOf('openni-kinect-hash-names.bvh');
    const kinds = new Set(checkTake(skeleton, take, space).map(({ kind }) => kind));
    expect([...kinds].sort()).toEqual(['bone', 'jitter', 'spike']);
  });
});

describe('takes without frames', () => {
  it('a take of keys is looked at 60 times a second, and its held poses are meant', () => {
    const held = personSkeleton();
    const take: Take = { name: 'held', range: [0, 2], channels: [] };
    expect(checkTake(held, take, { up: 'y', unit: 'centimetres', lift: 77 })).toEqual([]);
  });
});
