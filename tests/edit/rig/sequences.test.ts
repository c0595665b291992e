/** Whatever is done to a rig, in whatever order: what comes of it is sound, can be saved, and can be undone. */
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { CommandError, Store } from '../../../src/edit/store.ts';
import { dofCountOf, poseAt } from '../../../src/evaluate/pose.ts';
import { readSkel } from '../../../src/formats/skel/read.ts';
import { writeSkel } from '../../../src/formats/skel/write.ts';
import { readSkin } from '../../../src/formats/skin/read.ts';
import { writeSkin } from '../../../src/formats/skin/write.ts';
import { couplesOf } from '../../../src/model/couples.ts';
import type { Character, Document } from '../../../src/model/document.ts';
import { dofsOf, type Skeleton } from '../../../src/model/skeleton.ts';
import { bindingCount, type Skin } from '../../../src/model/skin.ts';
import { diceOf, jointDofs, RIG_COMMANDS, randomDocument, rigArguments, rigCommand, seeds } from './random-rig.ts';

const steps = fc.array(fc.tuple(fc.constantFrom(...RIG_COMMANDS), seeds), { minLength: 1, maxLength: 12 });

/** Refusals are fine: they leave everything as it was. */
function perform(store: Store, id: (typeof RIG_COMMANDS)[number], seed: number): void {
  const before = store.document;
  try {
    store.apply(rigCommand(id), rigArguments(id, before.characters[0], diceOf(seed)));
  } catch (error) {
    if (!(error instanceof CommandError)) throw error;
    expect(store.document).toBe(before);
  }
}

/** As `expect`, but it may be asked ten thousand times. */
function must(holds: boolean, what: string): void {
  if (!holds) throw new Error(what);
}

function allFinite(values: ArrayLike<number>): boolean {
  return Array.prototype.every.call(values, Number.isFinite);
}

function expectSoundSkeleton({ joints }: Skeleton): void {
  const open: number[] = [];
  joints.forEach(({ parent, motion, limits, pose, couples = [] }, j) => {
    while (open.length && open.at(-1) !== parent) open.pop();
    must((open.at(-1) ?? -1) === parent, `joint ${j} stands in pre-order`);
    must((j === 0) === (parent === -1), `joint ${j} is the root or has a parent`);
    open.push(j);
    const names = dofsOf(motion).map(({ name }) => name);
    must(
      limits.length === names.length && pose.length === names.length,
      `joint ${j} has limits and a pose for its DOFs`,
    );
    must(allFinite(pose), `the file pose of joint ${j} is finite`);
    const order = couples.map(({ dof }) => names.indexOf(dof));
    must(
      order.every((at, i) => at > (order[i - 1] ?? -1)),
      `couples of joint ${j} are in the order of its DOFs`,
    );
    for (const { joint, follows } of couples) {
      must(
        dofsOf(joints[joint].motion).some(({ name }) => name === follows),
        `a couple of joint ${j} follows a DOF`,
      );
    }
  });
  must(couplesOf({ name: '', joints }).circular.length === 0, 'couples go nowhere round');
}

function expectSoundSkin(skin: Skin, joints: number): void {
  const bound = bindingCount(skin);
  must(skin.bindings.length % 16 === 0 && bound <= joints, 'there is a binding a joint at most');
  must(allFinite(skin.bindings) && allFinite(skin.positions), 'the skin is finite');
  const { attachments } = skin;
  if (!attachments) return;
  const { start, joints: owners, weights } = attachments;
  must(owners.length === weights.length && start.at(-1) === owners.length, 'attachments have weights');
  must(
    owners.every((owner) => owner < bound),
    'attachments are of joints that are bound',
  );
}

