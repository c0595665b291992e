/** Filters over samples: what they leave, what they take away, and where a range begins and ends. */
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { CommandError } from '../../../src/edit/command-error.ts';
import { eulerFilter, eulerFilterSteps } from '../../../src/edit/commands/channels.ts';
import { smoothSamples } from '../../../src/edit/commands/samples.ts';
import { gaussian } from '../../../src/edit/samples/gaussian.ts';
import { medianFrame } from '../../../src/edit/samples/median.ts';
import { frameRange, weightAt } from '../../../src/edit/samples/seam.ts';
import { Store } from '../../../src/edit/store.ts';
import { compileSkeleton, worldMatrices } from '../../../src/evaluate/kinematics.ts';
import { runToEnd } from '../../../src/evaluate/steps.ts';
import { RADIANS_PER_DEGREE } from '../../../src/math/degrees.ts';
import { type Document, shownTake } from '../../../src/model/document.ts';
import type { Samples } from '../../../src/model/takes/samples.ts';
import type { Take } from '../../../src/model/takes/take.ts';
import { CHAIN, documentWith, swing, takeOfColumns, WIDTH } from './made.ts';

const c1 = { characterId: 'c1' };

function takeOf(document: Document): Take {
  const take = shownTake(document.characters[0]);
  if (!take) throw new Error('the take is gone');
  return take;
}

function samplesOf(take: Take): Samples {
  if (!take.samples) throw new Error('the samples are gone');
  return take.samples;
}

const rows = (take: Take) => samplesOf(take).values;
const row = (take: Take, frame: number) => [...rows(take).slice(frame * WIDTH, (frame + 1) * WIDTH)];

/** World matrices of all joints in a frame, by the formula alone: turns and flips of angles are no difference. */
function worldOf(take: Take, frame: number): Float64Array {
  const { scales } = samplesOf(take);
  const dofs = Float64Array.from(row(take, frame), (value, c) => value * scales[c]);
  const world = new Float64Array(16 * CHAIN.joints.length);
  worldMatrices(compileSkeleton(CHAIN), dofs, world);
  return world;
}

function apart(a: ArrayLike<number>, b: ArrayLike<number>): number {
  return Math.max(...Array.from(a, (value, i) => Math.abs(value - b[i])));
}

type Args = Omit<Parameters<typeof smoothSamples.run>[1], 'characterId'>;
const filter = (take: Take, args: Args) => takeOf(smoothSamples.run(documentWith(take), { ...c1, ...args }));
const median = (take: Take, frames = 3, more: Args = {}) => filter(take, { filter: 'median', frames, ...more });

/** A take of any angles, in degrees, with jumps of whole turns among them. */
const anyTake = fc
  .array(fc.double({ min: -179, max: 179, noNaN: true }), { minLength: 40 * WIDTH, maxLength: 40 * WIDTH })
  .map((values) => takeOfColumns((c, t) => values[Math.round(t * 60) * WIDTH + c], 40));

