import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { metresPerUnit } from '../../../src/evaluate/space/metres.ts';
import { applySpace, liftOntoGround } from '../../../src/evaluate/space/space.ts';
import { guessSpace, metresForPerson } from '../../../src/evaluate/space/space-guess.ts';
import type { Joint } from '../../../src/model/skeleton/skeleton.ts';
import type { LengthUnit } from '../../../src/model/space.ts';
import { type PersonOptions, personSkeleton, takeOfRoots } from '../../helpers/mocap.ts';

/** Standing with its soles `over` the ground of its file. */
function standing(options: PersonOptions, over = 0) {
  const skeleton = personSkeleton(options);
  const { height = 170, up = 'y' } = options;
  const hips = 0.5 * height + over;
  const take = takeOfRoots(skeleton, up === 'y' ? [[0, hips, 0]] : [[0, 0, hips]]);
  return { skeleton, take };
}

describe('the unit of a character that does not say', () => {
  it.each([
    [1.75, 'metres'],
    [1.4, 'metres'],
    [175, 'centimetres'],
    [140, 'centimetres'],
    [210, 'centimetres'],
    [1750, 'millimetres'],
    [67, 'inches'],
    [53, 'inches'],
    [29, 'cmu'],
    [16.6, 'decimetres'],
  ] satisfies [number, LengthUnit][])('%d high is in %s', (height, unit) => {
    const { skeleton, take } = standing({ height });
    expect(guessSpace(skeleton, take).unit).toBe(unit);
  });

  it('the unit of a character that does not say is a person’s height where no unit comes near one', () => {
    const { skeleton, take } = standing({ height: 5 });
    const space = guessSpace(skeleton, take);
    expect(space.unit).toBe('own');
    expect(5 * metresPerUnit(space)).toBeCloseTo(1.7, 2);
    expect(metresForPerson(skeleton, take, 'y')).toBe(space.metres);
  });

  it.each([43, 44])('%d high is no unit’s: a person of 1.1 m in inches is unlikely', (height) => {
    const { skeleton, take } = standing({ height });
    const space = guessSpace(skeleton, take);
    expect(space.unit).toBe('own');
    expect(height * metresPerUnit(space)).toBeCloseTo(1.7, 2);
  });

  it('the unit of a character that is no person is a common one, if that leaves it at any size of animals', () => {
    for (const [height, unit] of [
      [40, 'centimetres'],
      [0.5, 'metres'],
      [400, 'centimetres'],
      [900, 'millimetres'],
      [16, 'decimetres'],
    ] as const) {
      const { skeleton, take } = animal(height, 'y');
      expect(guessSpace(skeleton, take).unit, String(height)).toBe(unit);
    }
  });

  it('leaves every character between half a person’s height and twice of it', () => {
    fc.assert(
      fc.property(fc.double({ min: 0.01, max: 1e5, noNaN: true }), (height) => {
        const { skeleton, take } = standing({ height });
        const metres = height * metresPerUnit(guessSpace(skeleton, take));
        expect(metres).toBeGreaterThan(0.8);
        expect(metres).toBeLessThan(3.5);
      }),
    );
  });

  it('the unit of a character is that of its standing height, though it sits most of the time', () => {
    const skeleton = personSkeleton({ height: 170 });
    // Folded: the head's channels are rotations, so the hips and head come down together.
    const take = takeOfRoots(
      skeleton,
      Array.from({ length: 20 }, () => [0, 85, 0] as const),
    );
    expect(guessSpace(skeleton, take).unit).toBe('centimetres');
  });
});

describe('the up axis of a character that does not say', () => {
  it.each(['y', 'z'] as const)('%s leads from the feet to the head, by their names', (up) => {
    const { skeleton, take } = standing({ up });
    expect(guessSpace(skeleton, take).up).toBe(up);
  });

  it.each(['y', 'z'] as const)('%s is along what is tall, where names say nothing', (up) => {
    const { skeleton, take } = standing({ up, named: false });
    expect(guessSpace(skeleton, take).up).toBe(up);
  });

  it.each(['y', 'z'] as const)('%s is seen in a rest pose alone', (up) => {
    expect(guessSpace(personSkeleton({ up }), undefined).up).toBe(up);
  });
});

