import { describe, expect, it } from 'vitest';
import { CommandError } from '../../src/edit/command-error.ts';
import { setHidden, setPositionChannels, setSpace } from '../../src/edit/commands/spaces.ts';
import { setInterpolation } from '../../src/edit/commands/take.ts';
import { Store } from '../../src/edit/store.ts';
import { capturedContent } from '../../src/files/captured.ts';
import { openFiles } from '../../src/files/open/open-files.ts';
import { EMPTY_DOCUMENT } from '../../src/model/document.ts';
import type { ParsedFile } from '../../src/model/files.ts';
import { jointDofCount } from '../../src/model/skeleton/dofs.ts';
import { positionsTaken } from '../../src/model/skeleton/position-channels.ts';
import type { Space } from '../../src/model/space.ts';
import { BVH_ROOT, takeOfRows as frames, person } from '../evaluate/retarget/people.ts';
import { character, documentOf, takeOfValues } from '../helpers/builders.ts';
import { captured, personSkeleton, takeOfRoots } from '../helpers/mocap.ts';

const SPACE: Space = { up: 'z', unit: 'inches', lift: 0.25 };

function bvh(name: string, ...roots: readonly (readonly [number, number, number])[]): ParsedFile {
  const skeleton = { ...personSkeleton(), name };
  const captures = roots.map((root, i) => ({
    skeleton: { ...skeleton, name: i ? `${name}${i}` : name },
    take: { ...takeOfRoots(skeleton, [root]), name: i ? `${name}${i}` : name },
  }));
  const source = { name: `${name}.bvh`, path: `${name}.bvh`, bytes: 1 };
  return { ...capturedContent(captures, source.name).value, source };
}

describe('a character of motion capture that is opened', () => {
  it('a character of motion capture that is opened is upright, in metres, on the ground', () => {
    const { document } = openFiles(EMPTY_DOCUMENT, [bvh('walk', [0, 185, 0])]);
    expect(document.characters[0].space).toEqual({ up: 'y', unit: 'centimetres', lift: -1, known: 'guessed' });
  });

  it('a character of motion capture that is opened keeps the space that it was given when its file is opened again', () => {
    const { document } = openFiles(EMPTY_DOCUMENT, [bvh('walk', [0, 85, 0])]);
    const store = new Store(document);
    store.apply(setSpace, { characterId: document.characters[0].id, space: SPACE });
    const again = openFiles(store.document, [bvh('walk', [0, 85, 0])]).document;
    expect(again.characters).toHaveLength(1);
    expect(again.characters[0].space).toEqual(SPACE);
  });

  it('a character of motion capture that is opened is placed beside the others in one row, wherever it is in its file', () => {
    const files = [bvh('a', [0, 85, 0]), bvh('b', [400, 85, 900]), bvh('c', [-70, 85, -300])];
    const { characters } = openFiles(EMPTY_DOCUMENT, files).document;
    const feet = characters.map(({ placements: [{ position }] }, i) => [
      position[0] + [0, 4, -0.7][i],
      position[2] + [0, 9, -3][i],
    ]);
    expect(feet[1][0]).toBeGreaterThan(feet[0][0] + 0.2);
    expect(feet[2][0]).toBeGreaterThan(feet[1][0] + 0.2);
    expect(feet[2][0]).toBeLessThan(2);
    for (const [, z] of feet) expect(z).toBeCloseTo(0, 9);
  });

  it('a character of motion capture that is opened keeps its place to the others of its file', () => {
    const { characters } = openFiles(EMPTY_DOCUMENT, [bvh('pair', [0, 85, 0], [60, 95, 0])]).document;
    expect(characters).toHaveLength(2);
    expect(characters[1].placements).toEqual(characters[0].placements);
    expect(characters[1].space).toEqual(characters[0].space);
  });

  it('adds its position channels to the offsets where they look meant so, and says so', () => {
    const skeleton = personSkeleton({ positionsEverywhere: true });
    const captures = [{ skeleton, take: takeOfRoots(skeleton, [[0, 85, 0]], 0) }];
    const { value, diagnostics } = capturedContent(captures, 'made.bvh');
    expect(diagnostics.map((d) => d.code)).toEqual(['positions-near-zero']);
    const [opened] = openFiles(EMPTY_DOCUMENT, [{ ...value, source: { name: 'made.bvh', path: 'made.bvh', bytes: 1 } }])
      .document.characters;
    expect(opened.skeleton && positionsTaken(opened.skeleton)).toBe('add');
    // Measured as it is meant: not collapsed.
    const plain = capturedContent([{ skeleton, take: takeOfRoots(skeleton, [[0, 85, 0]]) }], '').value;
    expect(opened.space).toEqual(plain.guessed?.space);
  });
});

/** A person in centimetres whose hips are that high: standing, or lying on the back. */
function session(name: string, hips: number, lies: boolean): ParsedFile {
  const body = person({ size: 100, motion: (part) => (part === 'hips' ? BVH_ROOT : { kind: 'ball', order: 'xyz' }) });
  const skeleton = { ...body, name };
  const row = new Array<number>(jointDofCount(skeleton)).fill(0);
  row.splice(0, 6, 0, hips, 0, 0, lies ? -Math.PI / 2 : 0, 0);
  const source = { name: `${name}.bvh`, path: `${name}.bvh`, bytes: 1 };
  return { ...capturedContent([{ skeleton, take: frames(skeleton, [row, row]) }], source.name).value, source };
}

