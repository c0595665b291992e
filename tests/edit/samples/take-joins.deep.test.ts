import { describe, expect, it } from 'vitest';
import { splitSamples } from '../../../src/edit/commands/samples.ts';
import { setTakeSpeed } from '../../../src/edit/commands/take-edits.ts';
import { cutOutOfTakes, insertIntoTake, joinTakes } from '../../../src/edit/commands/take-joins.ts';
import { readFrame, takeOfFrames } from '../../../src/edit/samples/take-frames.ts';
import { compileSkeleton, worldMatrices } from '../../../src/evaluate/kinematics.ts';
import { type Character, type Document, shownTake } from '../../../src/model/document.ts';
import type { Samples } from '../../../src/model/takes/samples.ts';
import type { Take } from '../../../src/model/takes/take.ts';
import { documentOf } from '../../helpers/builders.ts';
import { ALL_BVH, sharedCaptures } from '../../helpers/bvh-files.ts';
import { expectEqual } from '../../helpers/equal.ts';
import { expectEdit } from '../../helpers/expect-edit.ts';
import { captured, personSkeleton, takeOfRoots } from '../../helpers/mocap.ts';

const WALKER = personSkeleton();
/** 20 frames at 10 FPS that walk along z. */
const walk = (from: readonly [number, number], perFrame: readonly [number, number], name = 'walk'): Take => ({
  ...takeOfRoots(
    WALKER,
    Array.from({ length: 20 }, (_, f) => [from[0] + perFrame[0] * f, 90, from[1] + perFrame[1] * f] as const),
  ),
  name,
});
const ref = (take = 0, characterId = 'c1') => ({ characterId, take });

function shownIn(document: Document, index = 0): Take {
  const take = shownTake(document.characters[index]);
  if (!take) throw new Error('No take is shown.');
  return take;
}

function samplesOf(take: Take): Samples {
  if (!take.samples) throw new Error(`${take.name} has no samples.`);
  return take.samples;
}

/** x y z of all joints, a frame after the other. */
function pointsOf({ skeleton }: Character, take: Take): Float64Array[] {
  if (!skeleton) throw new Error('no skeleton');
  const samples = samplesOf(take);
  const compiled = compileSkeleton(skeleton);
  const dofs = new Float64Array(samples.scales.length);
  const world = new Float64Array(16 * compiled.jointCount);
  return Array.from({ length: samples.frameCount }, (_, f) => {
    readFrame(samples, f, dofs);
    worldMatrices(compiled, dofs, world);
    return Float64Array.from(
      { length: 3 * compiled.jointCount },
      (_, i) => world[16 * Math.floor(i / 3) + 12 + (i % 3)],
    );
  });
}

/** The farthest that any joint moves from each frame to the next. */
function stepsOf(points: readonly Float64Array[]): number[] {
  return points.slice(1).map((now, f) => {
    let most = 0;
    for (let i = 0; i < now.length; i += 3) {
      most = Math.max(most, Math.hypot(...[0, 1, 2].map((k) => now[i + k] - points[f][i + k])));
    }
    return most;
  });
}

/** The same numbers; the range's end is computed from frames. */
function expectSameTake(found: Take, meant: Take): void {
  expect(found.range[1]).toBeCloseTo(meant.range[1], 12);
  expect({ ...found, range: meant.range }).toEqual(meant);
}

