import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { type HoldPins, holdPins, holdSteps } from '../../../src/edit/commands/hold.ts';
import { pinPoint, setRootFree, setStiffness } from '../../../src/edit/commands/ik.ts';
import { setDofs } from '../../../src/edit/commands/pose.ts';
import { setRetarget } from '../../../src/edit/commands/retarget.ts';
import { CommandError, Store } from '../../../src/edit/store.ts';
import { pointAt, reachOfSkeleton } from '../../../src/evaluate/ik/set-up.ts';
import { compileSkeleton, worldMatrices } from '../../../src/evaluate/kinematics.ts';
import { dofCountOf, poseAt } from '../../../src/evaluate/pose.ts';
import { runToEnd } from '../../../src/evaluate/steps.ts';
import type { Vec3 } from '../../../src/math/vec3.ts';
import {
  type Channel,
  type ChannelClip,
  type KeyedChannel,
  keysOf,
  restChannel,
  SAMPLED,
} from '../../../src/model/clip.ts';
import type { Character } from '../../../src/model/document.ts';
import type { Skeleton } from '../../../src/model/skeleton.ts';
import { character, documentOf, joint } from '../../helpers/builders.ts';
import { checkChannel } from '../../helpers/invariants.ts';
import { evenly } from '../dice.ts';
import { channelOf, channels } from '../keys/channels.ts';

/** A hip, a knee, a foot, and an arm that has no part in it. 3 + 12 DOFs. */
const LEG: Skeleton = {
  name: 'leg',
  joints: [
    joint(-1, { name: 'hip' }),
    joint(0, { name: 'knee', offset: [0, -1, 0] }),
    joint(1, { name: 'foot', offset: [0, -1, 0] }),
    joint(0, { name: 'arm', offset: [1, 0, 0] }),
  ],
};
const REACH = reachOfSkeleton(LEG);
const FOOT = 2;
/** What is stated of it. */
const TOLERANCE = 1e-3 * REACH;

const swing = (height: number, phase: number): Channel =>
  channelOf(Array.from({ length: 9 }, (_, k) => [k / 4, height * Math.sin(1.5 * k + phase)] as const));

/** Bent at the knee, swinging; two seconds. */
function walk(): ChannelClip {
  const all: Channel[] = Array.from({ length: 15 }, () => restChannel());
  all[0] = swing(0.1, 0);
  all[3] = swing(0.2, 1);
  all[6] = channelOf(Array.from({ length: 9 }, (_, k) => [k / 4, 0.9 + 0.2 * Math.sin(k)] as const));
  all[12] = swing(0.5, 2);
  return { name: 'walk', range: [0, 2], channels: all };
}

function store(more: Partial<Character> = {}): Store {
  const made = new Store(documentOf(character({ skeleton: LEG, clips: [walk()], shownClip: 0, ...more })));
  made.apply(pinPoint, { characterId: 'c1', joint: FOOT, point: [0, 0, 0] });
  return made;
}

const HOLD: HoldPins = { characterId: 'c1', pins: [1], range: [0.5, 1], atSeconds: 0.5, framesPerSecond: 30 };
const shown = (s: Store): Character => s.document.characters[0];
const clipOf = (s: Store): ChannelClip => shown(s).clips[0];

function footAt(c: Character, seconds: number, j = FOOT, point: Vec3 = [0, 0, 0]): Vec3 {
  if (!c.skeleton) throw new Error('no skeleton');
  const compiled = compileSkeleton(c.skeleton);
  const dofs = new Float64Array(dofCountOf(c));
  const world = new Float64Array(16 * compiled.jointCount);
  poseAt(c, seconds, dofs);
  worldMatrices(compiled, dofs, world);
  return pointAt(world, j, point);
}

const apart = (a: Vec3, b: Vec3) => Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);

/** The furthest that the foot gets from a place, at any time between. */
function slide(c: Character, place: Vec3, from: number, to: number): number {
  let worst = 0;
  for (let i = 0; i <= 200; i++) worst = Math.max(worst, apart(footAt(c, from + ((to - from) * i) / 200), place));
  return worst;
}

function valuesAt(c: Character, seconds: number): number[] {
  const dofs = new Float64Array(dofCountOf(c));
  poseAt(c, seconds, dofs);
  return [...dofs];
}

