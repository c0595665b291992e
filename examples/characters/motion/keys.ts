/** Channels keyed by hand, for the lessons. */
import type { Channel, Extrapolation, Tangents } from '../../../src/model/takes/take.ts';
import { FIXED_TANGENT, TANGENT_KINDS, type TangentKind } from '../../../src/model/takes/tangent-kinds.ts';

/** A kind of tangent, or the slope itself in value per second. */
export type SampleTangent = Exclude<TangentKind, 'fixed'> | number;
/** Time in seconds, value, tangent in, tangent out. */
export type KeyRow = readonly [time: number, value: number, tangentIn: SampleTangent, tangentOut: SampleTangent];

/** Channel with the same extrapolation on both sides. */
export function keyed(extrapolation: Extrapolation, rows: readonly KeyRow[]): Channel {
  const column = (side: 2 | 3): Tangents => {
    const kindOf = (t: SampleTangent) => (typeof t === 'number' ? FIXED_TANGENT : TANGENT_KINDS.indexOf(t));
    return {
      kinds: Uint8Array.from(rows, (row) => kindOf(row[side])),
      slopes: Float64Array.from(rows, (row) => (typeof row[side] === 'number' ? row[side] : 0)),
    };
  };
  return {
    kind: 'keys',
    extrapolateIn: extrapolation,
    extrapolateOut: extrapolation,
    times: Float64Array.from(rows, (row) => row[0]),
    values: Float64Array.from(rows, (row) => row[1]),
    tangentsIn: column(2),
    tangentsOut: column(3),
  };
}

/** A constant. */
export const held = (value: number): Channel => keyed('constant', [[0, value, 'flat', 'flat']]);