describe('smoothing within a range', () => {
  it('leaves every bit outside, and passes over little by little inside', () => {
    const jitter = takeOfColumns((c, t) => swingAt(c, t) + (Math.round(60 * t) % 2 ? 3 : -3));
    const [whole, part] = [
      filter(jitter, { sigmaSeconds: 0.05 }),
      filter(jitter, { sigmaSeconds: 0.05, range: [0.5, 1.5] }),
    ];
    for (const frame of [0, 10, 29, 91, 120]) expect(row(part, frame)).toEqual(row(jitter, frame));
    // 3σ are nine frames.
    for (const frame of [39, 60, 81]) expect(apart(worldOf(part, frame), worldOf(whole, frame))).toBeLessThan(1e-9);
    for (let frame = 31; frame <= 38; frame++) {
      const off = apart(row(part, frame).slice(0, 3), row(jitter, frame).slice(0, 3));
      const before = apart(row(part, frame - 1).slice(0, 3), row(jitter, frame - 1).slice(0, 3));
      expect(off).toBeGreaterThan(before);
    }
  });

  it('adds no turn where the range ends', () => {
    const turning = takeOfColumns((c, t) => (c >= 3 && c < 6 && c !== 4 ? ((170 + 200 * t + 180) % 360) - 180 : 0));
    const part = filter(turning, { sigmaSeconds: 0.03, range: [0.2, 1] });
    for (let frame = 0; frame < 121; frame++) expect(apart(row(part, frame), row(turning, frame))).toBeLessThan(180);
  });

  it('sees the frames outside, also from near the ends of the take', () => {
    const [whole, part] = [
      filter(swing, { sigmaSeconds: 0.1 }),
      filter(swing, { sigmaSeconds: 0.1, range: [-1, 0.9] }),
    ];
    for (const frame of [0, 1, 20, 36]) expect(apart(worldOf(part, frame), worldOf(whole, frame))).toBeLessThan(1e-9);
  });

  it('weighs from 0 to 1, without a seam at the ends of the take', () => {
    fc.assert(
      fc.property(fc.nat(200), fc.nat(200), fc.nat(60), (a, b, reach) => {
        const range = frameRange(samplesOf(takeOfColumns(() => 0, 201)), [Math.min(a, b) / 60, Math.max(a, b) / 60]);
        const weights = Array.from({ length: 201 }, (_, f) => weightAt(range, reach, f));
        expect(weights.every((w, f) => w >= 0 && w <= 1 && w > 0 === (f >= range.first && f < range.end))).toBe(true);
        expect(Math.max(...weights)).toBeGreaterThanOrEqual(range.end - range.first > 1 ? 0.5 : 0);
        if (range.first === 0 && range.end - 1 > 2 * reach) expect(weights[0]).toBe(1);
      }),
    );
  });

  it('refuses a range without frames, a reversed one, and invalid filters', () => {
    const tried = (args: Args) => () => filter(swing, args);
    expect(tried({ sigmaSeconds: 0.1, range: [5, 6] })).toThrow('There are no frames there');
    expect(tried({ sigmaSeconds: 0.1, range: [1, 0] })).toThrow('must start before it ends');
    expect(tried({ filter: 'median', frames: 4 })).toThrow('3, 5, 7');
    expect(tried({ filter: 'median' })).toThrow(CommandError);
    expect(tried({})).toThrow('greater than 0, found nothing');
  });
});

function swingAt(c: number, t: number): number {
  return c < 3 ? t * (c + 1) : 30 * Math.sin(2 * t + c);
}

describe('a Gaussian', () => {
  it('a Gaussian is one frame where σ is as good as none', () => {
    expect([...gaussian(1e-200, 10)]).toEqual([1, 0]);
    expect(rows(filter(swing, { sigmaSeconds: 1e-200 })).every(Number.isFinite)).toBe(true);
  });
});

describe('the median of a few frames', () => {
  it('takes out spikes of a frame or two, of lengths and of rotations, and leaves every bit away from them', () => {
    const spikes = [20, 50, 51, 90];
    const ramp = (c: number, t: number) => (c + 1) * t;
    const spiky = takeOfColumns((c, t) => ramp(c, t) + (spikes.includes(Math.round(60 * t)) ? 70 - 3 * c : 0));
    const clean = median(spiky, 5);
    for (let frame = 0; frame < 121; frame++) {
      if (spikes.every((s) => Math.abs(s - frame) > 2)) expect(row(clean, frame)).toEqual(row(spiky, frame));
      // What the quickest goes in two frames.
      expect(apart(row(clean, frame), row(takeOfColumns(ramp), frame))).toBeLessThan((2 * WIDTH) / 60 + 1e-9);
    }
  });

  it('the median of a few frames keeps monotonic stretches, corners and steps', () => {
    const step = takeOfColumns((c, t) => (c < 3 ? Math.min(1, t) : t < 0.7 ? 0 : c === 4 ? 40 : 0));
    const document = documentWith(step);
    const after = takeOf(smoothSamples.run(document, { ...c1, filter: 'median', frames: 7 }));
    expect(rows(after)).toEqual(rows(step));
  });

  it('gives values and rotations of a neighbouring frame', () => {
    fc.assert(
      fc.property(anyTake, fc.constantFrom(3, 5, 7), (take, frames) => {
        const after = median(take, frames);
        const reach = (frames - 1) / 2;
        for (let f = 0; f < 40; f++) {
          const near = Array.from({ length: 2 * reach + 1 }, (_, n) => f - reach + n).filter((g) => g >= 0 && g < 40);
          for (let c = 0; c < 3; c++) expect(near.map((g) => row(take, g)[c])).toContain(row(after, f)[c]);
          // The root's rotation, of the first joint's matrix.
          const own = worldOf(after, f).slice(0, 11);
          expect(Math.min(...near.map((g) => apart(worldOf(take, g).slice(0, 11), own)))).toBeLessThan(1e-12);
        }
      }),
      { numRuns: 20 },
    );
  });

  it('the median of a few frames is the middle one in order of size', () => {
    fc.assert(
      fc.property(fc.array(fc.integer({ min: -5, max: 5 }), { minLength: 7, maxLength: 7 }), (list) => {
        const values = Float64Array.from(list);
        expect(values[medianFrame(values, 3, 3)]).toBe([...list].sort((a, b) => a - b)[3]);
      }),
    );
  });

  it('the median of a few frames keeps to its range, and is one step of undo', () => {
    const spiky = takeOfColumns((c, t) => swingAt(c, t) + ([20, 60].includes(Math.round(60 * t)) ? 50 : 0));
    const store = new Store();
    store.apply({ id: 'x', label: () => 'x', run: () => documentWith(spiky) }, {});
    store.apply(smoothSamples, { ...c1, filter: 'median', frames: 3, range: [0.5, 1.5] });
    const after = takeOf(store.document);
    expect(row(after, 20)).toEqual(row(spiky, 20));
    expect(apart(row(after, 60), row(swing, 60))).toBeLessThan(3);
    store.undo();
    expect(takeOf(store.document)).toBe(spiky);
  });
});

