/** Hand-made BVH captures: a skeleton whose joints have channels, and rows of values in degrees. */

import { RADIANS_PER_DEGREE } from '../../src/math/degrees.ts';
import type { Capture } from '../../src/model/files.ts';
import { rootDofCount } from '../../src/model/skeleton/dofs.ts';
import { dofsOf } from '../../src/model/skeleton/joint-types.ts';
import { type BvhChannel, type Joint, type Skeleton, UNLIMITED } from '../../src/model/skeleton/skeleton.ts';
import { restChannel, SAMPLED } from '../../src/model/takes/take.ts';
import { joint } from './builders.ts';

export function bvhJoint(parent: number, channels: readonly BvhChannel[], more: Partial<Joint> = {}): Joint {
  const offset = more.offset ?? [0, 1, 0];
  return joint(parent, {
    motion: { kind: 'bvh', channels, positions: 'replace' },
    limits: channels.map(() => UNLIMITED),
    pose: channels.map((name) => (name.startsWith('t') ? offset['xyz'.indexOf(name[1])] : 0)),
    ...more,
  });
}

/** @param rows a value per channel, in the file's units */
export function captureOf(skeleton: Skeleton, rows: readonly (readonly number[])[], frameSeconds = 0.04): Capture {
  const scales = skeleton.joints.flatMap(({ motion }) =>
    dofsOf(motion).map(({ unit }) => (unit === 'angle' ? RADIANS_PER_DEGREE : 1)),
  );
  const firstChannel = rootDofCount(skeleton);
  return {
    skeleton,
    take: {
      name: skeleton.name,
      range: [0, (rows.length - 1) * frameSeconds],
      channels: Array.from({ length: firstChannel + scales.length }, (_, c) =>
        c < firstChannel ? restChannel() : SAMPLED,
      ),
      samples: {
        frameCount: rows.length,
        frameSeconds,
        startSeconds: 0,
        firstChannel,
        values: Float64Array.from(rows.flat()),
        scales: Float64Array.from(scales),
        interpolation: 'linear',
      },
    },
  };
}
