/**
 * Tracing of all curves in view by the curve editor, for changing views (nothing is cached), against a bare loop over
 * the same keys: their screen positions, and the range of each column of pixels, without cubics, tangents or
 * extrapolation. A frame has 16 ms, of which tracing may take a few.
 */
import { bench, describe } from 'vitest';
import { compileTake } from '../../src/evaluate/compiled-take.ts';
import type { TraceMap } from '../../src/evaluate/plot/trace-path.ts';
import { type Channel, keysOf, type Take } from '../../src/model/takes/take.ts';
import { SMOOTH } from '../../src/model/takes/tangent-kinds.ts';
import { LineTrace, traceLine } from '../../src/ui/editors/curves/scene/trace.ts';

const SECONDS = 10;
const WIDTH = 1100;
const HEIGHT = 300;

function wiggling(keys: number, seed: number): Channel {
  const tangents = { kinds: new Uint8Array(keys).fill(SMOOTH), slopes: new Float64Array(keys) };
  return {
    kind: 'keys',
    extrapolateIn: 'cycle',
    extrapolateOut: 'cycle',
    times: Float64Array.from({ length: keys }, (_, i) => (SECONDS * i) / (keys - 1)),
    values: Float64Array.from(
      { length: keys },
      (_, i) => Math.sin((12 * i) / keys + seed) + 0.1 * Math.sin(0.7 * i + seed),
    ),
    tangentsIn: tangents,
    tangentsOut: tangents,
  };
}

for (const [channels, keys] of [
  [100, 1000],
  [1, 100_000],
]) {
  describe(`${channels} × ${keys} keys, all in view`, () => {
    const take: Take = {
      name: 'wiggling',
      range: [0, SECONDS],
      channels: Array.from({ length: channels }, (_, c) => wiggling(keys, c)),
    };
    const curves = compileTake(take);
    const traces = take.channels.map(() => new LineTrace());
    let frame = 0;
    const mapOfFrame = (): TraceMap => ({
      left: -0.2 + 0.01 * Math.sin(frame++),
      low: -1.5,
      perSecond: WIDTH / (SECONDS + 0.4),
      perUnit: HEIGHT / 3,
      width: WIDTH,
      top: 22,
      bottom: HEIGHT,
    });

    bench('ours', () => {
      const map = mapOfFrame();
      take.channels.forEach((channel, c) => {
        traceLine(curves, c, channel, map, 1, traces[c]);
      });
    });

    const low = new Float32Array(WIDTH);
    const high = new Float32Array(WIDTH);
    bench('bare loop', () => {
      const { left, perSecond, bottom, perUnit, low: floor } = mapOfFrame();
      for (const { times, values } of take.channels.map(keysOf)) {
        low.fill(Number.POSITIVE_INFINITY);
        high.fill(Number.NEGATIVE_INFINITY);
        for (let k = 0; k < times.length; k++) {
          const column = ((times[k] - left) * perSecond) | 0;
          const y = bottom - (values[k] - floor) * perUnit;
          if (y < low[column]) low[column] = y;
          if (y > high[column]) high[column] = y;
        }
      }
    });
  });
}

describe('1 × 100000 keys, dragged: another channel every time', () => {
  const base = wiggling(100_000, 0);
  const curves = compileTake({ name: 'dragged', range: [0, SECONDS], channels: [base] });
  const trace = new LineTrace();
  const map: TraceMap = { left: -0.2, low: -1.5, perSecond: 105, perUnit: 100, width: WIDTH, top: 22, bottom: HEIGHT };
  bench('ours', () => {
    traceLine(curves, 0, { ...base }, map, 1, trace);
  });
});