describe('the Euler filter, of samples', () => {
  const channels = Array.from({ length: WIDTH }, (_, c) => c);

  it('the Euler filter, of samples keeps every rotation, and leaves no angle that jumps if another form does not', () => {
    fc.assert(
      fc.property(anyTake, (take) => {
        const after = takeOf(eulerFilter.run(documentWith(take), { ...c1, channels }).document);
        for (let f = 0; f < 40; f++) {
          expect(apart(worldOf(after, f), worldOf(take, f))).toBeLessThan(1e-12 * 400);
          if (f === 0) continue;
          for (const first of [3, 6, 9]) {
            const [now, before] = [row(after, f).slice(first, first + 3), row(after, f - 1).slice(first, first + 3)];
            const far = Math.hypot(...now.map((v, i) => v - before[i]));
            const own = row(take, f).slice(first, first + 3);
            // zxy: the middle one is mirrored, the others go on by half a turn; and whole turns of each.
            const other = [own[0] + 180, 180 - own[1], own[2] + 180];
            for (const form of [own, other]) {
              const turned = form.map((v, i) => v + 360 * Math.round((before[i] - v) / 360));
              expect(far).toBeLessThanOrEqual(Math.hypot(...turned.map((v, i) => v - before[i])) + 1e-3);
            }
          }
        }
      }),
      { numRuns: 20 },
    );
  });

  it('unrolls a continuing turn, changes nothing if nothing jumps, and is undone', () => {
    const turning = takeOfColumns((c, t) => (c === 3 ? ((90 * t + 170 + 180) % 360) - 180 : 0));
    const store = new Store();
    store.apply({ id: 'x', label: () => 'x', run: () => documentWith(turning) }, {});
    store.apply(eulerFilter, { ...c1, channels: [3, 4, 5] });
    const after = takeOf(store.document);
    for (let f = 0; f < 121; f++) expect(row(after, f)[3]).toBeCloseTo(170 + 1.5 * f, 10);
    expect(after.channels[3]).toBe(turning.channels[3]);
    const again = runToEnd(eulerFilterSteps(store.document, { ...c1, channels: [3, 4, 5] }));
    expect(again).toMatchObject({ changed: [], notes: [] });
    expect(again.edit.document).toBe(store.document);
    store.undo();
    expect(takeOf(store.document)).toBe(turning);
  });

  it('takes whole turns alone where not all angles of a joint are given, and says so', () => {
    const document = documentWith(takeOfColumns((c, t) => (c === 3 ? (t < 1 ? 179 : -179) : 0)));
    const { edit, notes } = runToEnd(eulerFilterSteps(document, { ...c1, channels: [3] }));
    expect(row(takeOf(edit.document), 100)[3]).toBeCloseTo(181, 10);
    expect(notes).toEqual([expect.stringContaining('only full turns were removed')]);
    expect(RADIANS_PER_DEGREE).toBeCloseTo(Math.PI / 180, 15);
  });
});
