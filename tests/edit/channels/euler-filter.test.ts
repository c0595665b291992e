import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { filterRotations, keyedTogether, keysChanged, unrollAngle } from '../../../src/edit/channels/euler-filter.ts';
import { jointMotion } from '../../../src/evaluate/motions.ts';
import { EULER_ORDERS, type EulerOrder } from '../../../src/model/skeleton/skeleton.ts';
import type { KeyedChannel } from '../../../src/model/takes/take.ts';
import { expectClose } from '../../helpers/close.ts';
import { channelOf, pointsOf, slopesAt } from '../keys/channels.ts';

function matrix(order: EulerOrder, channels: readonly KeyedChannel[], key: number): Float64Array {
  const out = new Float64Array(16);
  const angles = Float64Array.from(channels, (c) => c.values[key]);
  jointMotion({ kind: 'ball', order }).write(angles, 0, out, 0);
  return out;
}

const angle = fc.double({ min: -12, max: 12, noNaN: true });
const triples = fc.array(fc.tuple(angle, angle, angle), { minLength: 1, maxLength: 12 });
const ofTriples = (list: readonly (readonly number[])[]): [KeyedChannel, KeyedChannel, KeyedChannel] => {
  const one = (a: number) => channelOf(list.map((triple, k) => [k, triple[a], 0.5]));
  return [one(0), one(1), one(2)];
};
const travel = (channels: readonly KeyedChannel[], k: number) =>
  channels.reduce((sum, c) => sum + (c.values[k] - c.values[k - 1]) ** 2, 0);

describe('the Euler filter', () => {
  it.each(EULER_ORDERS)('leaves the rotation at every key what it is, in the order %s', (order) => {
    fc.assert(
      fc.property(triples, (list) => {
        const before = ofTriples(list);
        const after = filterRotations(before, order);
        for (let k = 0; k < list.length; k++) {
          expectClose(matrix(order, after, k), matrix(order, before, k), 1e-9, `key ${k}`);
        }
      }),
    );
  });

  it.each(EULER_ORDERS)('restores a smooth motion from turns and flips, in the order %s', (order) => {
    const middle = 'xyz'.indexOf(order[1]);
    const smooth = Array.from({ length: 20 }, (_, k) => [0, 1, 2].map((a) => Math.sin(0.1 * k + a) + 0.05 * k * a));
    const disguise = fc.tuple(fc.boolean(), ...[0, 1, 2].map(() => fc.integer({ min: -2, max: 2 })));
    fc.assert(
      fc.property(fc.array(disguise, { minLength: 20, maxLength: 20 }), (list) => {
        const disguised = smooth.map((triple, k) => {
          const [flips, ...turns] = k === 0 ? [false, 0, 0, 0] : list[k];
          return triple.map(
            (v, a) => (flips ? (a === middle ? Math.PI - v : v + Math.PI) : v) + 2 * Math.PI * turns[a],
          );
        });
        const after = filterRotations(ofTriples(disguised), order);
        for (let a = 0; a < 3; a++)
          expectClose(
            after[a].values,
            smooth.map((t) => t[a]),
            1e-9,
          );
      }),
    );
  });

  it('the Euler filter never makes the way from key to key longer by a turn or a flip than it need be', () => {
    fc.assert(
      fc.property(triples, (list) => {
        const after = filterRotations(ofTriples(list), 'xyz');
        for (let k = 1; k < list.length; k++) {
          // Not more than half a turn by any angle, and the flipped triple isn't nearer.
          const flipped = ofTriples(
            after[0].values.length
              ? [
                  [0, 1, 2].map((a) => after[a].values[k - 1]),
                  [0, 1, 2].map((a) => {
                    const v = after[a].values[k];
                    const other = a === 1 ? Math.PI - v : v + Math.PI;
                    return other + 2 * Math.PI * Math.round((after[a].values[k - 1] - other) / (2 * Math.PI));
                  }),
                ]
              : [],
          );
          expect(travel(after, k)).toBeLessThanOrEqual(travel(flipped, 1) + 1e-6);
          for (const c of after) expect(Math.abs(c.values[k] - c.values[k - 1])).toBeLessThanOrEqual(Math.PI + 1e-9);
        }
      }),
    );
  });

  it('negates slopes of the middle angle where it is mirrored', () => {
    const [x, y, z] = filterRotations(
      ofTriples([
        [0, 1.5, 0],
        [Math.PI, 1.5, -Math.PI],
      ]),
      'xyz',
    );
    expectClose([x.values[1], y.values[1], z.values[1]], [0, Math.PI - 1.5, 0], 1e-12);
    expect([x, y, z].map((c) => slopesAt(c, 1))).toEqual([
      [0.5, 0.5],
      [-0.5, -0.5],
      [0.5, 0.5],
    ]);
    expect(slopesAt(y, 0)).toEqual([0.5, 0.5]);
  });

  it('returns the same channels if nothing jumps', () => {
    const before = ofTriples([
      [0, 0, 0],
      [1, 0.5, -1],
    ]);
    const after = filterRotations(before, 'xyz');
    expect(after.map((c, i) => c === before[i])).toEqual([true, true, true]);
    expect(keysChanged(before, after)).toBe(0);
  });

  it('the Euler filter stays within limits, and leaves a key that lies outside', () => {
    const before = ofTriples([
      [3, 0, 0],
      [-3, 0, 0],
      [5, 0, 0],
    ]);
    const limits = [
      { min: -3.2, max: 3.2 },
      { min: -1, max: 1 },
      { min: 1, max: -1 },
    ];
    expect([...filterRotations(before, 'xyz', limits)[0].values]).toEqual([3, -3, 5]);
    expectClose(filterRotations(before, 'xyz')[0].values, [3, 2 * Math.PI - 3, 5], 1e-12);
  });

  it('unrolls one angle by whole turns', () => {
    const channel = channelOf([
      [0, 3],
      [1, -3],
      [2, 3],
      [3, 3 - 4 * Math.PI],
    ]);
    expectClose(unrollAngle(channel).values, [3, 2 * Math.PI - 3, 3, 3], 1e-12);
    const calm = channelOf([
      [0, 3],
      [1, 1],
    ]);
    expect(unrollAngle(calm)).toBe(calm);
    expect(pointsOf(unrollAngle(channel, { min: -3.2, max: 3.2 }))[1]).toEqual([1, -3]);
  });

  it('filters three angles together only if they are keyed at the same times', () => {
    const [x, y, z] = ofTriples([[0, 0, 0]]);
    expect(keyedTogether([x, y, z])).toBe(true);
    expect(keyedTogether([x, y, channelOf([[0.5, 0]])])).toBe(false);
  });
});
