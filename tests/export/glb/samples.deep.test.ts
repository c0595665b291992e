/** Characters of every kind, as other programs show what was written. */
import { describe, expect, it } from 'vitest';
import type { Sample } from '../../../examples/characters/example.ts';
import { makeSamples } from '../../../examples/characters/examples.ts';
import type { Character } from '../../../src/model/document.ts';
import { filePose } from '../../../src/model/skeleton/dofs.ts';
import { character } from '../../helpers/builders.ts';
import { complaintsOf, type Glb, glbOf, inBabylon, inThree, keyCount } from '../../helpers/glb.ts';
import { offBy } from '../../helpers/glb-off.ts';

const SAMPLES = makeSamples();

/** Seconds of a walk: fitting keys to more of the same steps takes longer, and shows nothing else. */
const WALKED = 1;

function shown({ id, take }: Sample): Sample['take'] {
  return id === 'walker' || id === 'crawler' ? { ...take, range: [take.range[0], take.range[0] + WALKED] } : take;
}

function characterOf(sample: Sample): Character {
  const { skeleton, skin, morphs, textures } = sample;
  return character({
    name: skeleton.name,
    skeleton,
    skins: skin ? [skin] : [],
    morphs,
    takes: [shown(sample)],
    shownTake: 0,
    pose: filePose(skeleton, morphs.length),
    textures: textures.map(({ name, bytes }) => ({ name, mime: 'image/png', bytes: Uint8Array.from(bytes) })),
  });
}

/** Times of a take that are no frames. */
function timesOf(seconds: number, count: number): number[] {
  return Array.from({ length: count }, (_, i) => ((i + 0.37) * seconds) / count);
}

describe.each(SAMPLES.map((sample) => [sample.id, sample] as const))('the example %s as GLB', (_, sample) => {
  const own = characterOf(sample);
  const written = new Map<string, Glb>();
  const glb = (keys: 'linear' | 'cubic') => {
    const made = written.get(keys) ?? glbOf(own, { keys });
    written.set(keys, made);
    return made;
  };

  it.each(['linear', 'cubic'] as const)('the Khronos validator has no complaint about %s keys', async (keys) => {
    expect(await complaintsOf(glb(keys).bytes)).toEqual([]);
  });

  // The walker has no channel that hardly moves, which would lower its mean.
  it.each([
    ['linear', sample.id === 'walker' ? 0.51 : 0.7],
    ['cubic', 0.25],
  ] as const)('%s keys are at most %f of one a frame at 60 fps', (keys, most) => {
    const made = glb(keys);
    const { seconds, channels } = made.report.takes[0];
    expect(keyCount(made)).toBeLessThanOrEqual(Math.max(2, most * 60 * seconds) * channels);
  });

  it.each(['linear', 'cubic'] as const)('three.js and Babylon show %s keys within the tolerance', async (keys) => {
    const made = glb(keys);
    const { tolerance, takes } = made.report;
    for (const player of [await inThree(made), await inBabylon(made)]) {
      const off = offBy(own, made, player, 0, timesOf(takes[0].seconds, 60));
      expect(off.joints).toBeLessThanOrEqual(tolerance);
      expect(off.vertices).toBeLessThanOrEqual(tolerance);
    }
  });
});
