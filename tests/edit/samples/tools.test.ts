import { describe, expect, it } from 'vitest';
import { CommandError } from '../../../src/edit/command-error.ts';
import { eulerFilterSteps } from '../../../src/edit/commands/channels.ts';
import { setRetarget } from '../../../src/edit/commands/retarget.ts';
import {
  convertSteps,
  cropSamples,
  resampleSamples,
  resampleSteps,
  reverseSamples,
  reverseSteps,
  smoothSamples,
  smoothSteps,
  splitSamples,
  trimSamples,
} from '../../../src/edit/commands/samples.ts';
import { refuseTooMany } from '../../../src/edit/samples/most-frames.ts';
import { resampling } from '../../../src/edit/samples/resample.ts';
import { takeAlone } from '../../../src/edit/samples/take-alone.ts';
import { poseAt } from '../../../src/evaluate/pose.ts';
import { runToEnd } from '../../../src/evaluate/steps.ts';
import { type Document, shownTake } from '../../../src/model/document.ts';
import { keysOf, type Take } from '../../../src/model/takes/take.ts';
import { documentOf } from '../../helpers/builders.ts';
import { expectClose } from '../../helpers/close.ts';
import { channelOf } from '../keys/channels.ts';
import { documentWith, swing, swinging, takeOfColumns, WIDTH } from './made.ts';

const c1 = { characterId: 'c1' };

function takeOf(document: Document): Take {
  const take = shownTake(document.characters[0]);
  if (!take) throw new Error('the take is gone');
  return take;
}

function pose(take: Take, seconds: number): number[] {
  const out = new Float64Array(WIDTH);
  poseAt(swinging(take), seconds, out);
  return [...out];
}

describe('cutting samples', () => {
  it('crops to the frames within a range, at the times they had', () => {
    const take = takeOf(cropSamples.run(documentWith(), { ...c1, from: 0.49, to: 1.5 }));
    expect(take.samples?.frameCount).toBe(61);
    expect(take.range).toEqual([0.5, 1.5]);
    expect(pose(take, 1)).toEqual(pose(swing, 1));
    expect(take.samples?.values.buffer.byteLength).toBe(61 * WIDTH * 8);
  });

  it('times of frames typed with three decimals keep those frames', () => {
    // 60 frames a second: 34 / 60 = 0.56666…, 77 / 60 = 1.28333….
    const take = takeOf(cropSamples.run(documentWith(), { ...c1, from: 0.567, to: 1.283 }));
    expect(take.samples?.frameCount).toBe(44);
    expectClose(take.range, [34 / 60, 77 / 60], 1e-12);
    const [before, after] = splitSamples.run(documentWith(), { ...c1, timeSeconds: 0.567 }).characters[0].takes;
    expect([before, after].map(({ samples }) => samples?.frameCount)).toEqual([34, 87]);
  });

  it('trims either end at a time, keeping the frame there', () => {
    const start = takeOf(trimSamples.run(documentWith(), { ...c1, side: 'start', timeSeconds: 1 }));
    const end = takeOf(trimSamples.run(documentWith(), { ...c1, side: 'end', timeSeconds: 1 }));
    expect([start.range, end.range]).toEqual([
      [1, 2],
      [0, 1],
    ]);
  });

  it('splits into two takes, of which the second is shown', () => {
    const document = splitSamples.run(documentWith(), { ...c1, timeSeconds: 1 });
    const { takes, shownTake: shown } = document.characters[0];
    expect(takes.map((c) => [c.name, c.samples?.frameCount])).toEqual([
      ['swing', 60],
      ['swing_2', 61],
    ]);
    expect(shown).toBe(1);
    expect(pose(takes[1], 1.5)).toEqual(pose(swing, 1.5));
  });

  it('changes nothing if nothing is removed, and refuses to leave nothing', () => {
    const document = documentWith();
    expect(cropSamples.run(document, { ...c1, from: -1, to: 9 })).toBe(document);
    expect(() => cropSamples.run(document, { ...c1, from: 5, to: 9 })).toThrow(CommandError);
    expect(() => splitSamples.run(document, { ...c1, timeSeconds: -1 })).toThrow('on one side');
    expect(() => trimSamples.run(document, { ...c1, side: 'start', timeSeconds: 9 })).toThrow('from 0 s to 2 s');
  });
});

describe('resampling samples', () => {
  it('samples what plays at the new frames', () => {
    const take = takeOf(resampleSamples.run(documentWith(), { ...c1, framesPerSecond: 24 }));
    expect(take.samples?.frameCount).toBe(49);
    pose(take, 1.125).forEach((value, d) => {
      expect(value).toBeCloseTo(pose(swing, 1.125)[d], 12);
    });
    expect(resampleSamples.run(documentWith(), { ...c1, framesPerSecond: 60 }).characters[0].takes[0]).toBe(swing);
  });

  it('refuses more than a page can hold, frames or values', () => {
    const at = (framesPerSecond: number) => () => resampleSamples.run(documentWith(), { ...c1, framesPerSecond });
    expect(at(1e6)).toThrow('2,000,001 frames of 12 channels, but the maximum is 1,000,000');
    expect(at(Number.MAX_VALUE)).toThrow(CommandError);
    expect(() => refuseTooMany(200_001, 500)).toThrow('maximum is 200,000 frames');
    expect(refuseTooMany(200_000, 500)).toBeUndefined();
    // What is there already may be made again.
    expect(refuseTooMany(2_000_000, 500, 2_000_000)).toBeUndefined();
  });

  it('resampling samples turns joints the short way if an angle jumps from frame to frame', () => {
    const jump = takeOfColumns((c, t) => (c === 4 ? (t < 0.25 ? 178 : -178) : 0), 31, 60);
    const take = takeOf(resampleSamples.run(documentWith(jump), { ...c1, framesPerSecond: 120 }));
    const angle = pose(take, 14.5 / 60)[4];
    expect(Math.cos(angle)).toBeLessThan(-0.99);
  });
});