describe('holding a pin over a range of time', () => {
  it('holding a pin over a range of time keeps its point in its place at every moment, which it would leave', () => {
    const s = store();
    const before = shown(s);
    const place = footAt(before, 0.5);
    expect(slide(before, place, 0.5, 1)).toBeGreaterThan(0.1);
    s.apply(holdPins, HOLD);
    expect(slide(shown(s), place, 0.5, 1)).toBeLessThan(TOLERANCE);
    expect(s.undoLabel).toBe('Hold foot');
  });

  it('takes the place from any moment, inside of the range or not', () => {
    const s = store();
    const place = footAt(shown(s), 1.7);
    s.apply(holdPins, { ...HOLD, atSeconds: 1.7 });
    expect(slide(shown(s), place, 0.5, 1)).toBeLessThan(TOLERANCE);
  });

  it('changes nothing before it starts and after it has ended', () => {
    const s = store();
    const before = shown(s);
    s.apply(holdPins, { ...HOLD, easeSeconds: 0.2 });
    for (const seconds of [-1, 0, 0.2, 0.2999, 1.2001, 1.5, 2, 3]) {
      const [now, then] = [valuesAt(shown(s), seconds), valuesAt(before, seconds)];
      now.forEach((value, d) => {
        expect(value).toBeCloseTo(then[d], 12);
      });
    }
  });

  it('eases in and out without a jump', () => {
    const s = store();
    const before = shown(s);
    s.apply(holdPins, { ...HOLD, easeSeconds: 0.25 });
    const step = 1 / 480;
    let fastest = 0;
    for (let t = 0.2; t < 1.3; t += step)
      fastest = Math.max(fastest, apart(footAt(shown(s), t), footAt(shown(s), t + step)));
    // A smoothstep is nowhere steeper than 1.5 of its mean; the foot's own way is added to that.
    const way = slide(before, footAt(before, 0.5), 0.25, 1.25);
    expect(fastest / step).toBeLessThan((1.5 * way) / 0.25 + 3);
  });

  it('keys only what has to change, and little of that', () => {
    const s = store();
    const before = clipOf(s);
    s.apply(holdPins, HOLD);
    const after = clipOf(s);
    after.channels.forEach((channel, c) => {
      const isArm = c >= 12;
      // Everything moves in one plane, and the foot's own turning moves nothing.
      const isOnWay = [0, 1, 3, 6].includes(c) || [2, 4, 5, 7, 8].includes(c);
      if (isArm || !isOnWay) expect(channel).toBe(before.channels[c]);
      checkChannel(channel);
    });
    const keyed = after.channels.filter((channel, c) => channel !== before.channels[c]);
    expect(keyed.length).toBeGreaterThan(1);
    // A key a frame, and the frames that were added, would be dozens.
    for (const { times } of keyed.map(keysOf))
      expect([...times].filter((t) => t >= 0.4 && t <= 1.1).length).toBeLessThan(16);
  });

  it('changes no channel and no key without which nothing would slide', () => {
    const s = store();
    const before = clipOf(s);
    const { report, edit } = runToEnd(holdSteps(s.document, HOLD));
    const own = edit.document.characters[0];
    const target = footAt(shown(s), 0.5);
    const worstWith = (c: number, channel: Channel) => {
      const clip = own.clips[0];
      const channels = clip.channels.map((was, i) => (i === c ? channel : was));
      return slide({ ...own, clips: [{ ...clip, channels }] }, target, 0.5, 1);
    };
    expect(report.channels.length).toBeGreaterThan(1);
    for (const c of report.channels) expect(worstWith(c, before.channels[c])).toBeGreaterThan(0.5 * TOLERANCE);
  });

  it('changes nothing where the point slides by less than the tolerance', () => {
    const all = walk().channels.map((channel, c) => (c === 12 ? channel : restChannel(c === 6 ? 0.9 : 0)));
    all[0] = swing(0.3 * TOLERANCE, 0);
    const s = store({ clips: [{ ...walk(), channels: all }] });
    const { document } = s;
    expect(slide(shown(s), footAt(shown(s), 0.5), 0.5, 1)).toBeGreaterThan(0.1 * TOLERANCE);
    s.apply(holdPins, HOLD);
    expect(s.document).toBe(document);
  });

  it('holding a pin over a range of time keeps the orientation of a joint that is pinned at its origin', () => {
    const s = store();
    s.apply(pinPoint, { characterId: 'c1', joint: FOOT, point: [0, 0, 0.01], holdsOrientation: true });
    const toe = (c: Character, t: number) => {
      const [a, b] = [footAt(c, t), footAt(c, t, FOOT, [0, 0, 1])];
      return [b[0] - a[0], b[1] - a[1], b[2] - a[2]] as const;
    };
    const from = toe(shown(s), 0.5);
    expect(apart(toe(shown(s), 0.9), from)).toBeGreaterThan(0.05);
    s.apply(holdPins, { ...HOLD, pins: [2] });
    for (let t = 0.5; t <= 1; t += 0.01) expect(apart(toe(shown(s), t), from)).toBeLessThan(5e-3);
  });

  it('selects the keys that it has made', () => {
    const s = store();
    s.select({ characterId: 'c1' });
    s.apply(holdPins, HOLD);
    const { keys = [] } = s.selection;
    expect(keys.length).toBeGreaterThan(1);
    for (const { channel, indices } of keys) {
      for (const k of indices) expect(keysOf(clipOf(s).channels[channel]).times[k]).toBeGreaterThanOrEqual(0.4 - 1e-9);
    }
  });

  it('holding a pin over a range of time is one step, and undone to the very document', () => {
    const s = store();
    const { document } = s;
    s.apply(holdPins, HOLD);
    const held = s.document;
    expect(held).not.toBe(document);
    s.undo();
    expect(s.document).toEqual(document);
    s.redo();
    expect(s.document).toEqual(held);
  });

  it('changes nothing where the point stays by itself', () => {
    const s = store({ clips: [{ ...walk(), channels: walk().channels.map(() => restChannel(0.3)) }] });
    const { document } = s;
    s.apply(holdPins, HOLD);
    expect(s.document).toBe(document);
  });

  it('uses transport time for a character that starts later', () => {
    const s = store({ timeOffsetSeconds: 0.3 });
    const place = footAt(shown(s), 0.5);
    s.apply(holdPins, HOLD);
    expect(slide(shown(s), place, 0.5, 1)).toBeLessThan(TOLERANCE);
  });

  it('starts from unkeyed changes, which are then keyed', () => {
    const s = store();
    s.apply(setDofs, { characterId: 'c1', dofs: [{ index: 3, value: 0.6 }], timeSeconds: 0.5 });
    const place = footAt(shown(s), 0.5);
    s.apply(holdPins, HOLD);
    expect(shown(s).unkeyed).toBeUndefined();
    expect(slide(shown(s), place, 0.5, 1)).toBeLessThan(TOLERANCE);
  });

  it('reports its result', () => {
    const s = store();
    const { report } = runToEnd(holdSteps(s.document, HOLD));
    const [pin] = report.pins;
    expect(pin.pin).toBe(1);
    expect(pin.slideBefore).toBeGreaterThan(0.1);
    expect(pin.slideAfter).toBeLessThan(TOLERANCE);
    expect(report.unreached).toBe(0);
  });
});

