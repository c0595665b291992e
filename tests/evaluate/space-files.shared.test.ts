/** Real files, which say neither unit nor axis nor ground: what they were recorded in is known from `data/bvh/README.md`. */
import { expect, it } from 'vitest';
import { forFrames } from '../../src/evaluate/bare-character.ts';
import { compileSkeleton, worldMatrices } from '../../src/evaluate/kinematics.ts';
import { applySpace } from '../../src/evaluate/space/space.ts';
import { guessSpace } from '../../src/evaluate/space/space-guess.ts';
import { readBvh } from '../../src/formats/bvh/read.ts';
import { positionsMeant, withPositions } from '../../src/model/skeleton/position-channels.ts';
import type { LengthUnit } from '../../src/model/space.ts';
import { describeShared, sharedBytes } from '../helpers/shared.ts';

const FILES: readonly (readonly [string, LengthUnit, 'y' | 'z'])[] = [
  ['bandai-namco-bow-normal.bvh', 'centimetres', 'y'],
  ['boxing-extra-line.bvh', 'centimetres', 'y'],
  ['cmu-01_01.bvh', 'cmu', 'y'],
  ['cmu-daz-pirouette.bvh', 'centimetres', 'y'],
  ['geno-stance.bvh', 'centimetres', 'y'],
  ['lafan1-dance-10frames.bvh', 'centimetres', 'y'],
  ['makehuman-tpose-add.bvh', 'decimetres', 'z'],
  ['mixamo-names.bvh', 'centimetres', 'y'],
  ['no-end-sites.bvh', 'inches', 'z'],
  ['openni-kinect-hash-names.bvh', 'millimetres', 'y'],
  ['perception-neuron-course.bvh', 'centimetres', 'y'],
  ['poser-sl-walk.bvh', 'inches', 'y'],
  ['rokoko-dance.bvh', 'centimetres', 'y'],
  ['xsens-armchair.bvh', 'centimetres', 'y'],
];

describeShared('captured characters of many sources', () => {
  it.each(FILES)('%s is in %s, %s up, as tall as a person and on the ground', (file, unit, up) => {
    const { value } = readBvh(sharedBytes(`data/bvh/${file}`), file);
    expect(value).toHaveLength(1);
    for (const { skeleton: read, take } of value ?? []) {
      const skeleton = withPositions(read, positionsMeant(read, take));
      const space = guessSpace(skeleton, take);
      expect([space.unit, space.up]).toEqual([unit, up]);
      const compiled = compileSkeleton(skeleton);
      const world = new Float64Array(16 * skeleton.joints.length);
      const at = new Float64Array(3);
      let tallest = 0;
      const lows: number[] = [];
      forFrames(skeleton, take, 40, (dofs) => {
        worldMatrices(compiled, dofs, world);
        let low = Infinity;
        let high = -Infinity;
        for (let o = 12; o < world.length; o += 16) {
          applySpace(space, world[o], world[o + 1], world[o + 2], at);
          low = Math.min(low, at[1]);
          high = Math.max(high, at[1]);
        }
        tallest = Math.max(tallest, high - low);
        lows.push(low);
      });
      expect(tallest).toBeGreaterThan(1.1);
      expect(tallest).toBeLessThan(2.1);
      // Joints, without the End Sites that may be lower: an ankle is up to 12 cm over its sole.
      const usual = lows.sort((a, b) => a - b)[Math.floor(lows.length / 3)];
      expect(usual).toBeGreaterThan(-0.03);
      expect(usual).toBeLessThan(0.13);
    }
  });

  it('positions of MakeHuman’s captures are taken as added to OFFSET, no others’ are', () => {
    for (const [file] of FILES) {
      const { value } = readBvh(sharedBytes(`data/bvh/${file}`), file);
      const meant = value?.map(({ skeleton, take }) => positionsMeant(skeleton, take));
      expect(meant).toEqual([file.startsWith('makehuman') ? 'add' : 'replace']);
    }
  });
});