function expectSound(character: Character): void {
  const { skeleton, skins, clips, pose, poses = [], unkeyed, ik, morphs } = character;
  if (!skeleton) throw new Error('no skeleton');
  expectSoundSkeleton(skeleton);
  const joints = skeleton.joints.length;
  const dofs = jointDofs(skeleton) + morphs.length;
  for (const skin of skins) expectSoundSkin(skin, joints);
  must(pose.length === dofs, 'the pose has a value for each DOF');
  for (const { values } of poses) must(values.length === dofs, 'a named pose has a value for each DOF');
  for (const { channels, samples } of clips) {
    // The channels made up are one more than there are DOFs at most.
    must(channels.length <= dofs + 1, 'there are channels for the DOFs');
    if (!samples) continue;
    const width = samples.scales.length;
    must(samples.values.length === samples.frameCount * width, 'rows have all columns');
    must(samples.firstChannel >= 0 && samples.firstChannel + width <= channels.length, 'columns drive channels');
    must(allFinite(samples.values), 'samples are finite');
  }
  if (unkeyed) {
    must(unkeyed.dofs.length === unkeyed.values.length && unkeyed.dofs.length > 0, 'what is set by hand has values');
    must(
      unkeyed.dofs.every((dof, i) => dof > (unkeyed.dofs[i - 1] ?? -1) && dof < dofs),
      'what is set by hand ascends',
    );
  }
  for (const { joint } of [...(ik?.pins ?? []), ...(ik?.stiff ?? [])]) must(joint < joints, 'pins hold joints');
  const shown = new Float64Array(dofCountOf(character));
  poseAt(character, 0.25, shown);
  must(allFinite(shown), 'the pose shown is finite');
}

function expectSoundDocument({ characters: [hero, bee] }: Document): void {
  expectSound(hero);
  const { driver } = bee ?? {};
  if (!driver) return;
  must(driver.source.skeleton === hero.skeleton, 'who follows has the skeleton');
  must(
    driver.pairs.every(({ source }) => source < driver.source.skeleton.joints.length),
    'pairs are of joints that are there',
  );
}

describe('any sequence of rig commands', () => {
  it('leaves skeleton, skins, clips, poses, pins and pairs sound', () => {
    fc.assert(
      fc.property(seeds, steps, (seed, all) => {
        const store = new Store(randomDocument(seed));
        for (const [id, dice] of all) {
          perform(store, id, dice);
          expectSoundDocument(store.document);
        }
        const { selection } = store;
        const { skeleton } = store.document.characters[0];
        if (selection.joint !== undefined) expect(selection.joint).toBeLessThan(skeleton?.joints.length ?? 0);
      }),
      { numRuns: 60 },
    );
  });

  it('is undone to the very document that was there, step by step', () => {
    fc.assert(
      fc.property(seeds, steps, (seed, all) => {
        const store = new Store(randomDocument(seed));
        const past = [store.document];
        for (const [id, dice] of all) {
          perform(store, id, dice);
          if (store.document !== past.at(-1)) past.push(store.document);
        }
        for (const before of past.slice(0, -1).reverse()) {
          expect(store.undo()).toBe(true);
          expect(store.document).toBe(before);
        }
        expect(store.undo()).toBe(false);
      }),
      { numRuns: 40 },
    );
  });

  it('can be saved as .skel and .skin, and reads back the same', () => {
    fc.assert(
      fc.property(seeds, steps, (seed, all) => {
        const store = new Store(randomDocument(seed));
        for (const [id, dice] of all) perform(store, id, dice);
        const [{ skeleton, skins }] = store.document.characters;
        if (!skeleton) throw new Error('no skeleton');
        if (skeleton.joints.every(({ motion }) => motion.kind !== 'bvh')) {
          // No `.skel` has End Sites, which joints that were BVH's may have, and no name with a blank or a brace in it.
          const named = skeleton.joints.map(({ endSites: _none, name, ...joint }) => ({
            ...joint,
            name: name.replace(/[^a-z\d_]/gi, '_'),
          }));
          const { value } = readSkel(writeSkel([{ ...skeleton, joints: named }], 'hero.skel').text, 'hero.skel');
          expect(value).toEqual([{ ...skeleton, joints: named }]);
        }
        for (const skin of skins) {
          const read = readSkin(writeSkin(skin, 'x.skin').text, 'x.skin');
          expect(read.diagnostics.filter(({ severity }) => severity === 'error')).toEqual([]);
          expect(read.value).toEqual({ ...skin, name: 'x' });
        }
      }),
      { numRuns: 40 },
    );
  });
});
