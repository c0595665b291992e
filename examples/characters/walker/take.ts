/** The walker's take: the gait as channels, then the face's and the chest's. */
import { smoothstep } from '../../../src/math/smoothstep.ts';
import type { Channel, Take } from '../../../src/model/takes/take.ts';
import { fitChannel } from '../motion/fit.ts';
import { pathSeconds } from '../motion/path.ts';
import { gaitChannels } from '../motion/walk.ts';
import { round } from '../shape/vectors.ts';
import { TOE_LEAVES, WALK_PATH, walkPose } from './gait.ts';
import { WALKER_SKELETON } from './skeleton.ts';

const ROUND = pathSeconds(WALK_PATH);
/** Fiftieths of a second: the gait's corners, at tenths of a stride, are on keys. */
const FRAME = 0.02;
const CARRIES = /^(hips|thigh|shin|foot|toe)/;

export function walkerTake(): Take {
  const walk = gaitChannels({
    skeleton: WALKER_SKELETON,
    path: WALK_PATH,
    poseAt: walkPose,
    frame: FRAME,
    care: (joint) => {
      // Legs are fitted more closely, since they carry the planted feet: 0.002 rad is a thousandth of a unit at a leg's
      // end.
      if (!CARRIES.test(joint)) return { tolerance: 0.01 };
      if (joint === 'hips') return { tolerance: 0.002 };
      const strikes = joint.endsWith('_l') ? 0 : 0.5;
      return { tolerance: 0.002, corners: [strikes, (strikes + TOE_LEAVES) % 1, ...(strikes === 0 ? [1] : [])] };
    },
  });
  return { name: 'walker_walk', range: [0, ROUND], channels: [...walk, blink(), smile(), breathe()] };
}

const weight = (motion: (t: number) => number, period: number): Channel =>
  fitChannel(motion, { from: 0, to: round(period, 4), frame: FRAME, tolerance: 0.03, extrapolation: 'cycle' });

/** Three blinks, two of them close together. */
function blink(): Channel {
  const times = [1.2, 3.9, 4.3];
  const shut = (t: number, at: number) => smoothstep(at - 0.08, at, t) * smoothstep(at + 0.16, at + 0.04, t);
  return weight((t) => times.reduce((sum, at) => sum + shut(t, at), 0), ROUND);
}

/** A content face, with an occasional broad smile. */
function smile(): Channel {
  const broad = (t: number, from: number, to: number) => smoothstep(from, from + 0.4, t) * smoothstep(to, to - 0.5, t);
  return weight((t) => 0.12 + 0.88 * (broad(t, 1.4, 3.4) + broad(t, 4.9, 6.2)), ROUND);
}

function breathe(): Channel {
  return weight((t) => 0.5 - 0.5 * Math.cos((4 * Math.PI * t) / ROUND), ROUND / 2);
}