describe('reversing a take', () => {
  it('reversing a take plays it backwards, keys too', () => {
    const keyed = {
      ...swing,
      channels: swing.channels.map((c, i) =>
        i === 0
          ? channelOf([
              [0, 1],
              [1, 5],
            ])
          : c,
      ),
    };
    const take = takeOf(reverseSamples.run(documentWith(keyed), c1));
    for (const seconds of [0, 0.5, 2]) {
      pose(take, 2 - seconds).forEach((value, d) => {
        expect(value).toBeCloseTo(pose(keyed, seconds)[d], 10);
      });
    }
    const twice = takeOf(reverseSamples.run(documentWith(take), c1));
    expect(twice.samples?.values).toEqual(swing.samples?.values);
    expect([...keysOf(twice.channels[0]).times]).toEqual([0, 1]);
  });
});

describe('smoothing samples', () => {
  const smooth = (take: Take, sigmaSeconds = 0.05, channels?: readonly number[]) =>
    takeOf(smoothSamples.run(documentWith(take), { ...c1, sigmaSeconds, channels }));

  it('removes jitter and keeps ends and straight stretches', () => {
    const jitter = takeOfColumns((c, t) => (c === 0 ? 10 * t + (Math.round(60 * t) % 2 ? 0.1 : -0.1) : 0));
    const take = smooth(jitter);
    expect(pose(take, 1)[0]).toBeCloseTo(10, 3);
    expect(pose(take, 0)[0]).toBeCloseTo(-0.1, 12);
    const straight = takeOfColumns((c, t) => (c === 0 ? 10 * t : 0));
    for (const t of [0, 0.1, 1, 2]) expect(pose(smooth(straight), t)[0]).toBeCloseTo(10 * t, 10);
  });

  it('smoothing samples keeps of a swing what its formula says', () => {
    const period = 0.5;
    const wave = takeOfColumns((c, t) => (c === 0 ? Math.cos((2 * Math.PI * t) / period) : 0), 241, 120);
    expect(pose(smooth(wave), 1)[0]).toBeCloseTo(Math.exp(-2 * ((Math.PI * 0.05) / period) ** 2), 2);
  });

  it('smoothing samples does not smear angles that jump by a turn', () => {
    const turning = takeOfColumns((c, t) => (c === 3 ? ((90 * t + 170) % 360) - (90 * t + 170 >= 180 ? 360 : 0) : 0));
    const take = smooth(turning);
    for (const t of [0.05, 0.1, 0.111, 0.15, 1]) {
      expect(Math.cos(pose(take, t)[3] - ((90 * t + 170) * Math.PI) / 180)).toBeCloseTo(1, 4);
    }
  });

  it('leaves other channels, and keyed ones, unchanged', () => {
    const take = smooth(swing, 0.1, [0]);
    expect(pose(take, 0.7).slice(1)).toEqual(pose(swing, 0.7).slice(1));
    expect(pose(take, 0.7)[0]).toBeCloseTo(0.7, 10);
  });

  it('refuses a filter of no width', () => {
    expect(() => smooth(swing, 0)).toThrow(CommandError);
  });
});

describe('samples of a character that another one moves', () => {
  const source = swinging(takeOfColumns((c) => (c === 4 ? 90 : 0)));
  const driven = (take: Take) => {
    const moving = { ...source, id: 'c2', name: 'other' };
    return setRetarget.run(documentOf(swinging(take), moving), { ...c1, sourceId: 'c2' });
  };
  const tolerance = { position: 0.1, angle: 0.1 };

  it.each<[string, (document: Document) => Generator<number, unknown>]>([
    ['resample', (document) => resampleSteps(document, { ...c1, framesPerSecond: 30 })],
    ['reverse', (document) => reverseSteps(document, c1)],
    ['smooth', (document) => smoothSteps(document, { ...c1, sigmaSeconds: 0.1 })],
    ['convert', (document) => convertSteps(document, { ...c1, tolerance })],
    ['filter', (document) => eulerFilterSteps(document, { ...c1, channels: [3, 4, 5] })],
  ])('samples of a character that another one moves are refused to %s, before any work is done', (_, steps) => {
    const document = driven(swing);
    expect(document.characters[0].driver).toBeDefined();
    expect(() => steps(document).next()).toThrow('retargeted from');
  });

  it('tools use the samples of a retargeted character, not what retargeting makes of them', () => {
    const [character] = driven(swing).characters;
    expect(takeAlone(character, swing)).not.toHaveProperty('driver');
    const resampled = runToEnd(resampling(character, swing, 30));
    expect(pose(resampled, 1)).toEqual(
      pose(takeOf(resampleSamples.run(documentWith(), { ...c1, framesPerSecond: 30 })), 1),
    );
  });
});
