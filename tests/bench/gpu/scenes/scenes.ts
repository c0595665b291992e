/** What plays: on the page, and where three.js alone can do the same work, there too. */

import type { GivenBlob } from '../../../../src/worker/protocol.ts';
import { walkerFiles } from '../../../helpers/hero.ts';
import { capture } from '../../capture.ts';
import type { PeerScene } from '../peer/scene.ts';
import { star } from './star.ts';
import { tentacleFiles } from './tentacle-files.ts';

export interface Scene {
  readonly name: string;
  readonly label: string;
  readonly characters: number;
  /** Dropped on the page at once; absent: it plays what it opens with. */
  readonly files?: () => readonly GivenBlob[];
  /** The same for three.js alone. */
  readonly peer?: PeerScene;
}

/** How much of everything there is. */
export interface SceneSizes {
  readonly walkers: number;
  readonly captures: number;
  readonly vertices: number;
  readonly starJoints: number;
}

export const FULL: SceneSizes = { walkers: 100, captures: 50, vertices: 1_000_000, starJoints: 20_000 };

/** What a processor draws in a second or so. */
export const SMALL: SceneSizes = { walkers: 3, captures: 3, vertices: 2000, starJoints: 200 };

const CAPTURE = { joints: 70, frames: 600, frameSeconds: 1 / 120 };

export function scenesOf({ walkers, captures, vertices, starJoints }: SceneSizes): readonly Scene[] {
  const count = (n: number) => n.toLocaleString('en');
  return [
    { name: 'walker', label: 'the walker', characters: 1, peer: { kind: 'walkers', count: 1 } },
    {
      name: 'walkers',
      label: `${count(walkers)} walkers, files of their own`,
      characters: walkers,
      files: () => walkerFiles(walkers),
      peer: { kind: 'walkers', count: walkers },
    },
    {
      name: 'captures',
      label: `${count(captures)} captures of ${CAPTURE.joints} joints`,
      characters: captures,
      files: () =>
        Array.from({ length: captures }, (_, i) => ({
          path: `capture${i}.bvh`,
          blob: new Blob([capture(i, CAPTURE).bvh]),
        })),
    },
    {
      name: 'morphs',
      label: `a skin of ${count(vertices)} vertices, 3 morphs`,
      characters: 1,
      files: () => tentacleFiles(vertices),
      peer: { kind: 'tentacle', vertices },
    },
    {
      name: 'star',
      label: `a star of ${count(starJoints)} joints`,
      characters: 1,
      files: () => [{ path: 'star.bvh', blob: new Blob([star(starJoints)]) }],
    },
  ];
}

export const SCENE_NAMES: readonly string[] = scenesOf(FULL).map(({ name }) => name);
