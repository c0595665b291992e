/** Made takes: a chain of BVH joints that swings, for the tools for samples. */

import { RADIANS_PER_DEGREE } from '../../../src/math/degrees.ts';
import type { Character, Document } from '../../../src/model/document.ts';
import { type BvhChannel, type Joint, type Skeleton, UNLIMITED } from '../../../src/model/skeleton/skeleton.ts';
import type { Samples } from '../../../src/model/takes/samples.ts';
import { SAMPLED, type Take } from '../../../src/model/takes/take.ts';
import { character, documentOf, joint } from '../../helpers/builders.ts';

const ROOT: readonly BvhChannel[] = ['tx', 'ty', 'tz', 'rz', 'rx', 'ry'];
const LIMB: readonly BvhChannel[] = ['rz', 'rx', 'ry'];

function bvhJoint(parent: number, channels: readonly BvhChannel[], more: Partial<Joint> = {}): Joint {
  const motion = { kind: 'bvh' as const, channels, positions: 'replace' as const };
  return joint(parent, { motion, limits: channels.map(() => UNLIMITED), pose: channels.map(() => 0), ...more });
}

/** Hips, spine, head, each a unit above the other. */
export const CHAIN: Skeleton = {
  name: 'chain',
  joints: [bvhJoint(-1, ROOT), bvhJoint(0, LIMB), bvhJoint(1, LIMB, { endSites: [[0, 0.5, 0]] })],
};
export const WIDTH: number = ROOT.length + 2 * LIMB.length;

/** @param of a value in file units (degrees) for each column and second */
export function takeOfColumns(of: (column: number, seconds: number) => number, frameCount = 121, rate = 60): Take {
  const samples: Samples = {
    frameCount,
    frameSeconds: 1 / rate,
    startSeconds: 0,
    firstChannel: 0,
    values: Float64Array.from({ length: frameCount * WIDTH }, (_, i) => of(i % WIDTH, Math.floor(i / WIDTH) / rate)),
    scales: Float64Array.from({ length: WIDTH }, (_, c) => (c < 3 ? 1 : RADIANS_PER_DEGREE)),
    interpolation: 'linear',
  };
  const channels = Array.from({ length: WIDTH }, () => SAMPLED);
  return { name: 'swing', range: [0, (frameCount - 1) / rate], channels, samples };
}

export const swing: Take = takeOfColumns((c, t) => (c < 3 ? t * (c + 1) : 30 * Math.sin(2 * t + c)));

export function swinging(take: Take = swing): Character {
  return character({ id: 'c1', name: 'chain', skeleton: CHAIN, takes: [take], shownTake: 0, clampsToLimits: false });
}

export function documentWith(take: Take = swing): Document {
  return documentOf(swinging(take));
}
