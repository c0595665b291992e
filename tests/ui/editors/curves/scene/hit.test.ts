/** A click means what is visible there. */
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { evaluateChannel } from '../../../../../src/evaluate/curves.ts';
import { keysOf } from '../../../../../src/model/takes/take.ts';
import {
  HANDLE_PIXELS,
  handleOf,
  handlesOf,
  slopeFromHandle,
} from '../../../../../src/ui/editors/curves/scene/handles.ts';
import { hitTest, keysInBox } from '../../../../../src/ui/editors/curves/scene/hit.ts';
import { yOf } from '../../../../../src/ui/editors/curves/scene/space.ts';
import { timeX } from '../../../../../src/ui/widgets/time/time-window.ts';
import { keyed, line, SPACE, scene } from '../scenes.ts';

const ramp = keyed([
  [1, 0],
  [2, 0.5],
  [3, 0],
]);
const x = (time: number) => timeX(SPACE, time);
const y = (value: number) => yOf(SPACE, line(0), value);

describe('hit-testing', () => {
  it('finds the key within reach, and nothing outside it', () => {
    const given = scene([ramp]);
    expect(hitTest(given, x(2) + 3, y(0.5) - 3)).toEqual({ kind: 'key', channel: 0, index: 1 });
    expect(hitTest(given, x(2), y(0.5) - 8)).toEqual({ kind: 'empty' });
  });

  it('finds the nearest of several keys, and of equals the one in front', () => {
    const given = scene([
      keyed([[1, 0]]),
      keyed([
        [1, 0],
        [1.03, 0],
      ]),
    ]);
    expect(hitTest(given, x(1), y(0))).toMatchObject({ channel: 1, index: 0 });
    expect(hitTest(given, x(1.03), y(0))).toMatchObject({ channel: 1, index: 1 });
  });

  it('prefers a selected key to another that covers it', () => {
    const given = scene([keyed([[1, 0]]), keyed([[1, 0]])], { selected: [{ channel: 0, indices: [0] }] });
    expect(hitTest(given, x(1), y(0))).toMatchObject({ kind: 'key', channel: 0 });
  });

  it('takes what is in front before the keys of a faint line, and boxes select no key of one', () => {
    const lines = [ramp, keyed([[2, 0.5]])];
    const given = scene(lines, { emphasised: new Set([1]) });
    expect(hitTest(given, x(2), y(0.5))).toMatchObject({ kind: 'key', channel: 1 });
    // The curve in front, though the key behind it is nearer.
    expect(hitTest(scene(lines, { emphasised: new Set([0]) }), x(1.97), y(0.5))).toMatchObject({ channel: 0 });
    expect(hitTest(given, x(1), y(0))).toEqual({ kind: 'key', channel: 0, index: 0 });
    const everything = { x0: 0, y0: 0, x1: SPACE.width, y1: SPACE.height };
    expect(keysInBox(given, everything).map((keys) => keys.channel)).toEqual([1]);
    const selected = [{ channel: 0, indices: [0] }];
    expect(keysInBox({ ...given, selected }, everything).map((keys) => keys.channel)).toEqual([0, 1]);
  });

  it('finds a point of the curve between keys and beyond them, and its value there', () => {
    const given = scene([ramp]);
    for (const time of [1.4, 2.7, 0.3, 3.8]) {
      const value = evaluateChannel(given.curves, 0, time);
      const hit = hitTest(given, x(time), y(value) + 3);
      if (hit.kind !== 'curve') throw new Error(`${hit.kind} at ${time}`);
      expect(hit.value).toBe(evaluateChannel(given.curves, 0, hit.timeSeconds));
      expect(Math.hypot(x(hit.timeSeconds) - x(time), y(hit.value) - y(value) - 3)).toBeLessThan(3.1);
    }
  });

  it('finds a curve that is vertical, and one with hundreds of keys per pixel', () => {
    const step = scene([
      keyed([
        [0, 0],
        [2, 0],
        [2, 0.8],
        [4, 0.8],
      ]),
    ]);
    expect(hitTest(step, x(2) + 2, y(0.4))).toMatchObject({ kind: 'curve', channel: 0 });
    const noise = scene([keyed(Array.from({ length: 80_001 }, (_, i) => [i / 20_000, i % 2 ? 0.9 : -0.9]))]);
    expect(hitTest(noise, x(1.5), y(0.3), 1)).toMatchObject({ kind: 'curve' });
  });

  it('returns take times if the character has an offset', () => {
    const given = scene([ramp], { offsetSeconds: 0.5 });
    expect(hitTest(given, x(1.5), y(0.5))).toMatchObject({ kind: 'key', index: 1 });
    const hit = hitTest(given, x(3), y(0));
    expect(hit.kind === 'curve' && hit.timeSeconds).toBeCloseTo(3.5, 2);
  });

  it('boxes the keys inside, whichever corner it was started from', () => {
    const given = scene([
      ramp,
      keyed([
        [2, 0.5],
        [2.5, -0.9],
      ]),
    ]);
    const box = { x0: x(2.2), y0: y(0.6), x1: x(0.9), y1: y(-0.1) };
    const found = [
      { channel: 0, indices: [0, 1] },
      { channel: 1, indices: [0] },
    ];
    expect(keysInBox(given, box)).toEqual(found);
    expect(
      keysInBox({ ...given, lines: given.lines.toReversed() }, { x0: box.x1, y0: box.y1, x1: box.x0, y1: box.y0 }),
    ).toEqual(found);
  });
});

