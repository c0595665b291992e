import { describe, expect, it } from 'vitest';
import { CommandError } from '../../src/edit/command-error.ts';
import { setRetarget } from '../../src/edit/commands/retarget.ts';
import {
  alignStarts,
  arrange,
  endOverlay,
  overlayTakes,
  removeTakes,
  setTimeOffsets,
  showTakes,
} from '../../src/edit/commands/takes.ts';
import { Store } from '../../src/edit/store.ts';
import {
  type Character,
  DEFAULT_PLACEMENT,
  type Document,
  rangeOfTakes,
  startSeconds,
} from '../../src/model/document.ts';
import { NO_MARKS, UNMARKED } from '../../src/model/part.ts';
import { character, documentOf, skin, takeOfValues } from '../helpers/builders.ts';

/** A character with a take, as a file of captured motion is one. */
function take(id: string, range: readonly [number, number] = [0, 1], more: Partial<Character> = {}): Character {
  const source = { name: `${id}.bvh`, path: `${id}.bvh`, bytes: 1 };
  const mark = { ...UNMARKED, file: { kind: 'bvh', source, holds: id } } as const;
  const parts = { ...NO_MARKS, skeleton: mark, takes: [mark] };
  return character({
    id,
    name: id,
    takes: [takeOfValues(id, [0], range)],
    shownTake: 0,
    sources: [source],
    parts,
    ...more,
  });
}

const three = documentOf(take('a'), take('b', [0.5, 2]), take('c', [-1, 4]));
const hidden = (document: Document) => document.characters.map((c) => c.isHidden ?? false);
const places = (document: Document) => document.characters.map((c) => c.placements[0].position);

describe('takes that are shown', () => {
  it('alone are all that is seen, and the transport’s range is theirs', () => {
    const alone = showTakes.run(three, { takes: [{ characterId: 'b', take: 0 }], alone: true });
    expect(hidden(alone)).toEqual([true, false, true]);
    expect(rangeOfTakes(alone)).toEqual([0.5, 2]);
    expect(rangeOfTakes(three)).toEqual([-1, 4]);
  });

  it('takes that are shown keep the time of all takes where every character is hidden', () => {
    const none = { ...three, characters: three.characters.map((c) => ({ ...c, isHidden: true })) };
    expect(rangeOfTakes(none)).toEqual([-1, 4]);
  });

  it('beside others hide nothing, and show another take of their character', () => {
    const document = documentOf(
      take('a', [0, 1], { takes: [takeOfValues('x', [0]), takeOfValues('y', [0])], isHidden: true }),
      take('b'),
    );
    const next = showTakes.run(document, { takes: [{ characterId: 'a', take: 1 }] });
    expect(hidden(next)).toEqual([false, false]);
    expect(next.characters[0].shownTake).toBe(1);
    expect(next.characters[1]).toBe(document.characters[1]);
  });

  it('change nothing where they are shown already', () => {
    expect(showTakes.run(three, { takes: [{ characterId: 'a', take: 0 }] })).toBe(three);
  });

  it('takes that are shown are one of a character at a time', () => {
    const document = documentOf(take('a', [0, 1], { takes: [takeOfValues('x', [0]), takeOfValues('y', [0])] }));
    const both = [0, 1].map((c) => ({ characterId: 'a', take: c }));
    expect(() => showTakes.run(document, { takes: both })).toThrow(CommandError);
    expect(() => showTakes.run(document, { takes: [{ characterId: 'a', take: 2 }] })).toThrow('no take number 2');
  });

  it('takes that are shown are one step, whatever they hide, and undone to the identical document', () => {
    const store = new Store(three);
    store.apply(showTakes, { takes: [{ characterId: 'b', take: 0 }], alone: true });
    expect(store.undoLabel).toBe('Play b alone');
    store.undo();
    expect(store.document).toEqual(three);
    expect(store.undoLabel).toBeUndefined();
  });
});

