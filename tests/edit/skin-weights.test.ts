import { describe, expect, it } from 'vitest';
import { CommandError } from '../../src/edit/command-error.ts';
import { autoWeights, autoWeightsSteps, bindPlaces } from '../../src/edit/commands/skin-weights.ts';
import { Store } from '../../src/edit/store.ts';
import { compileSkeleton, worldMatrices } from '../../src/evaluate/kinematics.ts';
import { dofCountOf, poseAt } from '../../src/evaluate/pose.ts';
import { compileSkin, deform, skinMatrices } from '../../src/evaluate/skin/deform.ts';
import { readSkin } from '../../src/formats/skin/read.ts';
import { writeSkin } from '../../src/formats/skin/write.ts';
import type { Vec3 } from '../../src/math/vec3.ts';
import type { Character } from '../../src/model/document.ts';
import { filePose } from '../../src/model/skeleton/dofs.ts';
import type { Skeleton } from '../../src/model/skeleton/skeleton.ts';
import { oneSurface, type Skin } from '../../src/model/skin.ts';
import { finish, tube, weightOf } from '../evaluate/weights/meshes.ts';
import { character, documentOf, joint } from '../helpers/builders.ts';
import { characterOf } from '../teaching/lesson-files.ts';

/** Sums of weights that are 1 to the last bit or so, times lengths of a few units. */
const STILL = 1e-12;

/** Three joints up the y axis, two units apart, from a root at this height. */
function arm(height: number): Skeleton {
  const up = (parent: number, at: Vec3, length: number) =>
    joint(parent, { name: `j${parent + 1}`, offset: at, length });
  return { name: 'arm', joints: [up(-1, [0, height, 0], 2), up(0, [0, 2, 0], 2), up(1, [0, 2, 0], 2)] };
}

/** A sleeve from y 0 to 6. */
function sleeve(more: Partial<Skin> = {}): Skin {
  const mesh = tube({ around: 8, along: 12, radius: 0.5, length: 6 });
  const surfaces = oneSurface(mesh.triangles);
  return { name: 'sleeve', ...mesh, surfaces, bindings: new Float64Array(0), ...more };
}

function dressed(skeleton: Skeleton, skin: Skin, pose = filePose(skeleton, 0)): Character {
  return character({ skeleton, skins: [skin], pose });
}

/** x y z of every vertex, as drawn. */
function drawn(who: Character): Float64Array {
  const [skin] = who.skins;
  const compiled = compileSkin(skin);
  const dofs = new Float64Array(dofCountOf(who));
  poseAt(who, 0, dofs);
  const { skeleton } = who;
  if (!skeleton) throw new Error('no skeleton');
  const world = new Float64Array(16 * skeleton.joints.length);
  worldMatrices(compileSkeleton(skeleton), dofs, world);
  skinMatrices(compiled, world, compiled.matrices);
  const [positions, normals] = [skin.positions.slice(), compiled.normals.slice()];
  deform(compiled, world, skin.positions, compiled.normals, positions, normals);
  return positions;
}

const most = (a: Float64Array, b: Float64Array) => a.reduce((worst, x, i) => Math.max(worst, Math.abs(x - b[i])), 0);

function weighted(who: Character, args: Partial<Parameters<typeof autoWeights.run>[1]> = {}): Character {
  return autoWeights.run(documentOf(who), { characterId: who.id, timeSeconds: 0, ...args }).characters[0];
}

