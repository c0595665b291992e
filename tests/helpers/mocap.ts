/** A generated motion capture character: hips, head, two legs; any height and orientation. */

import { RADIANS_PER_DEGREE } from '../../src/math/degrees.ts';
import type { Character } from '../../src/model/document.ts';
import { filePose } from '../../src/model/skeleton/dofs.ts';
import {
  type BvhChannel,
  DEFAULT_BOX,
  type Joint,
  type Skeleton,
  UNLIMITED,
} from '../../src/model/skeleton/skeleton.ts';
import { SAMPLED, type Take } from '../../src/model/takes/take.ts';
import { character } from './builders.ts';

type Point = readonly [number, number, number];

const CHANNELS: readonly BvhChannel[] = ['tx', 'ty', 'tz', 'rz', 'rx', 'ry'];
const ROTATIONS: readonly BvhChannel[] = ['rz', 'rx', 'ry'];

export interface PersonOptions {
  /** From the soles to the top of the head. */
  readonly height?: number;
  readonly up?: 'y' | 'z';
  /** Names tell which way is up; without them joints are called a, b, c … */
  readonly named?: boolean;
  /** Position channels on every joint, not only on the root. */
  readonly positionsEverywhere?: boolean;
}

export function personSkeleton(options: PersonOptions = {}): Skeleton {
  const { height = 170, up = 'y', named = true, positionsEverywhere = false } = options;
  const at = (x: number, y: number, z: number): Point =>
    up === 'y' ? [x * height, y * height, z * height] : [x * height, -z * height, y * height];
  const make = (name: string, parent: number, offset: Point, endSites?: readonly Point[]): Joint => {
    const channels = parent < 0 || positionsEverywhere ? CHANNELS : ROTATIONS;
    return {
      name: named ? name : String.fromCharCode(97 + name.length),
      parent,
      offset,
      box: DEFAULT_BOX,
      motion: { kind: 'bvh', channels, positions: 'replace' },
      limits: channels.map(() => UNLIMITED),
      pose: channels.map((c) => (c.startsWith('t') ? offset['xyz'.indexOf(c[1])] : 0)),
      ...(endSites && { endSites }),
    };
  };
  return {
    name: 'figure',
    joints: [
      make('Hips', -1, at(0, 0, 0)),
      make('Head', 0, at(0, 0.35, 0), [at(0, 0.15, 0)]),
      make('LeftLeg', 0, at(0.06, -0.05, 0)),
      make('LeftFoot', 2, at(0, -0.4, 0), [at(0, -0.05, 0.08)]),
      make('RightLeg', 0, at(-0.06, -0.05, 0)),
      make('RightFoot', 4, at(0, -0.4, 0), [at(0, -0.05, 0.08)]),
    ],
  };
}

/**
 * A take of the character: rows of the root's position, everything else standing.
 * @param others what position channels of the other joints hold; their OFFSET where absent
 */
export function takeOfRoots(skeleton: Skeleton, roots: readonly Point[], others?: number): Take {
  const scales: number[] = [];
  const row: number[] = [];
  for (const { motion, offset } of skeleton.joints) {
    if (motion.kind !== 'bvh') continue;
    for (const channel of motion.channels) {
      const moves = channel.startsWith('t');
      scales.push(moves ? 1 : RADIANS_PER_DEGREE);
      row.push(moves ? (others ?? offset['xyz'.indexOf(channel[1])]) : 0);
    }
  }
  const values = Float64Array.from(roots.flatMap((root) => [...root, ...row.slice(3)]));
  return {
    name: 'take',
    range: [0, (roots.length - 1) / 10],
    channels: scales.map(() => SAMPLED),
    samples: {
      frameCount: roots.length,
      frameSeconds: 0.1,
      startSeconds: 0,
      firstChannel: 0,
      values,
      scales: Float64Array.from(scales),
      interpolation: 'linear',
    },
  };
}

export function captured(skeleton: Skeleton, take?: Take, more: Partial<Character> = {}): Character {
  const own = character({ skeleton, takes: take ? [take] : [], shownTake: take ? 0 : -1 });
  return { ...own, pose: filePose(skeleton, 0), ...more };
}
