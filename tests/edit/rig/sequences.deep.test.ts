/** Any sequence of rigging commands gives a valid rig that can be saved, and can be undone. */
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { CommandError } from '../../../src/edit/command-error.ts';
import { Store } from '../../../src/edit/store.ts';
import { readSkel } from '../../../src/formats/skel/read.ts';
import { writeSkel } from '../../../src/formats/skel/write.ts';
import { readSkin } from '../../../src/formats/skin/read.ts';
import { writeSkin } from '../../../src/formats/skin/write.ts';
import { checkDocument, checkSelection } from '../../helpers/invariants.ts';
import { diceOf, RIG_COMMANDS, randomDocument, rigArguments, rigCommand, seeds } from './random-rig.ts';

const steps = fc.array(fc.tuple(fc.constantFrom(...RIG_COMMANDS), seeds), { minLength: 1, maxLength: 12 });

/** Refusals are fine: they change nothing. */
function perform(store: Store, id: (typeof RIG_COMMANDS)[number], seed: number): void {
  const before = store.document;
  try {
    store.apply(rigCommand(id), rigArguments(id, before.characters[0], diceOf(seed)));
  } catch (error) {
    if (!(error instanceof CommandError)) throw error;
    expect(store.document).toBe(before);
  }
}

/** Sound, and who follows the hero has its skeleton. */
function expectSound({ document, selection }: Store): void {
  checkDocument(document);
  checkSelection(document, selection);
  const [hero, bee] = document.characters;
  if (bee?.driver) expect(bee.driver.source.skeleton).toBe(hero.skeleton);
}

describe('any sequence of rig commands', () => {
  it('leaves skeleton, skins, takes, poses, pins and pairs sound', () => {
    fc.assert(
      fc.property(seeds, steps, (seed, all) => {
        const store = new Store(randomDocument(seed));
        for (const [id, dice] of all) {
          perform(store, id, dice);
          expectSound(store);
        }
      }),
      { numRuns: 30 },
    );
  });

  it('any sequence of rig commands is undone to the very document that was there, step by step', () => {
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
      { numRuns: 20 },
    );
  });

  it('any sequence of rig commands can be saved as .skel and .skin, and reads back the same', () => {
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
      { numRuns: 20 },
    );
  });
});
