import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { shareOf } from '../../src/evaluate/layers.ts';
import { poseAt } from '../../src/evaluate/pose.ts';
import { frameRateOf } from '../../src/evaluate/samples/frame-rate.ts';
import { framesOfTake } from '../../src/evaluate/samples/key-frames.ts';
import { evaluateMotion, takeMotion } from '../../src/evaluate/take-motion.ts';
import { withActive } from '../../src/model/takes/layers.ts';
import { type Channel, restChannel, type Take } from '../../src/model/takes/take.ts';
import { between, channelOf, channels } from '../edit/keys/channels.ts';
import { layeredTake, layeredTakes, layerOf } from '../edit/layers/layered.ts';
import { character, morph, skeleton } from '../helpers/builders.ts';

const still = (value: number) => channelOf([[0, value, 'flat']]);

function valueIn(take: Take, time = 0): number {
  const out = new Float64Array(take.channels.length);
  evaluateMotion(takeMotion(take, undefined), time, out, out.length);
  return out[0];
}

describe('layers', () => {
  it('are added or take the place of what is beneath, from the lowest up', () => {
    const take = layeredTake(
      [still(10)],
      [
        layerOf([still(4)], { weight: 0.5 }),
        layerOf([still(100)], { name: 'b', mode: 'override', weight: 0.25 }),
        layerOf([still(-1)], { name: 'c', weight: 7 }),
      ],
    );
    expect(valueIn(take)).toBe(0.75 * 12 + 25 - 1);
  });

  it('don’t count while muted, or while an unmuted one is solo', () => {
    const values = (a: object, b: object) =>
      valueIn(layeredTake([still(0)], [layerOf([still(1)], a), layerOf([still(10)], { name: 'b', ...b })]));
    expect(values({ mute: true }, {})).toBe(10);
    expect(values({ solo: true }, {})).toBe(1);
    expect(values({ solo: true }, { solo: true })).toBe(11);
    expect(values({ solo: true, mute: true }, {})).toBe(10);
  });

  it('change nothing, not even the sign of a zero, without weight or keys', () => {
    const base = still(-0);
    for (const layer of [
      layerOf([still(5)], { weight: 0 }),
      layerOf([restChannel()]),
      layerOf([still(5)], { weight: -3 }),
    ]) {
      expect(
        Object.is(valueIn(layeredTake([base], [layer])), valueIn({ name: '', range: [0, 1], channels: [base] })),
      ).toBe(true);
    }
  });

  it('with joints touch these, and root translation and morphs only if they say so', () => {
    const ones: readonly Channel[] = Array.from({ length: 10 }, () => still(1));
    const touched = (more: object) => {
      const take = layeredTake(
        Array.from({ length: 10 }, () => still(0)),
        [layerOf(ones, more)],
      );
      const out = new Float64Array(10);
      poseAt(
        character({
          skeleton: skeleton(2),
          morphs: [morph('smile')],
          takes: [take],
          shownTake: 0,
          clampsToLimits: false,
        }),
        0,
        out,
      );
      return [...out].join('');
    };
    expect(touched({})).toBe('1111111111');
    expect(touched({ joints: ['joint1'] })).toBe('0000001110');
    expect(touched({ joints: ['#0'], root: true })).toBe('1111110000');
    expect(touched({ joints: ['nobody'], morphs: true })).toBe('0000000001');
    expect(touched({ joints: [], root: true, morphs: true })).toBe('1110000001');
  });

  it('are the same whichever of them is active', () => {
    fc.assert(
      fc.property(
        layeredTakes(fc.oneof(between(0, 1), channels(1, { maxLength: 3 }))),
        between(-5, 5),
        fc.nat(),
        (take, time, n) => {
          const active = (n % ((take.layers?.list.length ?? 0) + 1)) - 1;
          const other = withActive(take, active);
          expect(valueIn(other, time)).toBe(valueIn(take, time));
          expect(withActive(other, -1)).toEqual(take);
        },
      ),
    );
  });

  it('leave the frame rate as the base has it, whichever of them is active', () => {
    const frames = channelOf(Array.from({ length: 25 }, (_, f) => [f / 24, f]));
    const uneven = channelOf([
      [0, 0],
      [0.313, 1],
    ]);
    const take = layeredTake([frames], [layerOf([uneven])], [0, 1]);
    for (const active of [-1, 0]) {
      expect(frameRateOf(withActive(take, active))).toBe(24);
      expect(framesOfTake(withActive(take, active), 30).frameCount).toBe(25);
    }
  });

  it('have a share in what is shown, a + b·x, by which a wanted value is set', () => {
    fc.assert(
      fc.property(layeredTakes(), between(-5, 5), between(-10, 10), fc.nat(), (take, time, wanted, n) => {
        const list = take.layers?.list ?? [];
        const layer = (n % (list.length + 1)) - 1;
        const base = [valueIn({ name: '', range: [0, 1], channels: take.channels }, time)];
        const { a, b } = shareOf(take, undefined, layer, time, base)(0);
        if (Math.abs(b) < 0.01) return;
        const x = still((wanted - a) / b);
        const others = list.map((one, i) => (i === layer ? { ...one, motion: { channels: [x] } } : one));
        const set = layeredTake(layer < 0 ? [x] : take.channels, others);
        expect(valueIn(set, time)).toBeCloseTo(wanted, 6);
      }),
    );
  });
});
