import { describe, expect, it } from 'vitest';
import { followRange } from '../../../../src/app/follow-range.ts';
import { renameCharacter } from '../../../../src/edit/commands/characters.ts';
import { type Character, DEFAULT_PLACEMENT } from '../../../../src/model/document.ts';
import { characterIdOf } from '../../../../src/model/drawn-id.ts';
import type { Samples } from '../../../../src/model/takes/samples.ts';
import {
  chosenTakes,
  listOfTakes,
  playTogether,
  removeTakeRows,
  startAt,
  toggleShown,
} from '../../../../src/ui/editors/takes/play.ts';
import { compareTakes } from '../../../../src/ui/editors/takes/start-comparison.ts';
import { findAction, isEnabled, runAction, tryAction } from '../../../../src/ui/state/actions/action.ts';
import { comparedIn, drawnDocument } from '../../../../src/ui/state/takes.ts';
import { character, documentOf, skeleton, takeOfValues } from '../../../helpers/builders.ts';
import { workbench } from '../../builders.ts';

function take(id: string, range: readonly [number, number], more: Partial<Character> = {}): Character {
  const sources = [{ name: `${id}.bvh`, path: `${id}.bvh`, bytes: 1 }];
  return character({ id, name: id, takes: [takeOfValues(id, [0], range)], shownTake: 0, sources, ...more });
}

const framesOf = (frameCount: number, frameSeconds: number): Samples => ({
  frameCount,
  frameSeconds,
  startSeconds: 0,
  firstChannel: 0,
  values: new Float64Array(frameCount),
  scales: Float64Array.of(1),
  interpolation: 'linear',
});

function bench(...more: Character[]) {
  const made = workbench(documentOf(take('a', [0, 1]), take('b', [0, 2]), take('c', [1, 4]), ...more));
  followRange(made.wb.store, made.wb.transport);
  const seen = () => made.wb.store.document.characters.filter((c) => !c.isHidden).map((c) => c.id);
  return { ...made, seen };
}

describe('the next take', () => {
  it('the next take of the list plays alone, over its own range from its start', () => {
    const { wb, seen, revealed } = bench();
    wb.transport.update((p) => ({ ...p, timeSeconds: 3, playing: true }));
    runAction(wb, 'take.next');
    expect(seen()).toEqual(['a']);
    runAction(wb, 'take.next');
    runAction(wb, 'take.next');
    expect(seen()).toEqual(['c']);
    expect(wb.transport.get()).toMatchObject({ range: [1, 4], timeSeconds: 1, playing: true });
    expect(wb.store.selection.characterId).toBe('c');
    expect(revealed.at(-1)).toBe('c');
  });

  it('follows the order and filter of the list, cyclically', () => {
    const { wb, seen } = bench();
    wb.timeline.takes.change({ order: { column: 'duration', descending: true } });
    runAction(wb, 'take.next');
    runAction(wb, 'take.previous');
    expect(seen()).toEqual(['a']);
    runAction(wb, 'take.next');
    expect(seen()).toEqual(['c']);
  });

  it('the next take uses its own frame rate, and stops on a frame', () => {
    const frames = { ...takeOfValues('d', [], [0, 1]), samples: framesOf(101, 0.01) };
    const { wb } = bench(take('d', [0, 1], { takes: [frames] }));
    runAction(wb, 'take.previous');
    expect(wb.transport.get()).toMatchObject({ range: [0, 1], framesPerSecond: 100 });
    wb.transport.update((p) => ({ ...p, timeSeconds: 0.2537, playing: true }));
    runAction(wb, 'play.toggle');
    expect(wb.transport.get()).toMatchObject({ timeSeconds: 0.25, playing: false });
    runAction(wb, 'take.next');
    expect(wb.transport.get().framesPerSecond).toBe(100);
    wb.transport.update((p) => ({ ...p, timeSeconds: 0.2537, playing: true }));
    wb.timeline.change({ snapsToFrames: false });
    runAction(wb, 'play.toggle');
    // A take with few keys has no frames.
    expect(wb.transport.get().timeSeconds).toBe(0.2537);
  });

  it('neither pauses nor starts playback', () => {
    const { wb } = bench();
    runAction(wb, 'take.next');
    expect(wb.transport.get().playing).toBe(false);
  });

  it('the next take keeps the selected joint if the next character has it', () => {
    const other = take('d', [0, 1], { skeleton: { ...skeleton(3), joints: skeleton(3).joints.slice(0, 2) } });
    const { wb } = bench(other);
    wb.store.select({ characterId: 'c', joint: 1 });
    runAction(wb, 'take.next');
    expect(wb.store.selection).toEqual({ characterId: 'd', joint: 1 });
  });

  it('the next take plays at its offset', () => {
    const { wb } = bench();
    wb.store.replace('x', {
      document: documentOf(take('a', [0, 1], { timeOffsetSeconds: 0.25 })),
    });
    runAction(wb, 'take.next');
    expect(wb.transport.get().range).toEqual([-0.25, 0.75]);
  });
});

