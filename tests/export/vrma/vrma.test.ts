/** VRM animations: a T-pose in metres that faces +z, and in every frame the bones of the take. */
import { describe, expect, it } from 'vitest';
import { writeVrma } from '../../../src/export/vrma/write.ts';
import { character, skeleton } from '../../helpers/builders.ts';
import { complaintsOf } from '../../helpers/glb.ts';
import { hero } from '../../helpers/hero.ts';
import { farthestDistance, slant, vrmaOf } from './vrma-file.ts';

describe('a VRM animation', () => {
  it('a VRM animation is a valid GLB that names the bones of the humanoid, which turn only, and whose hips move', async () => {
    const made = vrmaOf(await hero());
    expect(await complaintsOf(made.bytes)).toEqual([]);
    expect(made.json.extensionsUsed).toEqual(['VRMC_vrm_animation']);
    expect(made.json.extensions.VRMC_vrm_animation.specVersion).toBe('1.0');
    expect(made.nodes[made.bones.leftUpperArm.node].name).toBe('mixamorig:LeftArm');
    expect(made.json.meshes).toBeUndefined();
    const channels: readonly { readonly target: { readonly node: number; readonly path: string } }[] =
      made.json.animations[0].channels;
    const moved = channels.filter(({ target }) => target.path === 'translation').map(({ target }) => target.node);
    expect(moved).toEqual([made.bones.hips.node]);
    expect(channels.every(({ target }) => target.path !== 'scale')).toBe(true);
  });

  it('a VRM animation rests in a T-pose that faces +z: no node is turned, arms are along x, legs point down', async () => {
    const made = vrmaOf(await hero());
    for (const { rotation } of made.nodes) expect(rotation).toBeUndefined();
    for (const [side, x] of [
      ['left', 1],
      ['right', -1],
    ] as const) {
      expect(slant(made, `${side}UpperArm`, `${side}LowerArm`, [x, 0, 0])).toBeLessThan(0.1);
      expect(slant(made, `${side}LowerArm`, `${side}Hand`, [x, 0, 0])).toBeLessThan(0.1);
      expect(slant(made, `${side}UpperLeg`, `${side}LowerLeg`, [0, -1, 0])).toBeLessThan(0.1);
      expect(slant(made, `${side}LowerLeg`, `${side}Foot`, [0, -1, 0])).toBeLessThan(0.1);
    }
    expect(made.at('hips')[0]).toBeCloseTo(0, 6);
    expect(made.at('leftToes')[2]).toBeGreaterThan(made.at('leftFoot')[2]);
  });

  it('in every frame of a VRM animation the distances of bones are those of the take', async () => {
    const own = await hero();
    const made = vrmaOf(own);
    expect(await farthestDistance(own, made)).toBeLessThan(made.report.size / 500);
  });

  it('a skeleton that isn’t a humanoid is refused, and the missing bones are named', () => {
    const own = character({ skeleton: skeleton(3) });
    expect(() => writeVrma(own, { body: true })).toThrow(
      /^A VRM animation needs a joint for each of VRM's 15 required bones; hero has none for .*leftHand.*\. Name its joints after these\.$/,
    );
  });

  it('a humanoid without a take, and one of another name, are refused', async () => {
    const own = await hero();
    expect(() => writeVrma({ ...own, takes: [], shownTake: -1 }, { body: true })).toThrow(
      'hero has no take; a VRM animation is one.',
    );
    expect(() => writeVrma(own, { body: true, take: 'none' })).toThrow('hero has no take none; its takes are stride.');
  });
});