describe('takes of one skeleton', () => {
  it('takes of one skeleton that are opened together share the space of the one that stands', () => {
    const files = [session('lies', 30, true), session('walks', 87, false), session('falls', 200, true)];
    const { characters } = openFiles(EMPTY_DOCUMENT, files).document;
    expect(characters.map((c) => c.name)).toEqual(['lies', 'walks', 'falls']);
    for (const { space } of characters)
      expect(space).toEqual({ up: 'y', unit: 'centimetres', lift: 0, known: 'guessed' });
  });

  it('takes of one skeleton that are opened later have the space that was set by hand', () => {
    const store = new Store(openFiles(EMPTY_DOCUMENT, [session('walks', 87, false)]).document);
    store.apply(setSpace, { characterId: 'c1', space: SPACE });
    const { characters } = openFiles(store.document, [session('lies', 12, true), bvh('other', [0, 85, 0])]).document;
    expect(characters[1].space).toEqual(SPACE);
    expect(characters[2].space).not.toEqual(SPACE);
  });

  it('takes of one skeleton get another space all at once, in one step, and others don’t', () => {
    const files = [session('lies', 30, true), session('walks', 87, false), bvh('other', [0, 85, 0])];
    const store = new Store(openFiles(EMPTY_DOCUMENT, files).document);
    const before = store.document;
    store.apply(setSpace, { characterId: 'c2', space: SPACE, ofSkeleton: true });
    expect(store.undoLabel).toBe('Set space of walks and 1 more');
    const spaces = store.document.characters.map((c) => c.space);
    expect(spaces).toEqual([SPACE, SPACE, before.characters[2].space]);
    const { document } = store;
    store.apply(setSpace, { characterId: 'c1', space: SPACE, ofSkeleton: true });
    expect(store.document).toBe(document);
    store.undo();
    expect(store.document).toBe(before);
    store.apply(setSpace, { characterId: 'c2', space: SPACE });
    expect(store.document.characters[0]).toBe(before.characters[0]);
  });
});

describe('the space of a character', () => {
  it('the space of a character is set, and undone', () => {
    const store = new Store(documentOf(character()));
    store.apply(setSpace, { characterId: 'c1', space: SPACE });
    expect(store.document.characters[0].space).toEqual(SPACE);
    const { document } = store;
    store.apply(setSpace, { characterId: 'c1', space: { ...SPACE } });
    expect(store.document).toBe(document);
    store.undo();
    expect(store.document.characters[0].space).toBeUndefined();
  });

  it.each([
    { ...SPACE, up: 'x' },
    { ...SPACE, unit: 'ells' },
    { ...SPACE, lift: Number.NaN },
    { ...SPACE, unit: 'own' },
    { ...SPACE, unit: 'own', metres: 0 },
  ])('the space of a character refuses what is none: %o', (space) => {
    const store = new Store(documentOf(character()));
    // As a script may say it.
    expect(() => store.apply(setSpace, { characterId: 'c1', space: space as Space })).toThrow(CommandError);
  });
});

describe('position channels of a character', () => {
  it('position channels of a character have another meaning, and the character is on the ground again', () => {
    const skeleton = personSkeleton({ positionsEverywhere: true });
    const space: Space = { up: 'y', unit: 'centimetres', lift: 0 };
    const store = new Store(documentOf(captured(skeleton, takeOfRoots(skeleton, [[0, 85, 0]]), { space })));
    store.apply(setPositionChannels, { characterId: 'c1', positions: 'add' });
    const [{ skeleton: after, space: lifted, takes }] = store.document.characters;
    expect(after?.joints[1].motion).toMatchObject({ positions: 'add' });
    // Every bone counts twice, so the soles are as much lower as the legs are longer.
    expect(lifted?.lift).toBeCloseTo(0.765 - 0.0, 1);
    expect(takes[0].samples?.values).toBe(store.document.characters[0].takes[0].samples?.values);
    store.undo();
    expect(store.document.characters[0].skeleton).toEqual(skeleton);
  });

  it('position channels of a character are refused if there are none', () => {
    const store = new Store(documentOf(character()));
    expect(() => store.apply(setPositionChannels, { characterId: 'c1', positions: 'add' })).toThrow(CommandError);
  });
});

describe('hidden characters', () => {
  it('hidden characters can be several at once, and are shown as before', () => {
    const one = character();
    const two = character({ id: 'c2' });
    const store = new Store(documentOf(one, two));
    store.apply(setHidden, { ids: ['c1', 'c2'], hidden: true });
    expect(store.document.characters.map((c) => c.isHidden)).toEqual([true, true]);
    store.apply(setHidden, { ids: ['c2'], hidden: false });
    expect(store.document.characters[1]).toMatchObject(two);
    const { document } = store;
    store.apply(setHidden, { ids: ['c2'], hidden: false });
    expect(store.document).toBe(document);
  });

  it('hidden characters refuse unknown ids', () => {
    const store = new Store(documentOf(character()));
    expect(() => store.apply(setHidden, { ids: ['c9'], hidden: true })).toThrow(CommandError);
  });
});

describe('what a take plays between frames', () => {
  it('what a take plays between frames is set for its samples, whose values stay', () => {
    const skeleton = personSkeleton();
    const store = new Store(documentOf(captured(skeleton, takeOfRoots(skeleton, [[0, 85, 0]]))));
    store.apply(setInterpolation, { characterId: 'c1', interpolation: 'nearest' });
    expect(store.document.characters[0].takes[0].samples?.interpolation).toBe('nearest');
    store.undo();
    expect(store.document.characters[0].takes[0].samples?.interpolation).toBe('linear');
  });

  it('what a take plays between frames is the keys’ own if there are only keys', () => {
    const store = new Store(documentOf(character({ takes: [takeOfValues('walk', [0])], shownTake: 0 })));
    expect(() => store.apply(setInterpolation, { characterId: 'c1', interpolation: 'cubic' })).toThrow(CommandError);
  });
});
