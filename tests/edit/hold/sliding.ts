/** A character on two legs whose feet slide on the ground. */
import type { Character } from '../../../src/model/document.ts';
import type { BvhChannel, Joint, Skeleton } from '../../../src/model/skeleton/skeleton.ts';
import { DEFAULT_BOX, UNLIMITED } from '../../../src/model/skeleton/skeleton.ts';
import { captured, takeOfRoots } from '../../helpers/mocap.ts';

const ROTATIONS: readonly BvhChannel[] = ['rz', 'rx', 'ry'];

function bone(name: string, parent: number, offset: Joint['offset'], endSites?: Joint['endSites']): Joint {
  const channels: readonly BvhChannel[] = parent < 0 ? ['tx', 'ty', 'tz', ...ROTATIONS] : ROTATIONS;
  return {
    name,
    parent,
    offset,
    box: DEFAULT_BOX,
    motion: { kind: 'bvh', channels, positions: 'replace' },
    limits: channels.map(() => UNLIMITED),
    pose: channels.map(() => 0),
    ...(endSites && { endSites }),
  };
}

const leg = (side: string, x: number, first: number): readonly Joint[] => [
  bone(`${side}UpLeg`, 0, [x, 0, 0]),
  bone(`${side}Leg`, first, [0, -0.45, 0.02]),
  bone(`${side}Foot`, first + 1, [0, -0.45, -0.02]),
  bone(`${side}Toe`, first + 2, [0, -0.05, 0.12], [[0, 0, 0.05]]),
];

/** Metres. */
export const TWO_LEGS: Skeleton = {
  name: 'legs',
  joints: [bone('Hips', -1, [0, 0, 0]), ...leg('Left', 0.1, 1), ...leg('Right', -0.1, 5), bone('Head', 0, [0, 0.6, 0])],
};

/** 10 frames a second, with both feet on the ground, that move by that many metres a frame. */
export function sliding(perFrame: number): Character {
  const path = Array.from({ length: 12 }, (_, f) => [0, 0.92, perFrame * f] as const);
  const space = { up: 'y', unit: 'metres', lift: 0 } as const;
  return captured(TWO_LEGS, takeOfRoots(TWO_LEGS, path), { space });
}
