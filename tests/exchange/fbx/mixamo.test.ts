/**
 * A capture as Mixamo exports it: joints with pre-rotations, every frame a key of Euler angles. Read from FBX it is
 * retargeted to and from like the capture itself.
 */
import { expect, it } from 'vitest';
import { compileSkeleton, worldMatrices } from '../../../src/evaluate/kinematics.ts';
import { poseAt } from '../../../src/evaluate/pose.ts';
import { measureRetarget } from '../../../src/evaluate/retarget/measure.ts';
import { rolesOf } from '../../../src/evaluate/retarget/roles.ts';
import { multiplyQuaternions, writeAnglesNear, writeQuaternion } from '../../../src/exchange/rotations.ts';
import { RADIANS_PER_DEGREE } from '../../../src/math/degrees.ts';
import { quaternionOfRotation } from '../../../src/math/quaternion.ts';
import { keysOf } from '../../../src/model/clip.ts';
import { type Character, shownClip } from '../../../src/model/document.ts';
import { filePose } from '../../../src/model/dofs.ts';
import { walkerClip } from '../../../src/samples/walker/clip.ts';
import { WALKER_SKELETON } from '../../../src/samples/walker/skeleton.ts';
import { captured, retargeted } from '../../evaluate/retarget/captures.ts';
import { character } from '../../helpers/builders.ts';
import { posed } from '../../helpers/posed.ts';
import { describeShared } from '../../helpers/shared.ts';
import { characterOf } from './read-character.ts';
import { type Connection, curve, type Fbx, fbxBytes, type Obj, prop, ticks } from './write-fbx.ts';

const FRAMES = 40;

/** Of each joint and frame: where it is in its parent, and how it is turned. */
function localsOf(source: Character, times: readonly number[]) {
  const skeleton = source.skeleton;
  if (!skeleton) throw new Error('no skeleton');
  const compiled = compileSkeleton(skeleton);
  const worlds = new Float64Array(16 * compiled.jointCount);
  const values = Float64Array.from(source.pose);
  return times.map((time) => {
    poseAt(source, time, values);
    worldMatrices(compiled, values, worlds);
    return skeleton.joints.map(({ parent }, j) => {
      const own = worlds.slice(16 * j, 16 * j + 16);
      const above = parent < 0 ? undefined : worlds.slice(16 * parent, 16 * parent + 16);
      const position = [own[12], own[13], own[14]];
      if (!above) return { position, rotation: rotationOf((c, r) => own[4 * c + r]) };
      const away = position.map((value, k) => value - above[12 + k]);
      const dot = (a: number, v: (k: number) => number) =>
        [0, 1, 2].reduce((sum, k) => sum + above[4 * a + k] * v(k), 0);
      return {
        position: [0, 1, 2].map((a) => dot(a, (k) => away[k])),
        rotation: rotationOf((c, r) => dot(r, (k) => own[4 * c + k])),
      };
    });
  });
}

function rotationOf(at: (column: number, row: number) => number): Float64Array {
  const q = new Float64Array(4);
  quaternionOfRotation(
    Float64Array.from({ length: 9 }, (_, i) => at(Math.floor(i / 3), i % 3)),
    0,
    q,
  );
  return q;
}

/** Each joint with a pre-rotation of its own. */
function fbxOf(source: Character, times: readonly number[]): Fbx {
  const locals = localsOf(source, times);
  const objects: Obj[] = [
    {
      id: 1,
      kind: 'AnimationStack',
      name: 'mixamo.com',
      props: [prop('LocalStart', ticks(times[0])), prop('LocalStop', ticks(times[times.length - 1]))],
    },
    { id: 2, kind: 'AnimationLayer', name: 'BaseLayer' },
  ];
  const connections: Connection[] = [[2, 1]];
  let next = 1000;
  for (const [j, { name, parent }] of (source.skeleton?.joints ?? []).entries()) {
    const before = [(j * 37) % 180, (j * 11) % 60, (j * 53) % 180];
    const inverse = new Float64Array(4);
    writeQuaternion(
      'xyz',
      before.map((degrees) => degrees * RADIANS_PER_DEGREE),
      inverse,
    );
    for (let k = 0; k < 3; k++) inverse[k] = -inverse[k];
    const near = new Float64Array(3);
    // At rest joints are not turned, as in the capture.
    writeAnglesNear('xyz', inverse, near);
    const rest = [...near].map((angle) => angle / RADIANS_PER_DEGREE);
    const angles = locals.map((frame) => {
      const q = new Float64Array(4);
      multiplyQuaternions(inverse, frame[j].rotation, q);
      writeAnglesNear('xyz', q, near);
      return [...near].map((angle) => angle / RADIANS_PER_DEGREE);
    });
    const id = 100 + j;
    objects.push({
      id,
      kind: 'Model',
      name,
      type: 'LimbNode',
      props: [
        prop('Lcl Translation', ...locals[0][j].position),
        prop('Lcl Rotation', ...rest),
        prop('PreRotation', ...before),
      ],
    });
    connections.push([id, parent < 0 ? 0 : 100 + parent]);
    const drive = (property: string, values: readonly (readonly number[])[]) => {
      const node = next++;
      objects.push({ id: node, kind: 'AnimationCurveNode', name: property });
      connections.push([node, 2], [node, id, property]);
      for (const [k, axis] of ['X', 'Y', 'Z'].entries()) {
        const own = next++;
        objects.push(
          curve(
            own,
            times.map((time, f) => ({ time, value: values[f][k], flags: 4 })),
          ),
        );
        connections.push([own, node, `d|${axis}`]);
      }
    };
    drive('Lcl Rotation', angles);
    if (parent < 0)
      drive(
        'Lcl Translation',
        locals.map((frame) => frame[j].position),
      );
  }
  return { objects, connections };
}

describeShared('a capture in an FBX file as Mixamo writes it', () => {
  const source = captured('mixamo-names.bvh');
  const samples = shownClip(source)?.samples;
  const times = Array.from(
    { length: FRAMES },
    (_, f) => (samples?.startSeconds ?? 0) + f * (samples?.frameSeconds ?? 1),
  );
  const bytes = fbxBytes(fbxOf(source, times));
  const whole = characterOf(bytes);
  const read: Character = {
    ...character({ id: 'mixamo', skeleton: whole.skeleton, clips: whole.clips, shownClip: 0 }),
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

  it('its channels have about as many keys as the file', () => {
    const count = whole.clips[0].channels.reduce((sum, channel) => sum + keysOf(channel).times.length, 0);
    const before = FRAMES * (3 * whole.skeleton.joints.length + 3);
    expect(count).toBeGreaterThan(before / 2);
    expect(count).toBeLessThan(before * 1.1);
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
      clips: [walkerClip()],
      shownClip: 0,
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
