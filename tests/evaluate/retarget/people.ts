/** Small people to put takes onto each other: the same body under other names, in other poses, units and axes. */
import { provideRetargeting } from '../../../src/evaluate/retarget/driving.ts';
import type { Vec3 } from '../../../src/math/vec3.ts';
import type { Driver } from '../../../src/model/document.ts';
import { filePose, jointDofCount, rootDofCount } from '../../../src/model/skeleton/dofs.ts';
import { dofsOf } from '../../../src/model/skeleton/joint-types.ts';
import { type BvhMotion, type Motion, type Skeleton, UNLIMITED } from '../../../src/model/skeleton/skeleton.ts';
import type { Space } from '../../../src/model/space.ts';
import { DEFAULT_RETARGET, type JointPair, type RetargetOptions } from '../../../src/model/takes/retarget.ts';
import type { Samples } from '../../../src/model/takes/samples.ts';
import { restChannel, SAMPLED, type Take } from '../../../src/model/takes/take.ts';

provideRetargeting();

export const PARTS = [
  'hips',
  'spine',
  'chest',
  'neck',
  'head',
  'left collar',
  'left arm',
  'left forearm',
  'left hand',
  'right collar',
  'right arm',
  'right forearm',
  'right hand',
  'left thigh',
  'left shin',
  'left foot',
  'left toe',
  'right thigh',
  'right shin',
  'right foot',
  'right toe',
] as const;
export type Part = (typeof PARTS)[number];

/** Parent, and offset in a T pose; a person of 1.64 with legs of 0.8. */
const BODY: Readonly<Record<string, readonly [string, Vec3]>> = {
  hips: ['', [0, 0.9, 0]],
  spine: ['hips', [0, 0.12, 0]],
  chest: ['spine', [0, 0.2, 0]],
  neck: ['chest', [0, 0.22, 0]],
  head: ['neck', [0, 0.1, 0]],
  collar: ['chest', [0.06, 0.18, 0]],
  arm: ['collar', [0.12, 0, 0]],
  forearm: ['arm', [0.28, 0, 0]],
  hand: ['forearm', [0.25, 0, 0]],
  thigh: ['hips', [0.1, -0.02, 0]],
  shin: ['thigh', [0, -0.42, 0]],
  foot: ['shin', [0, -0.38, 0]],
  toe: ['foot', [0, -0.05, 0.14]],
};

export const BVH_ROOT: BvhMotion = {
  kind: 'bvh',
  channels: ['tx', 'ty', 'tz', 'rz', 'rx', 'ry'],
  positions: 'replace',
};

export interface Looks {
  readonly names?: (part: Part, index: number) => string;
  readonly size?: number;
  /** How far arms hang; radians. 0 is a T pose. */
  readonly droop?: number;
  /** Up is z, and the front −y. */
  readonly zUp?: boolean;
  readonly motion?: (part: Part) => Motion;
}

export function person({ names = (part) => part, size = 1, droop = 0, zUp = false, motion }: Looks = {}): Skeleton {
  const joints = PARTS.map((part, index) => {
    const [side, own] = part.includes(' ') ? part.split(' ') : ['', part];
    const [parentName, offset] = BODY[own];
    const mirror = side === 'right' ? -1 : 1;
    const parentPart = parentName in BODY && !PARTS.includes(parentName as Part) ? `${side} ${parentName}` : parentName;
    let [x, y, z] = offset.map((v) => v * size);
    if (own === 'forearm' || own === 'hand') [x, y] = [x * Math.cos(droop), -x * Math.sin(droop)];
    x *= mirror;
    const placed: Vec3 = zUp ? [x, -z, y] : [x, y, z];
    const moves: Motion = motion?.(part) ?? (index === 0 ? BVH_ROOT : { kind: 'ball', order: 'xyz' });
    const dofs = dofsOf(moves);
    return {
      name: names(part, index),
      parent: PARTS.indexOf(parentPart as Part),
      offset: placed,
      box: { min: [0, 0, 0] as const, max: [0, 0, 0] as const },
      motion: moves,
      limits: dofs.map(() => UNLIMITED),
      pose: dofs.map(({ name, rest }) =>
        moves.kind === 'bvh' && name.startsWith('t') ? placed['xyz'.indexOf(name[1])] : rest,
      ),
    };
  });
  return { name: 'person', joints };
}

/** A take of frames of all joint DOFs, one a second tenth. */
export function takeOfRows(skeleton: Skeleton, rows: readonly (readonly number[])[], frameSeconds = 0.1): Take {
  const width = jointDofCount(skeleton);
  const first = rootDofCount(skeleton);
  const samples: Samples = {
    frameCount: rows.length,
    frameSeconds,
    startSeconds: 0,
    firstChannel: first,
    values: Float64Array.from(rows.flat()),
    scales: new Float64Array(width).fill(1),
    interpolation: 'linear',
  };
  return {
    name: 'take',
    range: [0, (rows.length - 1) * frameSeconds],
    channels: Array.from({ length: first + width }, (_, c) => (c < first ? restChannel() : SAMPLED)),
    samples,
  };
}

export function driverOf(
  skeleton: Skeleton,
  take: Take,
  pairs: readonly JointPair[],
  options: Partial<RetargetOptions> = {},
  space?: Space,
): Driver {
  return {
    sourceId: 'source',
    source: {
      name: 'source',
      skeleton,
      take,
      pose: filePose(skeleton, 0),
      clampsToLimits: true,
      timeOffsetSeconds: 0,
      ...(space && { space }),
    },
    pairs,
    options: { ...DEFAULT_RETARGET, ...options },
  };
}