describe('automatic weights', () => {
  it('make a skin follow its joints, and can be undone', () => {
    const store = new Store(documentOf(dressed(arm(0), sleeve())));
    const before = store.document;
    store.apply(autoWeights, { characterId: 'c1', timeSeconds: 0 });
    const [skin] = store.document.characters[0].skins;
    const { attachments } = skin;
    if (!attachments) throw new Error('no weights');
    // The first ring, and the last.
    expect(weightOf(attachments, 0, 0)).toBeGreaterThan(0.9);
    expect(weightOf(attachments, 8 * 12, 2)).toBeGreaterThan(0.9);
    expect(store.undoLabel).toBe('Automatic weights of sleeve');
    store.undo();
    expect(store.document).toBe(before);
    store.redo();
    expect(store.document.characters[0].skins[0]).toBe(skin);
  });

  it('move nothing at the moment at which they are bound, however the skeleton is posed', () => {
    const skeleton = arm(0);
    const pose = [0, 0, 0, 0.1, 0.4, 0, 0.2, 0, -0.3, 0, 0, 0.5];
    const who = dressed(skeleton, sleeve(), pose);
    expect(most(drawn(weighted(who, { bind: 'drawn' })), drawn(who))).toBeLessThan(STILL);
    // As in the file: the mesh, too, and the root no longer turns it.
    expect(most(drawn(weighted(who, { bind: 'file' })), who.skins[0].positions)).toBeLessThan(STILL);
  });

  it('automatic weights keep existing bindings, and the skin in place in the binding pose', () => {
    const skeleton = arm(0);
    const bound = weighted(dressed(skeleton, sleeve()));
    const [{ bindings, positions }] = bound.skins;
    const bent = { ...bound, pose: [0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 1] };
    expect(bindPlaces(bent, bent.skins[0], 0)).toEqual(['bound', 'file']);
    const again = weighted(bent, { mostInfluences: 1 });
    expect(again.skins[0].bindings).toBe(bindings);
    expect(again.skins[0].attachments?.weights.every((w) => w === 1)).toBe(true);
    expect(most(drawn({ ...again, pose: filePose(skeleton, 0) }), positions)).toBeLessThan(STILL);
  });

  it('know whether a skin without bindings fits as drawn or as in its file', () => {
    // Hung on a root at y 10, a mesh that is modelled around y 10 is drawn far over the skeleton.
    const high = sleeve();
    const raised = { ...high, positions: high.positions.map((x, i) => (i % 3 === 1 ? x + 10 : x)) };
    expect(bindPlaces(dressed(arm(10), raised), raised, 0)[0]).toBe('file');
    expect(bindPlaces(dressed(arm(10), high), high, 0)[0]).toBe('drawn');
    const lifted = weighted(dressed(arm(10), raised));
    expect(most(drawn(lifted), raised.positions)).toBeLessThan(STILL);
  });

  it('automatic weights change nothing the second time', () => {
    const document = documentOf(weighted(dressed(arm(0), sleeve())));
    expect(autoWeights.run(document, { characterId: 'c1', timeSeconds: 0 })).toBe(document);
  });

  it('tell which joints move nothing, and of those without a bone nothing', () => {
    const { joints } = arm(0);
    const aside = joint(0, { name: 'aside', offset: [9, 0, 0], length: 1 });
    // Its child coincides with it, and has the bone.
    const hinge = joint(0, { name: 'hinge', offset: [0, 2, 0] });
    const [root, ...others] = joints;
    const skeleton: Skeleton = {
      name: 'arm',
      joints: [root, aside, hinge, { ...others[0], parent: 2, offset: [0, 0, 0] }, { ...others[1], parent: 3 }],
    };
    const idleOf = (who: Character) => {
      const steps = autoWeightsSteps(documentOf(who), { characterId: 'c1', timeSeconds: 0 });
      return finish(steps).idle;
    };
    expect(idleOf(dressed(skeleton, sleeve()))).toEqual([1]);
    expect(idleOf(dressed(arm(0), sleeve()))).toEqual([]);
  });

  it('automatic weights are written with their bindings, and read back identically', () => {
    const [skin] = weighted(dressed(arm(0), sleeve())).skins;
    const { value } = readSkin(writeSkin(skin).text, 'sleeve.skin');
    expect(value?.attachments).toEqual(skin.attachments);
    expect(value?.bindings).toEqual(skin.bindings);
  });

  it('automatic weights are refused where there is nothing to do it with', () => {
    const run =
      (who: Character, args = {}) =>
      () =>
        weighted(who, args);
    expect(run(character({ skins: [] }))).toThrow(CommandError);
    const { skeleton: _, ...bare } = dressed(arm(0), sleeve());
    expect(run(bare)).toThrow('no skeleton');
    expect(run(dressed(arm(0), sleeve()), { skin: 3 })).toThrow('no skin number 3');
    expect(run(dressed(arm(0), sleeve()), { mostInfluences: 0 })).toThrow('a whole number from 1');
    expect(run(dressed(arm(0), sleeve()), { mostInfluences: 17 })).toThrow('1 to 16');
    expect(run(dressed(arm(0), sleeve()), { bind: 'bound' })).toThrow('bindings for all joints');
    const flat = joint(-1, { motion: { kind: 'scale', mode: 'uniform', axis: [0, 1, 0] }, pose: [0], name: 'flat' });
    expect(run(dressed({ name: 'flat', joints: [flat] }, sleeve()), { bind: 'file' })).toThrow('scaled to zero');
  });
});

describe('automatic weights of the walker', () => {
  const { skeleton, skins } = characterOf('walker.skel', 'walker.skin');
  const [skin] = skins;
  if (!skeleton || !skin?.attachments) throw new Error('no walker');
  const found = weighted(dressed(skeleton, skin)).skins[0].attachments;
  const made = skin.attachments;

  it('automatic weights of the walker are near what was painted by hand', () => {
    if (!found) throw new Error('no weights');
    const count = skin.positions.length / 3;
    let moved = 0;
    for (let v = 0; v < count; v++) {
      for (let j = 0; j < skeleton.joints.length; j++)
        moved += Math.abs(weightOf(found, v, j) - weightOf(made, v, j)) / 2;
    }
    // Of all weight, on other joints: blends are wider, and a hat's hem is not known to be the head's.
    expect(moved / count).toBeLessThan(0.32);
  });

  it('automatic weights of the walker keep left and right apart: no vertex of one leg or arm follows the other’s', () => {
    if (!found) throw new Error('no weights');
    const side = (j: number) => ({ _l: 1, _r: -1 })[skeleton.joints[j].name.slice(-2)] ?? 0;
    const isLimb = (j: number) => /^(forearm|hand|shin|foot|toe)/.test(skeleton.joints[j].name);
    for (let v = 0; v + 1 < made.start.length; v++) {
      const own = made.joints.subarray(made.start[v], made.start[v + 1]);
      if (!own.every(isLimb)) continue;
      for (let a = found.start[v]; a < found.start[v + 1]; a++) {
        expect(side(found.joints[a]) * side(own[0])).toBeGreaterThanOrEqual(0);
      }
    }
  });
});