/** A chicken that pecks: the head before and below its back, a tail behind, two feet with toes. */
function animal(height: number, up: 'y' | 'z', isNamed = true, sunk = 0) {
  const at = (x: number, y: number, z: number): readonly [number, number, number] =>
    up === 'y' ? [x * height, y * height, z * height] : [x * height, -z * height, y * height];
  const { joints } = personSkeleton({ height, up });
  const [root, , leg] = joints;
  const part = (name: string, parent: number, offset: readonly [number, number, number]): Joint => ({
    ...leg,
    name: isNamed ? name : `b${name.length}`,
    parent,
    offset,
    endSites: [],
  });
  const skeleton = {
    name: 'chicken',
    joints: [
      { ...root, name: isNamed ? 'pelvis' : 'r' },
      part('neck', 0, at(0, 0.2, 0.5)),
      part('head', 1, at(0, -0.4, 0.6)),
      part('tail1', 0, at(0, 0.1, -0.3)),
      part('tail2', 3, at(0, 0.2, -0.5)),
      part('L_toe', 0, at(0.1, -0.6, 0.1)),
      part('R_toe', 0, at(-0.1, -0.6, 0.1)),
    ],
  };
  return { skeleton, take: takeOfRoots(skeleton, [at(0, 0.6 - sunk, 0), at(0, 0.6 - sunk, 0.3)]) };
}

describe('the up axis of an animal', () => {
  it.each(['y', 'z'] as const)('%s is where all is above its feet, wherever the head is', (up) => {
    for (const sunk of [0, 0.6]) {
      const { skeleton, take } = animal(40, up, true, sunk);
      expect(guessSpace(skeleton, take).up).toBe(up);
      expect(guessSpace(skeleton, undefined).up).toBe(up);
    }
  });
});

describe('the ground under a character', () => {
  it.each([
    ['y', 90],
    ['z', -40],
  ] as const)('the ground under a character is where its soles are: %s up, %d above the file’s', (up, over) => {
    const { skeleton, take } = standing({ up }, over);
    expect(guessSpace(skeleton, take).lift).toBeCloseTo(-over / 100, 3);
  });

  it('the ground under a character is believed where the file’s is as good', () => {
    const { skeleton, take } = standing({}, 0.5);
    expect(guessSpace(skeleton, take).lift).toBe(0);
    expect(liftOntoGround(skeleton, take, { up: 'y', unit: 'centimetres', lift: 0 })).toBeCloseTo(-0.005, 6);
  });

  it('the ground under a character is not where a jump takes it, nor one toe that sank in', () => {
    const skeleton = personSkeleton();
    const rows = Array.from({ length: 30 }, (_, i) => [0, i < 12 ? 185 : i === 20 ? 60 : 105, 0] as const);
    expect(guessSpace(skeleton, takeOfRoots(skeleton, rows)).lift).toBeCloseTo(-0.2, 3);
  });

  it('the ground under a character is below an empty skeleton nowhere, and nothing breaks', () => {
    expect(guessSpace({ name: 'none', joints: [] }, undefined)).toMatchObject({ up: 'y', unit: 'asIs', lift: 0 });
  });
});

describe('a space', () => {
  it('a space turns z up into y up, and leaves left and right as they are', () => {
    const out = new Float64Array(3);
    applySpace({ up: 'z', unit: 'centimetres', lift: 0.5 }, 100, 200, 300, out);
    expect([...out]).toEqual([1, 3.5, -2]);
  });

  it('a space is no change where there is none', () => {
    const out = new Float64Array(3);
    applySpace(undefined, 1, 2, 3, out);
    expect([...out]).toEqual([1, 2, 3]);
  });
});