describe('what a hold may move', () => {
  it('what a hold may move is not what is locked, and not the root if that is fixed', () => {
    const s = store();
    s.apply(setRootFree, { characterId: 'c1', isFree: false });
    s.apply(setStiffness, { characterId: 'c1', joints: [1], stiffness: 'locked' });
    const before = clipOf(s);
    s.apply(holdPins, { ...HOLD, range: [0.5, 0.6] });
    const changed = clipOf(s).channels.flatMap((channel, c) => (channel === before.channels[c] ? [] : [c]));
    expect(changed.length).toBeGreaterThan(0);
    expect(changed.every((c) => c >= 3 && c < 6)).toBe(true);
  });

  it('what a hold may move stays within limits at all times', () => {
    const limits = [
      { min: -0.5, max: 0.3 },
      { min: -0.1, max: 0.1 },
      { min: -0.1, max: 0.1 },
    ];
    const bound: Skeleton = { ...LEG, joints: LEG.joints.map((j, i) => (i === 0 ? { ...j, limits } : j)) };
    const s = store({ skeleton: bound });
    s.apply(holdPins, { ...HOLD, atSeconds: 1.6 });
    for (let t = 0.3; t < 1.2; t += 0.01) {
      const hip = valuesAt(shown(s), t).slice(3, 6);
      hip.forEach((value, k) => {
        expect(value).toBeGreaterThanOrEqual(limits[k].min);
        expect(value).toBeLessThanOrEqual(limits[k].max);
      });
    }
  });

  it('approaches unreachable targets as closely as possible, and reports in how many frames', () => {
    const s = store();
    s.apply(setRootFree, { characterId: 'c1', isFree: false });
    const far = walk();
    const channels = [...far.channels];
    channels[0] = channelOf([
      [0, 0],
      [2, 6],
    ]);
    const gone = store({ clips: [{ ...far, channels }] });
    gone.apply(setRootFree, { characterId: 'c1', isFree: false });
    const { report, edit } = runToEnd(holdSteps(gone.document, { ...HOLD, range: [0.2, 1.6], atSeconds: 0.2 }));
    expect(report.unreached).toBeGreaterThan(10);
    const after = edit.document.characters[0];
    // The hip is 4.2 from where it was, and the leg 2 long.
    const place = footAt(shown(gone), 0.2);
    expect(apart(footAt(after, 1.5), place)).toBeLessThan(apart(footAt(shown(gone), 1.5), place));
    let jerk = 0;
    for (let t = 0.3; t < 1.5; t += 1 / 120) {
      const [a, b, c] = [0, 1, 2].map((k) => footAt(after, t + k / 120));
      jerk = Math.max(jerk, Math.hypot(...a.map((x, k) => x - 2 * b[k] + c[k])));
    }
    expect(jerk).toBeLessThan(0.05 * REACH);
  });

  it('what a hold may move is rotated back too, if a pin holds its orientation', () => {
    const s = store();
    s.apply(pinPoint, { characterId: 'c1', joint: FOOT, point: [0, -0.2, 0], holdsOrientation: true });
    const ends = (c: Character, t: number) => [footAt(c, t, FOOT, [1, 0, 0]), footAt(c, t, FOOT, [0, 0, 1])];
    const [x, z] = ends(shown(s), 0.5);
    s.apply(holdPins, { ...HOLD, pins: [2] });
    for (let t = 0.5; t <= 1; t += 0.01) {
      const [nowX, nowZ] = ends(shown(s), t);
      expect(apart(nowX, x)).toBeLessThan(4 * TOLERANCE);
      expect(apart(nowZ, z)).toBeLessThan(4 * TOLERANCE);
    }
  });
});

