/** Sizes and places of takes that are compared: comparable meanwhile, and as before afterwards. */
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { CommandError } from '../../src/edit/command-error.ts';
import { ALL_COMMANDS } from '../../src/edit/commands/all.ts';
import { sameHeight } from '../../src/edit/commands/heights.ts';
import { endOverlay, overlayTakes } from '../../src/edit/commands/takes.ts';
import { ownHeight } from '../../src/edit/same-height.ts';
import { Store } from '../../src/edit/store.ts';
import { capturedContent } from '../../src/files/captured.ts';
import { openFiles } from '../../src/files/open/open-files.ts';
import {
  type Character,
  DEFAULT_PLACEMENT,
  type Document,
  EMPTY_DOCUMENT,
  findCharacter,
} from '../../src/model/document.ts';
import type { Space } from '../../src/model/space.ts';
import { character, documentOf, joint, takeOfValues } from '../helpers/builders.ts';
import { sharedCaptures } from '../helpers/bvh-files.ts';
import { personSkeleton, takeOfRoots } from '../helpers/mocap.ts';
import { describeShared } from '../helpers/shared.ts';
import { anyCommand, argumentsFor } from './any-command.ts';
import { Dice, thrown } from './dice.ts';

const NO_BOX = { min: [0, 0, 0], max: [0, 0, 0] } as const;

/** A post of that height; its joints are named after it. */
function post(id: string, height: number, more: Partial<Character> = {}): Character {
  const at = (y: number) => ({ offset: [0, y, 0] as const, box: NO_BOX });
  const joints = [joint(-1, { name: id, ...at(0) }), joint(0, { name: `${id} top`, ...at(height) })];
  const takes = [takeOfValues(`${id}_walk`, Array(9).fill(0.3))];
  return character({ id, name: id, skeleton: { name: id, joints }, takes, shownTake: 0, ...more });
}

const at = (x: number, scale = 1): Partial<Character> => ({
  placements: [{ ...DEFAULT_PLACEMENT, position: [x, 0, 0], scale }],
});

const refs = ({ characters }: Document, first = 0, second = 1) => ({
  first: { characterId: characters[first].id, take: 0 },
  second: { characterId: characters[second].id, take: 0 },
});

const heights = ({ characters }: Document) => characters.map((c) => c.placements[0].scale * ownHeight(c));
const end = (now: Document, before: Document, overlaid: Document) =>
  endOverlay.run(now, { before: before.characters, overlaid: overlaid.characters });

const captured: Document = openFiles(
  EMPTY_DOCUMENT,
  [170, 180].map((height, i) => {
    const skeleton = { ...personSkeleton({ height }), name: `actor${i}` };
    const source = { name: `actor${i}.bvh`, path: `actor${i}.bvh`, bytes: 1 };
    const captures = [{ skeleton, take: { ...takeOfRoots(skeleton, [[0, 85, 0]]), name: `walk${i}` } }];
    return { ...capturedContent(captures, source.name).value, source };
  }),
).document;

