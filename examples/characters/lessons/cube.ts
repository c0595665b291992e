/** The course's first example: a cube, tilted and turning. One joint, drawn as its box. */

import type { Sample } from '../example.ts';
import { held, keyed } from '../motion/keys.ts';
import { boxAbout, buildSkeleton } from '../shape/skeletons.ts';

const TURN_SECONDS = 4;

export function cubeSample(): Sample {
  const turn = keyed('cycle_offset', [
    [0, 0, 'linear', 'linear'],
    [TURN_SECONDS, 6.2832, 'linear', 'linear'],
  ]);
  return {
    id: 'cube',
    label: 'Cube',
    description: 'The first example: one joint, one box, one channel that turns it.',
    skeleton: buildSkeleton('cube', [{ name: 'cube', offset: [0, 1, 0], box: boxAbout([0, 0, 0], [0.5, 0.5, 0.5]) }]),
    morphs: [],
    take: {
      name: 'cube_spin',
      range: [0, TURN_SECONDS],
      channels: [held(0), held(0), held(0), held(0.5), turn, held(0)],
    },
    rig: { name: 'cube', skeleton: 'cube.skel', morphs: [], animation: 'cube_spin.anim' },
    textures: [],
  };
}