describe('takes in time', () => {
  it('begin at one moment after their starts are aligned', () => {
    const next = alignStarts.run(three, { characterIds: ['a', 'b', 'c'] });
    expect(next.characters.map((c) => c.timeOffsetSeconds)).toEqual([0, 0.5, -1]);
    expect(next.characters[0]).toBe(three.characters[0]);
    expect(rangeOfTakes(next)).toEqual([0, 5]);
    const later = alignStarts.run(three, { characterIds: ['b'], atSeconds: 2 });
    expect(later.characters[1].timeOffsetSeconds).toBe(-1.5);
  });

  it('a take that is retargeted begins with the others, whether its source is aligned with it or not', () => {
    const [first, second] = three.characters;
    const retargeted = setRetarget.run(
      { ...three, characters: [first, { ...second, timeOffsetSeconds: 0.25 }] },
      { characterId: first.id, sourceId: second.id },
    );
    for (const characterIds of [[first.id], [first.id, second.id]]) {
      const store = new Store(retargeted);
      store.apply(alignStarts, { characterIds, atSeconds: 2 });
      expect(startSeconds(store.document.characters[0])).toBeCloseTo(2, 12);
    }
  });

  it('takes in time get one offset together', () => {
    const next = setTimeOffsets.run(three, { characterIds: ['a', 'c'], seconds: 0.25 });
    expect(next.characters.map((c) => c.timeOffsetSeconds)).toEqual([0.25, 0, 0.25]);
    expect(() => setTimeOffsets.run(three, { characterIds: [], seconds: 1 })).toThrow('Give at least one character.');
  });
});

describe('takes in space', () => {
  const ids = ['a', 'b', 'c'];
  /** Begins at x, z in its own coordinates. */
  const at = (id: string, x: number, z: number) => take(id, [0, 1], { takes: [takeOfValues(id, [x, 0, z])] });
  const spread = documentOf(at('a', 5, 1), at('b', -3, 0), at('c', 0, 0));

  it('takes are placed side by side in rows, no two in one place', () => {
    const next = arrange.run(spread, { characterIds: ids, how: 'grid' });
    const roots = next.characters.map((c, i) => {
      const [x, , z] = c.placements[0].position;
      return [x + [5, -3, 0][i], z + [1, 0, 0][i]];
    });
    expect(roots[0][0]).toBeCloseTo(-roots[1][0], 3);
    expect(roots[0][1]).toBeCloseTo(roots[1][1], 3);
    expect(roots[2][1]).toBeGreaterThan(roots[0][1]);
    expect(roots[1][0] - roots[0][0]).toBeGreaterThan(0.4);
  });

  it('begin on the spot where the first one does', () => {
    const next = arrange.run(spread, { characterIds: ids, how: 'spot' });
    expect(places(next)).toEqual([
      [0, 0, 0],
      [8, 0, 1],
      [5, 0, 1],
    ]);
    expect(next.characters[0]).toBe(spread.characters[0]);
  });

  it('share the first one’s coordinates', () => {
    const moved = documentOf(
      take('a', [0, 1], { placements: [{ ...DEFAULT_PLACEMENT, position: [1, 2, 3] }] }),
      take('b'),
    );
    expect(places(arrange.run(moved, { characterIds: ['a', 'b'], how: 'space' }))).toEqual([
      [1, 2, 3],
      [1, 2, 3],
    ]);
  });

  it('overlap when compared, and nothing else is visible', () => {
    const second = { ...DEFAULT_PLACEMENT, position: [4, 0, 0], turn: [0, 1, 0] } as const;
    const document = documentOf(take('a'), take('b', [0, 1], { placements: [second, second] }), take('c'));
    const next = overlayTakes.run(document, {
      first: { characterId: 'a', take: 0 },
      second: { characterId: 'b', take: 0 },
    });
    expect(hidden(next)).toEqual([false, false, true]);
    expect(next.characters[1].placements).toEqual([DEFAULT_PLACEMENT, second]);
  });

  it('takes in space lie on the same ground when they are compared, for that was a guess for each', () => {
    const on = (lift: number): Partial<Character> => ({ space: { up: 'y', unit: 'centimetres', lift } });
    const document = documentOf(take('a', [0, 1], on(0.2)), take('b', [0, 1], on(0.3)), take('c', [0, 1], on(0.4)));
    const next = overlayTakes.run(document, {
      first: { characterId: 'a', take: 0 },
      second: { characterId: 'b', take: 0 },
    });
    expect(next.characters.map((c) => c.space?.lift)).toEqual([0.2, 0.2, 0.4]);
  });

  it('comparing takes of one character shows the first on it', () => {
    const document = documentOf(
      take('a', [0, 1], { takes: [takeOfValues('x', [0]), takeOfValues('y', [0])] }),
      take('b'),
    );
    const next = overlayTakes.run(document, {
      first: { characterId: 'a', take: 1 },
      second: { characterId: 'a', take: 0 },
    });
    expect(next.characters[0].shownTake).toBe(1);
    expect(hidden(next)).toEqual([false, true]);
  });
});