describe('chosen takes', () => {
  it('selected takes play together, over all their time', () => {
    const { wb, seen } = bench();
    wb.timeline.takes.change({ chosen: new Set(['a/0', 'c/0']) });
    playTogether(wb, chosenTakes(wb));
    expect(seen()).toEqual(['a', 'c']);
    expect(wb.transport.get().range).toEqual([0, 4]);
    expect(wb.store.undoLabel).toBe('Play 2 takes together');
    runAction(wb, 'take.showAll');
    expect(seen()).toEqual(['a', 'b', 'c']);
  });

  it('a take starts at a given time, in seconds of the transport', () => {
    const { wb } = bench();
    startAt(wb, listOfTakes(wb)[2], 1.5);
    expect(wb.store.document.characters[2].timeOffsetSeconds).toBe(-0.5);
    expect(listOfTakes(wb)[2].startSeconds).toBe(1.5);
    startAt(wb, listOfTakes(wb)[0], 0);
    expect(wb.store.document.characters[0].timeOffsetSeconds).toBe(0);
  });

  it('selected takes are hidden by a key of the list, and shown again by it', () => {
    const { wb, seen } = bench();
    wb.timeline.takes.change({ chosen: new Set(['a/0', 'c/0']), focused: 'c/0' });
    runAction(wb, 'take.toggleShown');
    expect(seen()).toEqual(['b']);
    runAction(wb, 'take.toggleShown');
    expect(seen()).toEqual(['a', 'b', 'c']);
    wb.timeline.takes.change({ focused: 'b/0' });
    runAction(wb, 'take.toggleShown');
    expect(seen()).toEqual(['a', 'c']);
  });

  it('takes are hidden and shown one by one', () => {
    const { wb, seen } = bench();
    toggleShown(wb, listOfTakes(wb)[1]);
    expect(seen()).toEqual(['a', 'c']);
    toggleShown(wb, listOfTakes(wb)[1]);
    expect(seen()).toEqual(['a', 'b', 'c']);
  });

  it('selected takes are removed, and the next one is focused', () => {
    const { wb } = bench();
    const rows = listOfTakes(wb);
    removeTakeRows(wb, [rows[0], rows[1]]);
    expect(listOfTakes(wb).map((r) => r.name)).toEqual(['c']);
    expect(wb.timeline.takes.view.get().focused).toBe('c/0');
    removeTakeRows(wb, listOfTakes(wb));
    expect(wb.timeline.takes.view.get()).not.toHaveProperty('focused');
  });
});