describe('joining takes', () => {
  it('a take that was split is itself again when its halves are joined without a cross-fade', () => {
    const whole = walk([3, 0], [1, 12]);
    const halves = splitSamples.run(documentOf(captured(WALKER, whole)), { characterId: 'c1', timeSeconds: 0.8 });
    const after = expectEdit(halves, joinTakes, { takes: [ref(0), ref(1)], overlapSeconds: 0, name: 'again' });
    expectSameTake(shownIn(after), { ...whole, name: 'again' });
  });

  it('the second take goes on from where the first ends, and faces alike', () => {
    // The second walks along x, turned by a right angle, from far away.
    const along = walk([0, 0], [0, 10]);
    const sideways = walk([500, 40], [10, 0], 'sideways');
    const turned: Take = {
      ...sideways,
      samples: { ...samplesOf(sideways), values: samplesOf(sideways).values.map((v, i) => (i % 21 === 5 ? 90 : v)) },
    };
    const hero = captured(WALKER, along);
    const document = documentOf({ ...hero, takes: [along, turned] });
    for (const overlapSeconds of [0, 0.5]) {
      const take = shownIn(expectEdit(document, joinTakes, { takes: [ref(0), ref(1)], overlapSeconds }));
      const { values, frameCount } = samplesOf(take);
      expect(frameCount).toBe(40 - 10 * overlapSeconds);
      for (let f = 0; f < frameCount; f++) {
        expect(values[21 * f]).toBeCloseTo(0, 9);
        expect(values[21 * f + 2]).toBeCloseTo(10 * f, 9);
        expect(Math.sin((values[21 * f + 5] * Math.PI) / 180)).toBeCloseTo(0, 9);
      }
    }
  });

  it('takes of two files are joined at the rate of the first, whatever the order of their joints', () => {
    const swapped = { ...WALKER, joints: [0, 4, 5, 2, 3, 1].map((j) => WALKER.joints[j]) };
    const joints = swapped.joints.map((joint, j) => ({ ...joint, parent: [-1, 0, 1, 0, 3, 0][j] }));
    const other = { ...swapped, joints };
    const slow = takeOfRoots(
      other,
      Array.from({ length: 11 }, (_, f) => [0, 90, 20 * f] as const),
    );
    const atFive = { ...slow, range: [0, 2] as const, samples: { ...samplesOf(slow), frameSeconds: 0.2 } };
    const document = documentOf(captured(WALKER, walk([0, 0], [0, 10])), captured(other, atFive, { id: 'c2' }));
    const take = shownIn(expectEdit(document, joinTakes, { takes: [ref(), ref(0, 'c2')], overlapSeconds: 0.4 }));
    expect(samplesOf(take).frameCount).toBe(20 + 21 - 4);
    expect(samplesOf(take).frameSeconds).toBe(0.1);
    stepsOf(pointsOf(captured(WALKER), take)).forEach((step) => {
      expect(step).toBeCloseTo(10, 6);
    });
  });

  it('other skeletons, a single take and a negative cross-fade are refused with what to do', () => {
    const { joints } = WALKER;
    const document = documentOf(
      captured(WALKER, walk([0, 0], [0, 1])),
      captured(
        { name: 'other', joints: joints.slice(0, 4) },
        takeOfRoots({ name: 'o', joints: joints.slice(0, 4) }, [[0, 9, 0]]),
        { id: 'c2' },
      ),
    );
    expect(() => joinTakes.run(document, { takes: [ref()] })).toThrow('two takes');
    expect(() => joinTakes.run(document, { takes: [ref(), ref(0, 'c2')] })).toThrow('Retarget');
    expect(() => joinTakes.run(document, { takes: [ref(), ref(0, 'c2')], overlapSeconds: -1 })).toThrow('negative');
  });
});

