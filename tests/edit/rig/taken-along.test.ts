/** What a rigging change carries along although it is about something else. */
import { describe, expect, it, onTestFinished, vi } from 'vitest';
import { documentIn } from '../../../src/edit/change.ts';
import { setRetarget } from '../../../src/edit/commands/retarget.ts';
import { addJoint, mirrorJoint, removeJoint, reparentJoint } from '../../../src/edit/commands/rig.ts';
import { renameJoint } from '../../../src/edit/commands/rig-joint.ts';
import { Store } from '../../../src/edit/store.ts';
import { compileSkeleton, worldMatrices } from '../../../src/evaluate/kinematics.ts';
import { dofCountOf, poseAt } from '../../../src/evaluate/pose.ts';
import { blendMorphs, compileSkin, deform } from '../../../src/evaluate/skin/deform.ts';
import { RADIANS_PER_DEGREE } from '../../../src/math/degrees.ts';
import { invertAffine, multiplyAffine } from '../../../src/math/mat4.ts';
import type { Character } from '../../../src/model/document.ts';
import type { Joint, Skeleton } from '../../../src/model/skeleton/skeleton.ts';
import { SAMPLED } from '../../../src/model/takes/take.ts';
import { character, documentOf, joint, morph, skin, takeOfValues } from '../../helpers/builders.ts';

const NEAR = 1e-12;
const named = (parent: number, name: string, more: Partial<Joint> = {}) => joint(parent, { name, ...more });
const skeletonOf = (...joints: Joint[]): Skeleton => ({ name: 'hero', joints });
const farthest = (a: ArrayLike<number>, b: ArrayLike<number>) =>
  Math.max(...Array.from(a, (value, i) => Math.abs(value - b[i])));

function shownAt(c: Character): { dofs: Float64Array; world: Float64Array } {
  if (!c.skeleton) throw new Error('no skeleton');
  const dofs = new Float64Array(dofCountOf(c));
  poseAt(c, 0, dofs);
  const world = new Float64Array(16 * c.skeleton.joints.length);
  worldMatrices(compileSkeleton(c.skeleton), dofs, world);
  return { dofs, world };
}

describe('a character that another one’s take moves', () => {
  const BODY = skeletonOf(
    named(-1, 'hip'),
    named(0, 'thigh'),
    named(1, 'knee', { offset: [0, -1, 0] }),
    named(0, 'tail'),
  );
  /** Hip, thigh and knee turn; the other one's tail is static. */
  const turned = takeOfValues('walk', [0, 0, 0, 0.2, 0, 0, 0, 0.3, 0, 0.1, 0.2, 0.3, 0, 0, 1]);
  const driven = (own = BODY) => {
    const store = new Store(
      documentOf(
        character({ skeleton: own }),
        character({ id: 'c2', name: 'dancer', skeleton: BODY, takes: [turned], shownTake: 0 }),
      ),
    );
    store.apply(setRetarget, { characterId: 'c1', sourceId: 'c2' });
    return store;
  };
  const pairsOf = (store: Store) =>
    store.document.characters[0].driver?.pairs.map(({ target, source }) => [target, source]);

  it('a retargeted character keeps its joints when they get other numbers', () => {
    const store = driven();
    expect(pairsOf(store)).toEqual([0, 1, 2, 3].map((j) => [j, j]));
    store.apply(addJoint, { characterId: 'c1', parent: 1, name: 'patch' });
    store.apply(removeJoint, { characterId: 'c1', joint: 2, children: 'too' });
    // hip – thigh – patch – tail
    expect(pairsOf(store)).toEqual([
      [0, 0],
      [1, 1],
      [3, 3],
    ]);
  });

  it('a retargeted character follows the same joints when the source is changed after an undo', () => {
    // As after garbage collection: undo makes the documents of the past anew.
    vi.stubGlobal(
      'WeakRef',
      class {
        deref = () => undefined;
      },
    );
    onTestFinished(() => void vi.unstubAllGlobals());
    const store = driven();
    store.apply(renameJoint, { characterId: 'c2', joint: 1, name: 'leg' });
    store.undo();
    store.apply(removeJoint, { characterId: 'c2', joint: 2, children: 'too' });
    // hip – thigh – tail
    expect(pairsOf(store)).toEqual([
      [0, 0],
      [1, 1],
      [3, 2],
    ]);
  });

  it('a character that another one’s take moves keeps the pivot of a joint that is moved and hangs on another one now, and its own pose', () => {
    // The tail is bent in the file, unlike the other one's, so its children get another rotation.
    const bent = BODY.joints.map((one, j) => (j === 3 ? { ...one, pose: [0.5, 0.25, 0] } : one));
    const store = driven({ ...BODY, joints: bent });
    const before = store.document.characters[0];
    store.apply(reparentJoint, { characterId: 'c1', joint: 2, parent: 3, timeSeconds: 0 });
    const [after] = store.document.characters;
    expect(after.skeleton?.joints.map(({ name }) => name)).toEqual(['hip', 'thigh', 'tail', 'knee']);
    expect(after.pose).toEqual([...before.pose.slice(0, 9), ...before.pose.slice(12), ...before.pose.slice(9, 12)]);
    expect(after.unkeyed).toBeUndefined();
    const [was, is] = [shownAt(before).world, shownAt(after).world];
    expect(farthest(was.slice(2 * 16 + 12, 2 * 16 + 15), is.slice(3 * 16 + 12, 3 * 16 + 15))).toBeLessThan(1e-9);
    expect(farthest(was.slice(2 * 16, 2 * 16 + 12), is.slice(3 * 16, 3 * 16 + 12))).toBeGreaterThan(0.01);
  });
});

