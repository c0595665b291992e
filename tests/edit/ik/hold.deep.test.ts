/** Pins held over a range: what moves for it, and what is refused. */
import { describe, expect, it } from 'vitest';
import { CommandError } from '../../../src/edit/command-error.ts';
import { holdPins, holdSteps } from '../../../src/edit/commands/hold.ts';
import { pinPoint, setRootFree, setStiffness } from '../../../src/edit/commands/ik.ts';
import { setDofs } from '../../../src/edit/commands/pose.ts';
import { setRetarget } from '../../../src/edit/commands/retarget.ts';
import { Store } from '../../../src/edit/store.ts';
import { runToEnd } from '../../../src/evaluate/steps.ts';
import type { Character } from '../../../src/model/document.ts';
import type { Skeleton } from '../../../src/model/skeleton/skeleton.ts';
import { type Channel, keysOf, restChannel } from '../../../src/model/takes/take.ts';
import { character, documentOf } from '../../helpers/builders.ts';
import { checkChannel } from '../../helpers/invariants.ts';
import { channelOf } from '../keys/channels.ts';
import {
  apart,
  FOOT,
  footAt,
  HOLD,
  LEG,
  REACH,
  shown,
  slide,
  store,
  swing,
  TOLERANCE,
  takeOf,
  valuesAt,
  walk,
} from './held-leg.ts';

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
    const before = takeOf(s);
    s.apply(holdPins, HOLD);
    const after = takeOf(s);
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
    const before = takeOf(s);
    const { report, edit } = runToEnd(holdSteps(s.document, HOLD));
    const own = edit.document.characters[0];
    const target = footAt(shown(s), 0.5);
    const worstWith = (c: number, channel: Channel) => {
      const take = own.takes[0];
      const channels = take.channels.map((was, i) => (i === c ? channel : was));
      return slide({ ...own, takes: [{ ...take, channels }] }, target, 0.5, 1);
    };
    expect(report.channels.length).toBeGreaterThan(1);
    for (const c of report.channels) expect(worstWith(c, before.channels[c])).toBeGreaterThan(0.5 * TOLERANCE);
  });

  it('changes nothing where the point slides by less than the tolerance', () => {
    const all = walk().channels.map((channel, c) => (c === 12 ? channel : restChannel(c === 6 ? 0.9 : 0)));
    all[0] = swing(0.3 * TOLERANCE, 0);
    const s = store({ takes: [{ ...walk(), channels: all }] });
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
      for (const k of indices) expect(keysOf(takeOf(s).channels[channel]).times[k]).toBeGreaterThanOrEqual(0.4 - 1e-9);
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
    const s = store({ takes: [{ ...walk(), channels: walk().channels.map(() => restChannel(0.3)) }] });
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
  it.each([
    ['not the root, nor its turn, if that is fixed', { isFree: false, locked: [] }, (c: number) => c < 6],
    ['not what is locked', { isFree: true, locked: [1] }, (c: number) => c >= 6 && c < 9],
  ] as const)('what a hold may move is %s', (_, { isFree, locked }, isHeld) => {
    const s = store();
    s.apply(setRootFree, { characterId: 'c1', isFree });
    if (locked.length) s.apply(setStiffness, { characterId: 'c1', joints: locked, stiffness: 'locked' });
    const before = takeOf(s);
    s.apply(holdPins, { ...HOLD, range: [0.5, 0.6] });
    const changed = takeOf(s).channels.flatMap((channel, c) => (channel === before.channels[c] ? [] : [c]));
    expect(changed.length).toBeGreaterThan(0);
    expect(changed.filter(isHeld)).toEqual([]);
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
    const gone = store({ takes: [{ ...far, channels }] });
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
    refused(store({ takes: [], shownTake: -1 }), {}, 'has no current take');
    const both = documentOf(
      character({ skeleton: LEG, takes: [walk()], shownTake: 0 }),
      character({ id: 's', skeleton: LEG, takes: [walk()], shownTake: 0 }),
    );
    const s = new Store(both);
    s.apply(pinPoint, { characterId: 'c1', joint: FOOT, point: [0, 0, 0] });
    s.apply(setRetarget, { characterId: 'c1', sourceId: 's' });
    refused(s, {}, /Bake/);
  });
});