describe('takes of other kinds', () => {
  it('takes of other kinds that repeat are baked over the playback range, and continue as before', () => {
    const looped = walk();
    const all = looped.channels.map((channel, c): Channel => {
      if (keysOf(channel).times.length === 0) return channel;
      const kind = c === 0 ? 'cycle_offset' : 'cycle';
      return { ...channel, extrapolateIn: kind, extrapolateOut: kind };
    });
    const s = store({ clips: [{ ...looped, range: [0, 6], channels: all }] });
    const before = shown(s);
    const place = footAt(before, 2.5);
    s.apply(holdPins, { ...HOLD, range: [2.4, 2.8], atSeconds: 2.5 });
    expect(slide(shown(s), place, 2.4, 2.8)).toBeLessThan(TOLERANCE);
    for (const seconds of [0, 0.5, 2.29, 2.91, 4.5, 5.9]) {
      valuesAt(shown(s), seconds).forEach((value, d) => {
        expect(value).toBeCloseTo(valuesAt(before, seconds)[d], 9);
      });
    }
  });

  it('takes of other kinds of samples get other frames, and those outside are exactly unchanged', () => {
    const rows = 61;
    const values = new Float64Array(15 * rows);
    for (let f = 0; f < rows; f++) {
      values[15 * f] = 0.1 * Math.sin(f / 9);
      values[15 * f + 3] = 20 * Math.sin(f / 7);
      values[15 * f + 6] = 50 + 10 * Math.sin(f / 5);
    }
    const scales = Float64Array.from({ length: 15 }, (_, c) => (c < 3 ? 1 : Math.PI / 180));
    const samples = { frameCount: rows, frameSeconds: 1 / 30, startSeconds: 0, firstChannel: 0, values, scales };
    const channels = Array.from({ length: 15 }, () => SAMPLED);
    const clip: ChannelClip = {
      name: 'take',
      range: [0, 2],
      channels,
      samples: { ...samples, interpolation: 'linear' },
    };
    const s = store({ clips: [clip] });
    const place = footAt(shown(s), 0.5);
    s.apply(holdPins, HOLD);
    const now = clipOf(s).samples?.values ?? values;
    const framesChanged = Array.from({ length: rows }, (_, f) => f).filter((f) =>
      now.subarray(15 * f, 15 * f + 15).some((value, c) => value !== values[15 * f + c]),
    );
    // Held are frames 15 to 30; three on either side go there and back, of which the outermost gets nothing.
    expect([framesChanged[0], framesChanged[framesChanged.length - 1]]).toEqual([13, 32]);
    expect(clipOf(s).channels).toEqual(channels);
    for (let f = 15; f <= 30; f++) expect(apart(footAt(shown(s), f / 30), place)).toBeLessThan(1e-4 * REACH);
    expect(slide(shown(s), place, 0.5, 1)).toBeLessThan(2 * TOLERANCE);
    s.undo();
    expect(clipOf(s)).toBe(clip);
  });

  it('takes of other kinds with quaternions keep to one side of them', () => {
    const bent = (j: number) => ({
      ...LEG.joints[j],
      motion: { kind: 'quaternion' } as const,
      limits: [],
      pose: [0, 0, 0, 1],
    });
    const joints = [bent(0), bent(1), bent(2), LEG.joints[3]];
    const all: Channel[] = Array.from({ length: 3 + 12 + 3 }, () => restChannel());
    for (const j of [0, 1]) {
      const turn = (k: number) => (j === 0 ? 0.4 * Math.sin(k) : 1 + 0.3 * Math.sin(2 * k)) / 2;
      // The negative of what is usual.
      all[3 + 4 * j] = channelOf(Array.from({ length: 9 }, (_, k) => [k / 4, -Math.sin(turn(k))] as const));
      all[3 + 4 * j + 3] = channelOf(Array.from({ length: 9 }, (_, k) => [k / 4, -Math.cos(turn(k))] as const));
    }
    all[14] = restChannel(1);
    const s = store({ skeleton: { ...LEG, joints }, clips: [{ name: 'turning', range: [0, 2], channels: all }] });
    const place = footAt(shown(s), 0.5);
    s.apply(holdPins, HOLD);
    expect(slide(shown(s), place, 0.5, 1)).toBeLessThan(TOLERANCE);
    for (let t = 0; t < 2; t += 0.01) expect(valuesAt(shown(s), t)[6]).toBeLessThan(-0.5);
  });

  it('takes of other kinds are held to their ends, if nothing comes before or after', () => {
    const s = store();
    const place = footAt(shown(s), 0);
    s.apply(holdPins, { ...HOLD, range: [-1, 9], atSeconds: 0 });
    expect(slide(shown(s), place, 0, 2)).toBeLessThan(TOLERANCE);
    for (const { times } of clipOf(s).channels.map(keysOf))
      for (const time of times) expect(time >= 0 && time <= 2).toBe(true);
  });
});

