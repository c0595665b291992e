/**
 * Converts a gait (a pose for each phase of a stride, in path space) to channels: the joints' for one stride, cycled,
 * and the root's, which on a circle take its whole round.
 */
import type { Vec3 } from '../../../src/math/vec3.ts';
import type { Skeleton } from '../../../src/model/skeleton/skeleton.ts';
import type { Channel } from '../../../src/model/takes/take.ts';
import { fitChannel } from './fit.ts';
import { pathSeconds, type WalkPath } from './path.ts';

export interface WalkPose {
  /** The root joint in path space. */
  readonly root: Vec3;
  /** rx ry rz by joint name; 0 if missing. */
  readonly angles: ReadonlyMap<string, Vec3>;
}

export interface Walk {
  readonly skeleton: Skeleton;
  readonly path: WalkPath;
  readonly poseAt: (phase: number) => WalkPose;
  /** Seconds between possible keys; strides and corners are multiples of it. */
  readonly frame: number;
  /** Tolerance in radians of a joint's curve, and phases of the stride at which its motion has corners. */
  readonly care: (joint: string) => { readonly tolerance: number; readonly corners?: readonly number[] };
}

/** Units: a tenth of a percent of a character about a unit high. */
const ROOT_TOLERANCE = 0.001;

/** Channels of the root translation and all joints, in take order. Joint 0 turns with the path. */
export function gaitChannels({ skeleton, path, poseAt: poseOf, frame, care }: Walk): Channel[] {
  // Each channel asks for the poses of the same phases.
  const known = new Map<number, WalkPose>();
  const poseAt = (phase: number) => {
    const pose = known.get(phase) ?? poseOf(phase);
    known.set(phase, pose);
    return pose;
  };
  const stride = path.strideSeconds;
  const round = pathSeconds(path);
  const translation = [0, 1, 2].map((axis) =>
    fitChannel((t) => path.toWorld(t, poseAt(t / stride).root)[axis] - skeleton.joints[0].offset[axis], {
      from: 0,
      to: axis === 1 || path.isStraight ? stride : round,
      frame,
      tolerance: ROOT_TOLERANCE,
      extrapolation: axis === 2 && path.isStraight ? 'cycle_offset' : 'cycle',
    }),
  );
  const turning = [0, 1, 2].map((axis) =>
    fitChannel((t) => (axis === 1 ? path.heading(t) : 0), {
      from: 0,
      to: round,
      frame: round,
      tolerance: ROOT_TOLERANCE,
      extrapolation: 'cycle_offset',
    }),
  );
  const limbs = skeleton.joints.slice(1).flatMap(({ name }) =>
    [0, 1, 2].map((axis) => {
      const { tolerance, corners = [] } = care(name);
      return fitChannel((t) => poseAt(t / stride).angles.get(name)?.[axis] ?? 0, {
        from: 0,
        to: stride,
        frame,
        tolerance,
        extrapolation: 'cycle',
        corners: corners.map((phase) => phase * stride),
      });
    }),
  );
  return [...translation, ...turning, ...limbs];
}
