/** The walker example. */

import type { Sample } from '../example.ts';
import { painted } from '../paint/atlas.ts';
import { bindingMatrices, posedFrames } from '../shape/skeletons.ts';
import { buildWalkerMesh } from './body.ts';
import { MORPH_NAMES, walkerMorphs } from './morphs.ts';
import { paintWalker } from './paint.ts';
import { WALKER_SKELETON } from './skeleton.ts';
import { walkerTake } from './take.ts';

export function walkerSample(): Sample {
  const body = buildWalkerMesh();
  return {
    id: 'walker',
    label: 'Walker',
    description: 'A small explorer out for a stroll: a walk cycle, three morphs, a painted skin.',
    skeleton: WALKER_SKELETON,
    skin: body.mesh.skin('walker', bindingMatrices(posedFrames(WALKER_SKELETON)), {
      name: 'walker',
      texture: 'walker.png',
    }),
    morphs: walkerMorphs(body),
    take: walkerTake(),
    shows: { followRoot: true },
    rig: {
      name: 'walker',
      skeleton: 'walker.skel',
      skin: 'walker.skin',
      morphs: MORPH_NAMES.map((name) => `walker_${name}.morph`),
      animation: 'walker_walk.anim',
    },
    textures: [painted('walker.png', paintWalker)],
  };
}