describe('what can not be held', () => {
  const refused = (s: Store, args: object, why: string | RegExp) => {
    const { document } = s;
    // What a person may type into a console is not typed.
    expect(() => s.apply(holdPins, { ...HOLD, ...args } as never)).toThrow(why);
    expect(() => s.apply(holdPins, { ...HOLD, ...args } as never)).toThrow(CommandError);
    expect(s.document).toBe(document);
  };

  it('what can not be held is nothing, or a pin that is not there', () => {
    refused(store(), { pins: [] }, 'at least one pin');
    refused(store(), { pins: [7] }, 'There is no pin 7');
  });

  it('what can not be held is a time at which nothing is played, or that runs backwards', () => {
    refused(store(), { range: [5, 6] }, 'There is nothing to play there: the take runs from 0 s to 2 s');
    refused(store(), { range: [1, 0.5] }, 'start before it ends');
  });

  it('what can not be held is at no rate, in no time, within no tolerance', () => {
    refused(store(), { framesPerSecond: 0 }, 'greater than 0');
    refused(store(), { framesPerSecond: 1e9 }, 'frames');
    refused(store(), { easeSeconds: -1 }, 'must be 0 or more');
    refused(store(), { tolerance: 0 }, 'greater than 0');
  });

  it('what can not be held is a character without a take, or one driven by retargeting', () => {
    refused(store({ clips: [], shownClip: -1 }), {}, 'shows no take');
    const both = documentOf(
      character({ skeleton: LEG, clips: [walk()], shownClip: 0 }),
      character({ id: 's', skeleton: LEG, clips: [walk()], shownClip: 0 }),
    );
    const s = new Store(both);
    s.apply(pinPoint, { characterId: 'c1', joint: FOOT, point: [0, 0, 0] });
    s.apply(setRetarget, { characterId: 'c1', sourceId: 's' });
    refused(s, {}, /Bake/);
  });
});

