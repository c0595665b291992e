/**
 * A capture as Mixamo exports it: joints with pre-rotations, every frame a key of Euler angles. Read from FBX it is
 * retargeted to and from like the capture itself.
 */
import { expect, it } from 'vitest';
import { WALKER_SKELETON } from '../../../examples/characters/walker/skeleton.ts';
import { walkerTake } from '../../../examples/characters/walker/take.ts';
import { compileSkeleton, worldMatrices } from '../../../src/evaluate/kinematics.ts';
import { poseAt } from '../../../src/evaluate/pose.ts';
import { measureRetarget } from '../../../src/evaluate/retarget/measure.ts';
import { rolesOf } from '../../../src/evaluate/retarget/roles.ts';
import { type Character, shownTake } from '../../../src/model/document.ts';
import { filePose } from '../../../src/model/skeleton/dofs.ts';
import { keysOf } from '../../../src/model/takes/take.ts';
import { captured, retargeted } from '../../evaluate/retarget/captures.ts';
import { character } from '../../helpers/builders.ts';
import { posed } from '../../helpers/posed.ts';
import { describeShared } from '../../helpers/shared.ts';
import { mixamoFile } from './mixamo-file.ts';
import { characterOf } from './read-character.ts';
import { fbxBytes } from './write-fbx.ts';

const FRAMES = 40;

describeShared('a capture in an FBX file as Mixamo writes it', () => {
  const source = captured('mixamo-names.bvh');
  const samples = shownTake(source)?.samples;
  const times = Array.from(
    { length: FRAMES },
    (_, f) => (samples?.startSeconds ?? 0) + f * (samples?.frameSeconds ?? 1),
  );
  const bytes = fbxBytes(mixamoFile(source, times));
  const whole = characterOf(bytes);
  const read: Character = {
    ...character({ id: 'mixamo', skeleton: whole.skeleton, takes: whole.takes, shownTake: 0 }),
    pose: filePose(whole.skeleton, 0),
    ...(source.space && { space: source.space }),
  };

  it('its joints are where those of the capture are, under the same names', () => {
    expect(whole.skeleton.joints.map(({ name }) => name)).toEqual(source.skeleton?.joints.map(({ name }) => name));
    const compiled = compileSkeleton(whole.skeleton);
    const worlds = new Float64Array(16 * compiled.jointCount);
    const values = Float64Array.from(source.pose);
    for (const time of [times[0], times[7], times[FRAMES - 1]]) {
      poseAt(source, time, values);
      if (source.skeleton) worldMatrices(compileSkeleton(source.skeleton), values, worlds);
      const own = posed(whole, 0, time).worlds;
      for (let o = 12; o < worlds.length; o += 16) {
        // A person is 170 high. Values of keys are floats.
        for (let k = 0; k < 3; k++) expect(Math.abs(own[o + k] - worlds[o + k])).toBeLessThan(0.01);
      }
    }
  });

  it('its channels have about as many keys as the file, but for joints that only tremble by rounding', () => {
    const counts = whole.takes[0].channels.map((channel) => keysOf(channel).times.length);
    const moving = counts.filter((count) => count > 0);
    // Without fingers, eyes and the ends of bones.
    expect(moving.length).toBeGreaterThan(60);
    for (const count of moving) {
      expect(count).toBeGreaterThanOrEqual(FRAMES);
      expect(count).toBeLessThan(FRAMES * 1.1);
    }
  });

  it('its parts of the body are found by their names, as those of the capture', () => {
    expect([...rolesOf(whole.skeleton, read.space).single]).toEqual([
      ...rolesOf(source.skeleton ?? whole.skeleton, source.space).single,
    ]);
  });

  it('its take drives the walker as well as the capture does, and is driven by the walk', () => {
    const walker = character({
      id: 'walker',
      skeleton: WALKER_SKELETON,
      takes: [walkerTake()],
      shownTake: 0,
      pose: filePose(WALKER_SKELETON, 0),
    });
    const onto = measureRetarget(retargeted(read, walker), 0);
    const expected = measureRetarget(retargeted(source, walker), 0);
    expect(onto.limbs).toBe(expected.limbs);
    expect(onto.limbsMean).toBeLessThan(expected.limbsMean + 1);
    const driven = measureRetarget(retargeted(walker, read, { plantsFeet: false }), 0);
    expect(driven.limbs).toBe(4);
    expect(driven.limbsMean).toBeLessThan(15);
  });
});
