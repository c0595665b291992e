/** A scene of given channels on a plot of 400 × 200 pixels that shows seconds 0 … 4, and −1 … 1 of every axis. */
import { compileTake } from '../../../../src/evaluate/compiled-take.ts';
import type { Channel } from '../../../../src/model/takes/take.ts';
import { FIXED_TANGENT } from '../../../../src/model/takes/tangent-kinds.ts';
import type { CurveLine, CurveScene } from '../../../../src/ui/editors/curves/scene/scene.ts';
import type { AxisName, CurveSpace } from '../../../../src/ui/editors/curves/scene/space.ts';
import { take } from '../../builders.ts';

const axis = { low: -1, high: 1 };
export const SPACE: CurveSpace = {
  width: 400,
  height: 200,
  window: { from: 0, to: 4 },
  axes: { angle: axis, length: axis, factor: axis, weight: axis, normalised: axis },
};

/** Keys as `[time, value]`, with the slope given on both sides. */
export function keyed(keys: readonly (readonly [number, number])[], slope = 0): Channel {
  const column = () => ({
    kinds: new Uint8Array(keys.length).fill(FIXED_TANGENT),
    slopes: new Float64Array(keys.length).fill(slope),
  });
  return {
    kind: 'keys',
    extrapolateIn: 'constant',
    extrapolateOut: 'constant',
    times: Float64Array.from(keys, ([time]) => time),
    values: Float64Array.from(keys, ([, value]) => value),
    tangentsIn: column(),
    tangentsOut: column(),
  };
}

export function line(channel: number, name: AxisName = 'angle'): CurveLine {
  const unit = name === 'normalised' ? 'angle' : name;
  return { channel, name: `line ${channel}`, unit, axis: name, colour: { base: 'x', with: 'text', part: 0, dash: [] } };
}

export function scene(channels: readonly Channel[], more: Partial<CurveScene> = {}): CurveScene {
  const made = take([0, 4], ...channels);
  return {
    take: made,
    curves: compileTake(made),
    offsetSeconds: 0,
    lines: channels.map((_, i) => line(i)),
    selected: [],
    space: SPACE,
    range: [0, 4],
    framesPerSecond: 24,
    inFrames: false,
    degrees: true,
    ...more,
  };
}