describe('whatever the way', () => {
  const wave = fc.record({ height: evenly, phase: evenly, often: evenly });
  const moment = evenly.map((x) => 0.2 + 1.6 * x);

  /** Between the moments that are looked at it slid further than at any of them. */
  const SLID = [
    { height: 0, phase: 0, often: 0 },
    { height: 0.07607001066207886, phase: 0.27410661336034536, often: 0.946050938218832 },
    { height: 0.42853956390172243, phase: 0.8116739178076386, often: 0.8125711316242814 },
    { height: 0.041463736444711685, phase: 0.7419948596507311, often: 0.3978219283744693 },
    { height: 0.8810158837586641, phase: 0, often: 0.2331058569252491 },
    { height: 0.9448522180318832, phase: 0.43306917417794466, often: 0.7764134705066681 },
    { height: 0.8755024150013924, phase: 0.001748216338455677, often: 0.8665342843160033 },
    { height: 0.48492153733968735, phase: 0.9635243909433484, often: 0.7949800817295909 },
    { height: 0.33371810149401426, phase: 0.4577729608863592, often: 0.45827419869601727 },
  ];

  it('whatever the way of the joints, the point stays in place, between frames too, and no curve deviates', {
    timeout: 60_000,
  }, () => {
    fc.assert(
      fc.property(fc.array(wave, { minLength: 9, maxLength: 9 }), moment, moment, (waves, a, b) => {
        const all = waves.map(({ height, phase, often }) =>
          channelOf(
            Array.from({ length: 17 }, (_, k) => [k / 8, 0.3 * height * Math.sin(often * k + 7 * phase)] as const),
          ),
        );
        const made = [...all, ...Array.from({ length: 6 }, () => restChannel())];
        const s = store({ clips: [{ name: 'any', range: [0, 2], channels: made }] });
        const range = [Math.min(a, b), Math.max(a, b)] as const;
        const place = footAt(shown(s), a);
        s.apply(holdPins, { ...HOLD, range, atSeconds: a });
        expect(slide(shown(s), place, ...range)).toBeLessThan(TOLERANCE);
      }),
      { numRuns: 25, examples: [[SLID, 0.5823565781116486, 0.564058494567871]] },
    );
  });
});

describe('whatever the curves', () => {
  const some = fc.array(channels(1, { steps: true, maxLength: 6 }), { minLength: 9, maxLength: 9 });
  const moment = fc.integer({ min: 0, max: 16 }).map((n) => n / 8);
  const small = (channel: KeyedChannel): KeyedChannel => ({
    ...channel,
    values: channel.values.map((v) => Math.atan(v)),
    tangentsIn: { ...channel.tangentsIn, slopes: channel.tangentsIn.slopes.map((v) => Math.atan(v)) },
    tangentsOut: { ...channel.tangentsOut, slopes: channel.tangentsOut.slopes.map((v) => Math.atan(v)) },
  });

  it('a hold is undone to the identical document, and keeps the curves outside unchanged', { timeout: 60_000 }, () => {
    fc.assert(
      fc.property(some, moment, moment, moment, (given, a, b, at) => {
        const all = [...given.map(small), ...Array.from({ length: 6 }, () => restChannel(0.1))];
        const s = store({ clips: [{ name: 'any', range: [0, 2], channels: all }] });
        const { document } = s;
        const before = shown(s);
        const range = [Math.min(a, b), Math.max(a, b)] as const;
        s.apply(holdPins, { ...HOLD, range, atSeconds: at, framesPerSecond: 8, easeSeconds: 0.125 });
        const after = shown(s);
        for (const channel of after.clips[0].channels) checkChannel(channel);
        // Not at the moments of steps, which have a value of their own.
        for (let t = 0.0123; t < 2; t += 0.0617) {
          if (t > range[0] - 0.13 && t < range[1] + 0.13) continue;
          const then = valuesAt(before, t);
          valuesAt(after, t).forEach((value, d) => {
            expect(Math.abs(value - then[d])).toBeLessThan(1e-9 * (1 + Math.abs(then[d])));
          });
        }
        if (s.document !== document) {
          s.undo();
          expect(s.document).toEqual(document);
        }
      }),
      { numRuns: 30 },
    );
  });
});