describe('bind mode', () => {
  it('binds a joint that is new by its parent as that is bound now, which was moved with it', () => {
    const skeleton = skeletonOf(
      named(-1, 'root'),
      named(0, 'arm_l', { offset: [1, 0, 0] }),
      named(1, 'hand_l', { offset: [0.5, 0.25, 0] }),
      named(0, 'arm_r', { offset: [-3, 1, 0] }),
    );
    const document = documentOf(character({ skeleton, skins: [skin('hero', 3)] }));
    const args = { characterId: 'c1', joint: 1, across: 'x', skin: 'stays', timeSeconds: 0 } as const;
    const [after] = documentIn(mirrorJoint.run(document, args)).characters;
    expect(after.skeleton?.joints.map(({ name }) => name)).toEqual(['root', 'arm_l', 'hand_l', 'arm_r', 'hand_r']);
    expect(after.skeleton?.joints[3].offset).toEqual([-1, 0, 0]);
    const { world } = shownAt(after);
    const does = (j: number) => {
      const way = new Float64Array(16);
      invertAffine(after.skins[0].bindings, 16 * j, way, 0);
      multiplyAffine(world, 16 * j, way, 0, way, 0);
      return way;
    };
    // Vertices given to the new hand stay where the arm has them.
    expect(farthest(does(4), does(3))).toBeLessThan(NEAR);
  });

  it('takes morphs along with the shown skin, whatever other skins there are', () => {
    const skeleton = skeletonOf(named(-1, 'root'), named(0, 'arm'), named(1, 'hand'));
    // Bound in different ways, so that the way of their vertices is another one for each.
    const [a, b] = ['a', 'b'].map((name, n) => {
      const own = skin(name, 2);
      const bindings = own.bindings.slice();
      bindings[16 * 2 + 12] = n;
      return { ...own, bindings };
    });
    const pose = [0, 0, 0, 0, 0, 0, 0, 0, 0, 0.5, 0.25, 0, 0.5]; // the last is the weight
    for (const shownSkin of [0, 1]) {
      const before = character({
        skeleton,
        skins: [a, b],
        shownSkin,
        morphs: [morph('smile')],
        pose: pose.slice(0, 13),
      });
      const args = { characterId: 'c1', joint: 2, children: 'too', skin: 'stays', timeSeconds: 0 } as const;
      const [after] = documentIn(removeJoint.run(documentOf(before), args)).characters;
      const [was, is] = [vertices(before), vertices(after)];
      expect(farthest(was, vertices({ ...before, morphs: [] }))).toBeGreaterThan(0.1);
      expect(farthest(was, is)).toBeLessThan(1e-9);
    }
  });

  function vertices(c: Character): Float64Array {
    const { dofs, world } = shownAt(c);
    const compiled = compileSkin(c.skins[c.shownSkin]);
    const positions = c.skins[c.shownSkin].positions.slice();
    const normals = compiled.normals.slice();
    blendMorphs(compiled, c.morphs, dofs, dofs.length - c.morphs.length, positions, normals);
    deform(compiled, world, positions, normals, positions, normals);
    return positions;
  }
});

describe('a take of motion capture', () => {
  it('remains sampled in all its channels when a joint is appended', () => {
    const skeleton = skeletonOf(named(-1, 'root'), named(0, 'arm'));
    const walk = {
      name: 'walk',
      range: [0, 1] as const,
      channels: Array.from({ length: 9 }, () => SAMPLED),
      samples: {
        frameCount: 2,
        frameSeconds: 1,
        startSeconds: 0,
        firstChannel: 0,
        values: Float64Array.from({ length: 18 }, (_, i) => i),
        scales: new Float64Array(9).fill(RADIANS_PER_DEGREE),
        interpolation: 'linear' as const,
      },
    };
    const document = documentOf(character({ skeleton, takes: [walk], shownTake: 0 }));
    const [after] = documentIn(addJoint.run(document, { characterId: 'c1', parent: 1 })).characters;
    const { samples, channels } = after.takes[0];
    expect(samples?.scales.length).toBe(channels.length);
    expect([...(samples?.values ?? [])]).toEqual([
      0, 1, 2, 3, 4, 5, 6, 7, 8, 0, 0, 0, 9, 10, 11, 12, 13, 14, 15, 16, 17, 0, 0, 0,
    ]);
  });
});