describe('handles', () => {
  it('handles have a constant length on screen, and give their slope back', () => {
    const slopes = fc.double({ min: -50, max: 50, noNaN: true });
    fc.assert(
      fc.property(slopes, fc.constantFrom('in' as const, 'out' as const), (slope, side) => {
        const given = scene([
          keyed(
            [
              [1, 0],
              [2, 0.5],
              [3, 0],
            ],
            slope,
          ),
        ]);
        const { endX, endY } = handleOf(given, line(0), 1, side);
        expect(Math.hypot(endX - x(2), endY - y(0.5))).toBeCloseTo(HANDLE_PIXELS, 6);
        expect(Math.sign(endX - x(2))).toBe(side === 'in' ? -1 : 1);
        if (Math.abs(endX - x(2)) < 1) return;
        expect(slopeFromHandle(given, line(0), 1, side, endX, endY)).toBeCloseTo(slope, 6);
      }),
    );
  });

  it('handles stay on their side of the key when dragged past it', () => {
    const given = scene([ramp]);
    expect(slopeFromHandle(given, line(0), 1, 'out', x(2) - 50, y(0.5) - 20)).toBeGreaterThan(0);
    expect(Number.isFinite(slopeFromHandle(given, line(0), 1, 'in', x(2) + 50, y(0.5) - 20))).toBe(true);
    expect(slopeFromHandle(given, line(0), 1, 'in', x(2) + 50, y(0.5) - 20)).toBeLessThan(0);
  });

  it('handles exist for selected keys only, not inside a step, and are hit before nearby keys', () => {
    const channel = keyed([
      [1, 0],
      [2, 0],
      [2, 0.5],
      [3, 0.5],
    ]);
    const given = scene([channel], { selected: [{ channel: 0, indices: [1, 2] }] });
    expect(handlesOf(given).map((h) => [h.index, h.side])).toEqual([
      [1, 'in'],
      [2, 'out'],
    ]);
    expect(hitTest(given, x(2) + HANDLE_PIXELS, y(0.5))).toEqual({ kind: 'handle', channel: 0, index: 2, side: 'out' });
    expect(handlesOf(scene([channel]))).toEqual([]);
  });

  it('handles are not drawn for hundreds of keys at once', () => {
    const many = keyed(Array.from({ length: 1000 }, (_, i) => [i / 250, 0]));
    expect(handlesOf(scene([many], { selected: [{ channel: 0, indices: [...keysOf(many).times.keys()] }] }))).toEqual(
      [],
    );
  });
});