describe('takes that were compared', () => {
  const at = (x: number, more: Partial<Character> = {}): Partial<Character> => ({
    placements: [{ ...DEFAULT_PLACEMENT, position: [x, 0, 0] }, DEFAULT_PLACEMENT],
    space: { up: 'y', unit: 'centimetres', lift: x },
    ...more,
  });
  const document = documentOf(
    take('a', [0, 1], at(1)),
    take('b', [0, 1], at(2)),
    take('c', [0, 1], at(3, { isHidden: true })),
    take('d', [0, 1], at(4, { takes: [takeOfValues('x', [0]), takeOfValues('y', [0])] })),
  );
  const laid = (...[first, second]: readonly [readonly [string, number], readonly [string, number]]) =>
    overlayTakes.run(document, {
      first: { characterId: first[0], take: first[1] },
      second: { characterId: second[0], take: second[1] },
    });
  const end = (now: Document, overlaid: Document) =>
    endOverlay.run(now, { before: document.characters, overlaid: overlaid.characters });

  it('takes that were compared return to their places, and the visibility is restored', () => {
    const overlaid = laid(['a', 0], ['b', 0]);
    expect(overlaid).not.toEqual(document);
    expect(end(overlaid, overlaid)).toEqual(document);
  });

  it('show the take that their character showed', () => {
    const overlaid = laid(['d', 1], ['d', 0]);
    expect(end(overlaid, overlaid)).toEqual(document);
  });

  it('takes that were compared keep other changes made meanwhile', () => {
    const overlaid = laid(['a', 0], ['b', 0]);
    const edited = {
      ...overlaid,
      characters: overlaid.characters
        .filter((c) => c.id !== 'd')
        .map((c) => {
          if (c.id === 'a') return { ...c, name: 'mine', takes: [takeOfValues('a', [0.5], [0, 3])] };
          if (c.id === 'b') return { ...c, placements: [{ ...DEFAULT_PLACEMENT, scale: 2 }], timeOffsetSeconds: 1 };
          return { ...c, isHidden: false };
        }),
    };
    const [a, b, c] = end(edited, overlaid).characters;
    expect(a).toBe(edited.characters[0]);
    // Sizes and places belong to the comparison.
    expect(b).toMatchObject({ placements: [{ scale: 1 }], timeOffsetSeconds: 1, space: { lift: 2 } });
    // It was hidden before as well, and someone has shown it since.
    expect(c.isHidden).toBe(false);
  });

  it('leave the shown take alone where takes came or went', () => {
    const overlaid = laid(['d', 1], ['d', 0]);
    const fewer = {
      ...overlaid,
      characters: overlaid.characters.map((c) =>
        c.id === 'd' ? { ...c, takes: [...c.takes, takeOfValues('z', [0])] } : c,
      ),
    };
    expect(end(fewer, overlaid).characters[3].shownTake).toBe(1);
  });
});

describe('takes that are removed', () => {
  const ref = (characterId: string, c: number) => ({ characterId, take: c });

  it('takes that are removed go with the character that is nothing but its motion', () => {
    const next = removeTakes.run(three, { takes: [ref('a', 0), ref('c', 0)] });
    expect(next.characters).toEqual([three.characters[1]]);
  });

  it('leave a character that is more than its motion', () => {
    const document = documentOf(take('a', [0, 1], { skins: [skin()] }));
    const next = removeTakes.run(document, { takes: [ref('a', 0)] });
    expect(next.characters[0]).toMatchObject({ takes: [], shownTake: -1 });
  });

  it('takes that are removed keep showing the same take, or show the one after it', () => {
    const takes = ['w', 'x', 'y', 'z'].map((name) => takeOfValues(name, [0]));
    const shown = (shownTake: number, ...gone: number[]) => {
      const document = documentOf(take('a', [0, 1], { takes, shownTake }));
      const [after] = removeTakes.run(document, { takes: gone.map((c) => ref('a', c)) }).characters;
      return after.takes[after.shownTake]?.name;
    };
    expect(shown(2, 0, 1)).toBe('y');
    expect(shown(1, 1)).toBe('y');
    expect(shown(3, 3)).toBe('y');
    expect(shown(1, 0, 1, 2)).toBe('z');
    expect(shown(-1, 0)).toBeUndefined();
  });
});