describe('two takes that are compared', () => {
  it('only the two compared takes are visible, in their common time', () => {
    const { wb, seen } = bench();
    const rows = listOfTakes(wb);
    compareTakes(wb, rows[1], rows[2]);
    expect(seen()).toEqual(['b', 'c']);
    expect(wb.transport.get().range).toEqual([1, 2]);
    expect(wb.timeline.view.get().tab).toBe('takes');
    const compared = comparedIn(wb.store.document, wb.timeline.takes.comparison.get());
    expect(compared?.map((c) => c.drawnAs)).toEqual(['b', 'c']);
    runAction(wb, 'take.compare');
    expect(wb.timeline.takes.comparison.get()).toBeUndefined();
  });

  it('compared takes are restored afterwards, without a step of its own', () => {
    const { wb } = bench(take('d', [0, 1], { placements: [{ ...DEFAULT_PLACEMENT, position: [5, 0, 0] }] }));
    const before = wb.store.document;
    wb.transport.update((p) => ({ ...p, range: [0.25, 3] }));
    const rows = listOfTakes(wb);
    compareTakes(wb, rows[0], rows[3]);
    expect(wb.store.document).not.toBe(before);
    runAction(wb, 'take.compare');
    expect(wb.store.document).toBe(before);
    expect(wb.transport.get().range).toEqual([0.25, 3]);
    expect([wb.store.undoLabel, wb.store.redoLabel]).toEqual([undefined, 'Compare a with d']);
  });

  it('heights are left alone while takes are compared, with a sentence', () => {
    const { wb } = bench();
    const rows = listOfTakes(wb);
    for (const id of ['edit.sameHeight', 'edit.ownHeights']) {
      compareTakes(wb, rows[0], rows[1]);
      const { document } = wb.store;
      const action = findAction(wb, id);
      if (action) tryAction(wb, action);
      expect(wb.store.document).toBe(document);
      expect(action?.refuses?.(wb)).toContain('Stop comparing first');
      runAction(wb, 'take.compare');
      expect(action && isEnabled(wb, action)).toBe(true);
    }
  });

  it('undo ends a comparison, and redo restores it', () => {
    const { wb } = bench();
    runAction(wb, 'play.wholeRange');
    const before = wb.store.document;
    const rows = listOfTakes(wb);
    compareTakes(wb, rows[0], rows[1]);
    const comparison = wb.timeline.takes.comparison.get();
    const { range } = wb.transport.get();
    wb.store.undo();
    expect(wb.timeline.takes.comparison.get()).toBeUndefined();
    expect(wb.store.document).toBe(before);
    expect(wb.transport.get().range).toEqual([0, 4]);
    wb.store.redo();
    expect(wb.timeline.takes.comparison.get()).toBe(comparison);
    expect(wb.transport.get().range).toEqual(range);
  });

  it('ending a comparison after other changes is a step of its own, which can be undone', () => {
    const { wb, seen } = bench();
    runAction(wb, 'play.wholeRange');
    const rows = listOfTakes(wb);
    compareTakes(wb, rows[0], rows[1]);
    const comparison = wb.timeline.takes.comparison.get();
    wb.store.apply(renameCharacter, { characterId: 'a', name: 'mine' });
    runAction(wb, 'take.compare');
    expect(wb.store.undoLabel).toBe('Stop comparing a and b');
    expect(seen()).toEqual(['a', 'b', 'c']);
    expect(wb.store.document.characters[0].name).toBe('mine');
    expect(wb.transport.get().range).toEqual([0, 4]);
    wb.store.undo();
    expect(wb.timeline.takes.comparison.get()).toBe(comparison);
    expect(seen()).toEqual(['a', 'b']);
    wb.store.redo();
    expect(wb.timeline.takes.comparison.get()).toBeUndefined();
    expect(seen()).toEqual(['a', 'b', 'c']);
  });

  it('a comparison ends before another take plays alone, or two others are compared', () => {
    const { wb, seen } = bench();
    const rows = listOfTakes(wb);
    const places = () => wb.store.document.characters.map((c) => c.placements[0]);
    const before = places();
    compareTakes(wb, rows[0], rows[1]);
    compareTakes(wb, rows[1], rows[2]);
    runAction(wb, 'take.next');
    expect(wb.timeline.takes.comparison.get()).toBeUndefined();
    expect(seen()).toHaveLength(1);
    expect(places()).toEqual(before);
    expect(wb.store.undoLabel).toMatch(/^Play . alone$/);
  });

  it('two takes of one character are drawn as two, and picked as the one', () => {
    const twice = take('d', [0, 1], { takes: [takeOfValues('x', [0]), takeOfValues('y', [1])] });
    const { wb } = bench(twice);
    const rows = listOfTakes(wb).filter((r) => r.characterId === 'd');
    compareTakes(wb, rows[0], rows[1]);
    const comparison = wb.timeline.takes.comparison.get();
    const drawn = drawnDocument(wb.store.document, comparison).characters.filter((c) => !c.isHidden);
    expect(drawn.map((c) => c.shownTake)).toEqual([0, 1]);
    expect(new Set(drawn.map((c) => c.id)).size).toBe(2);
    expect(drawn.map((c) => characterIdOf(c.id))).toEqual(['d', 'd']);
  });

  it('a comparison ends when one of its takes is removed', () => {
    const { wb } = bench();
    const rows = listOfTakes(wb);
    compareTakes(wb, rows[0], rows[1]);
    removeTakeRows(wb, [rows[1]]);
    expect(comparedIn(wb.store.document, wb.timeline.takes.comparison.get())).toBeUndefined();
    expect(drawnDocument(wb.store.document, wb.timeline.takes.comparison.get())).toBe(wb.store.document);
  });

  it('takes without a joint in common are not compared', () => {
    const other = skeleton(2);
    const joints = other.joints.map((j) => ({ ...j, name: `other ${j.name}` }));
    const { wb, seen } = bench(take('d', [0, 1], { skeleton: { ...other, joints } }));
    const rows = listOfTakes(wb);
    compareTakes(wb, rows[0], rows[3]);
    expect(wb.timeline.takes.comparison.get()).toBeUndefined();
    expect(seen()).toHaveLength(4);
    expect(wb.messages.passing.get()).toContain('no joints in common');
  });
});
