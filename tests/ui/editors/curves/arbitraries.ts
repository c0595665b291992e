/** Channels of every kind, and views of them, for properties about what is drawn. */
import fc from 'fast-check';
import type { TraceMap } from '../../../../src/evaluate/plot/trace-path.ts';
import { type Channel, EXTRAPOLATIONS, restChannel } from '../../../../src/model/takes/take.ts';

/** Times as clocks and files have them: nothing between 0 and the smallest double matters. */
const toMicroseconds = (seconds: number) => Math.round(seconds * 1e6) / 1e6;

export const PLOT = { width: 300, top: 22, bottom: 222 };

/** Gaps between keys; 0 is a step. */
const gap = fc.oneof(
  { weight: 6, arbitrary: fc.double({ min: 0.02, max: 1, noNaN: true }) },
  { weight: 1, arbitrary: fc.constant(0) },
  { weight: 1, arbitrary: fc.double({ min: 1e-4, max: 1e-3, noNaN: true }) },
);
const extrapolation = fc.constantFrom(...EXTRAPOLATIONS);
const side = fc.record({ kind: fc.integer({ min: 0, max: 3 }), slope: fc.double({ min: -30, max: 30, noNaN: true }) });
const key = fc.record({ gap, value: fc.double({ min: -2, max: 2, noNaN: true }), in: side, out: side });

/** @param keys at most; at least `least` */
export function anyChannel(keys: number, least = 0): fc.Arbitrary<Channel> {
  return fc
    .record({
      start: fc.double({ min: -5, max: 5, noNaN: true }).map(toMicroseconds),
      list: fc.array(key, { minLength: least, maxLength: keys, size: 'max' }),
      extrapolateIn: extrapolation,
      extrapolateOut: extrapolation,
      rest: fc.constantFrom(undefined, 0.5),
    })
    .map(({ start, list, extrapolateIn, extrapolateOut, rest }): Channel => {
      let time = start;
      const column = (tangents: readonly { kind: number; slope: number }[]) => ({
        kinds: Uint8Array.from(tangents, (t) => t.kind),
        slopes: Float64Array.from(tangents, (t) => (t.kind === 3 ? t.slope : 0)),
      });
      if (list.length === 0) return { ...restChannel(rest), extrapolateIn, extrapolateOut };
      return {
        kind: 'keys',
        extrapolateIn,
        extrapolateOut,
        times: Float64Array.from(list, (k, i) => {
          if (i > 0) time += k.gap;
          return time;
        }),
        values: Float64Array.from(list, (k) => k.value),
        tangentsIn: column(list.map((k) => k.in)),
        tangentsOut: column(list.map((k) => k.out)),
      };
    });
}

/** A view of that many seconds, starting near the keys of `anyChannel`. */
export function anyMap(leastSeconds: number, mostSeconds: number): fc.Arbitrary<TraceMap> {
  return fc
    .record({
      left: fc.double({ min: -12, max: 12, noNaN: true }).map(toMicroseconds),
      seconds: fc.double({ min: Math.log(leastSeconds), max: Math.log(mostSeconds), noNaN: true }),
      low: fc.double({ min: -5, max: 2, noNaN: true }),
      extent: fc.double({ min: Math.log(0.01), max: Math.log(20), noNaN: true }),
    })
    .map(({ left, seconds, low, extent }) => ({
      ...PLOT,
      left,
      low,
      perSecond: PLOT.width / Math.exp(seconds),
      perUnit: (PLOT.bottom - PLOT.top) / Math.exp(extent),
    }));
}