describe('cutting out and inserting', () => {
  const WALK = walk([0, 0], [0, 10]);
  const document = documentOf(captured(WALKER, WALK));

  it('what is after the cut goes on from where the cut begins, at the speed it had', () => {
    const after = expectEdit(document, cutOutOfTakes, { takes: [ref()], from: 0.5, to: 1.2, overlapSeconds: 0 });
    const { values, frameCount } = samplesOf(shownIn(after));
    expect(frameCount).toBe(12);
    for (let f = 0; f < frameCount; f++) expect(values[21 * f + 2]).toBeCloseTo(10 * f, 9);
    const inPlace = { takes: [ref()], from: 0.5, to: 1.2, overlapSeconds: 0, align: 'none' } as const;
    expect(samplesOf(shownIn(cutOutOfTakes.run(document, inPlace))).values[21 * 5 + 2]).toBe(130);
  });

  it('times of the timeline are cut out of each take where its own character plays it', () => {
    const later = captured(WALKER, WALK, { id: 'c2', timeOffsetSeconds: -0.3 });
    const both = documentOf(captured(WALKER, WALK), later);
    const cut = { takes: [ref(), ref(0, 'c2')], from: 0.5, to: 1.2, overlapSeconds: 0, align: 'none' } as const;
    const after = cutOutOfTakes.run(both, { ...cut, areOfTransport: true });
    const ways = [0, 1].map((i) => samplesOf(shownIn(after, i)).values[21 * 5 + 2]);
    // Frames 5 to 12 are gone of one, frames 2 to 9 of the other.
    expect(ways).toEqual([130, 130]);
    expect([0, 1].map((i) => samplesOf(shownIn(after, i)).values[21 * 2 + 2])).toEqual([20, 100]);
    expect(shownIn(cutOutOfTakes.run(both, cut), 1)).toEqual(shownIn(cutOutOfTakes.run(both, cut), 0));
  });

  it('a pose that is held stays for that long, and cutting the hold out gives the take back', () => {
    const held = expectEdit(document, insertIntoTake, { into: ref(), atSeconds: 0.7, holdSeconds: 0.5 });
    const { values, frameCount } = samplesOf(shownIn(held));
    expect(frameCount).toBe(25);
    expect([7, 8, 12, 13].map((f) => values[21 * f + 2])).toEqual([70, 70, 70, 80]);
    const cut = { takes: [ref()], from: 0.8, to: 1.2, overlapSeconds: 0 };
    expectSameTake(shownIn(cutOutOfTakes.run(held, cut)), WALK);
  });

  it('a take is inserted at a time, and all of it is one walk', () => {
    const two = documentOf(captured(WALKER, WALK), captured(WALKER, walk([90, 7], [0, 10]), { id: 'c2' }));
    const args = { into: ref(), atSeconds: 0.7, take: ref(0, 'c2'), overlapSeconds: 0.2 };
    const take = shownIn(expectEdit(two, insertIntoTake, args));
    expect(samplesOf(take).frameCount).toBe(40 - 4);
    for (const step of stepsOf(pointsOf(captured(WALKER), take))) expect(step).toBeCloseTo(10, 6);
  });
});

describe('changing the speed', () => {
  it('twice as slow and twice as fast again is the take, which goes the same way in either', () => {
    const whole = walk([3, 0], [1, 12]);
    const slow = expectEdit(documentOf(captured(WALKER, whole)), setTakeSpeed, { takes: [ref()], factor: 0.5 });
    expect(samplesOf(shownIn(slow)).frameCount).toBe(39);
    expect(shownIn(slow).range).toEqual([0, 3.8]);
    expect(samplesOf(shownIn(slow)).values[21 * 38 + 2]).toBe(12 * 19);
    const again = shownIn(setTakeSpeed.run(slow, { takes: [ref()], factor: 2 }));
    expect(again.range[1]).toBeCloseTo(whole.range[1], 12);
    samplesOf(again).values.forEach((v, i) => {
      expect(v).toBeCloseTo(samplesOf(whole).values[i], 9);
    });
  });
});

describe('joining real takes', () => {
  for (const name of ALL_BVH) {
    it(`the halves of ${name} joined are the take, and joined with itself it doesn't jump`, () => {
      for (const { skeleton, take: whole } of sharedCaptures(name)) {
        const samples = whole?.samples;
        if (!whole || !samples || samples.frameCount < 8) continue;
        const count = Math.min(240, samples.frameCount);
        const values = samples.values.slice(0, count * samples.scales.length);
        const take = takeOfFrames(whole, { ...samples, frameCount: count, values });
        const hero = captured(skeleton, take);
        for (const part of [0.2, 0.5, 0.7]) {
          const timeSeconds = samples.startSeconds + Math.round(part * count) * samples.frameSeconds;
          const halves = splitSamples.run(documentOf(hero), { characterId: 'c1', timeSeconds });
          const joined = joinTakes.run(halves, { takes: [ref(0), ref(1)], overlapSeconds: 0, name: take.name });
          expectEqual(samplesOf(shownIn(joined)).values, values, `cut at ${timeSeconds} s`);
        }
        const own = stepsOf(pointsOf(hero, take));
        const overlapSeconds = Math.floor(count / 3) * samples.frameSeconds;
        const twice = { ...hero, takes: [take, { ...take, name: 'again' }] };
        for (const align of ['root', 'foot'] as const) {
          const joined = joinTakes.run(documentOf(twice), { takes: [ref(0), ref(1)], overlapSeconds, align });
          const steps = stepsOf(pointsOf(hero, shownIn(joined)));
          // A blend goes as fast as either take, and on top of that from one to the other.
          expect(Math.max(...steps), align).toBeLessThan(3 * Math.max(...own) + 1e-9);
        }
      }
    });
  }
});