describe('takes that are overlaid', () => {
  it('takes of other actors lie in the place of the first and keep their own sizes', () => {
    const space: Space = { up: 'y', unit: 'metres', lift: 0 };
    const before = documentOf(post('a', 1.6, { ...at(1), space }), post('b', 1.9, { ...at(5, 0.5), space }));
    const after = overlayTakes.run(before, refs(before));
    expect(after.characters[1].placements[0]).toEqual({ ...DEFAULT_PLACEMENT, position: [1, 0, 0], scale: 0.5 });
  });

  it('takes of one actor in one unit share the guessed unit, ground and scale', () => {
    const [a, b] = captured.characters;
    const inches: Character = { ...b, ...at(4, 2), space: { up: 'y', unit: 'inches', lift: 1 } };
    const before = { ...captured, characters: [a, { ...inches, skeleton: a.skeleton }] as Character[] };
    const after = overlayTakes.run(before, refs(before));
    expect(after.characters[1].space).toEqual(a.space);
    expect(after.characters[1].placements[0]).toEqual(a.placements[0]);
  });

  it('a character of unknown unit that is far taller than the first, or far smaller, becomes as tall', () => {
    for (const height of [0.1, 40]) {
      const before = documentOf(post('a', 1.7, at(1)), post('b', height, at(5)));
      const [first, second] = heights(overlayTakes.run(before, refs(before)));
      expect(second).toBeCloseTo(first, 9);
    }
    const near = documentOf(post('a', 1.7, at(1)), post('b', 2, at(5)));
    expect(heights(overlayTakes.run(near, refs(near)))[1]).toBe(heights(near)[1]);
  });

  it('same height while takes are overlaid is taken back with them, for both', () => {
    for (const [first, second] of [
      [0, 1],
      [1, 0],
    ]) {
      const before = documentOf(post('a', 0.1, at(1)), post('b', 40, at(5)), post('c', 3, at(9)));
      const overlaid = overlayTakes.run(before, refs(before, first, second));
      for (const like of ['a', 'b', 'c']) {
        const scaled = sameHeight.run(overlaid, { characterIds: ['a', 'b', 'c'], like });
        expect(end(scaled, before, overlaid)).toEqual(before);
      }
    }
  });

  it('whatever is done meanwhile, ending an overlay gives every character its place and size from before', () => {
    const before: Document = {
      ...documentOf(post('a', 1.7, at(1)), post('b', 40, at(5, 2)), post('c', 3, { ...at(9), isHidden: true })),
      charactersMade: 3,
    };
    const step = fc.tuple(
      fc.oneof(
        anyCommand,
        fc.constantFrom('characters.sameHeight', 'characters.ownHeights', 'takes.arrange', 'character.place'),
      ),
      thrown,
    );
    fc.assert(
      fc.property(fc.array(step, { maxLength: 8 }), fc.boolean(), (steps, turned) => {
        const overlaid = overlayTakes.run(before, turned ? refs(before, 1, 0) : refs(before));
        const store = new Store(overlaid);
        for (const [id, dice] of steps) run(store, id, new Dice(dice));
        const after = end(store.document, before, overlaid);
        for (const { id, placements } of before.characters) {
          const now = findCharacter(after, id);
          if (now) expect(now.placements[0]).toEqual(placements[0]);
        }
        if (store.document === overlaid) expect(after).toEqual(before);
      }),
      { numRuns: 60 },
    );
  });
});

function run(store: Store, id: string, dice: Dice): void {
  const command = ALL_COMMANDS.get(id);
  if (!command || store.document.characters.length === 0) return;
  try {
    const args = argumentsFor(id, store, dice);
    // Made for this command, by its id.
    if (args) store.apply(command, args as never);
  } catch (error) {
    if (!(error instanceof CommandError)) throw error;
  }
}

describeShared('real takes that are overlaid', () => {
  it('real captures of two actors, in other units, are both as tall as a person while overlaid', () => {
    const files = ['boxing-extra-line', 'cmu-01_01'].map((name) => ({
      ...capturedContent(sharedCaptures(`${name}.bvh`), name).value,
      source: { name: `${name}.bvh`, path: `${name}.bvh`, bytes: 1 },
    }));
    const { document } = openFiles(EMPTY_DOCUMENT, files);
    for (const [first, second] of [
      [0, 1],
      [1, 0],
    ]) {
      const overlaid = overlayTakes.run(document, refs(document, first, second));
      expect(heights(overlaid)).toEqual(heights(document));
      for (const height of heights(overlaid)) {
        expect(height).toBeGreaterThan(1.2);
        expect(height).toBeLessThan(2.2);
      }
      expect(overlaid.characters[second].space).toEqual(document.characters[second].space);
      expect(end(overlaid, document, overlaid)).toEqual(document);
    }
  });
});
