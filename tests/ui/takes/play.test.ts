import { describe, expect, it } from 'vitest';
import { followRange } from '../../../src/app/follow-range.ts';
import type { Character } from '../../../src/model/document.ts';
import { runAction } from '../../../src/ui/actions.ts';
import {
  chosenTakes,
  compareTakes,
  listOfTakes,
  playTogether,
  remove,
  toggleShown,
} from '../../../src/ui/takes/play.ts';
import { comparedIn, drawnDocument, withoutTwin } from '../../../src/ui/takes/takes.ts';
import { character, clip, documentOf, skeleton } from '../../helpers/builders.ts';
import { workbench } from '../builders.ts';

function take(id: string, range: readonly [number, number], more: Partial<Character> = {}): Character {
  const sources = [{ name: `${id}.bvh`, path: `${id}.bvh`, bytes: 1 }];
  return character({ id, name: id, clips: [clip(id, [0], range)], shownClip: 0, sources, ...more });
}

function bench(...more: Character[]) {
  const made = workbench(documentOf(take('a', [0, 1]), take('b', [0, 2]), take('c', [1, 4]), ...more));
  followRange(made.wb.store, made.wb.transport);
  const seen = () => made.wb.store.document.characters.filter((c) => !c.isHidden).map((c) => c.id);
  return { ...made, seen };
}

describe('the next take', () => {
  it('of the list plays alone, over its own range from its start', () => {
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

  it('follows the order and the filter of the list, and past the last comes the first', () => {
    const { wb, seen } = bench();
    wb.timeline.takes.change({ order: { column: 'duration', descending: true } });
    runAction(wb, 'take.next');
    runAction(wb, 'take.previous');
    expect(seen()).toEqual(['a']);
    runAction(wb, 'take.next');
    expect(seen()).toEqual(['c']);
  });

  it('pauses nothing and starts nothing', () => {
    const { wb } = bench();
    runAction(wb, 'take.next');
    expect(wb.transport.get().playing).toBe(false);
  });

  it('keeps the selected joint where the next character has it', () => {
    const other = take('d', [0, 1], { skeleton: { ...skeleton(3), joints: skeleton(3).joints.slice(0, 2) } });
    const { wb } = bench(other);
    wb.store.select({ characterId: 'c', joint: 1 });
    runAction(wb, 'take.next');
    expect(wb.store.selection).toEqual({ characterId: 'd', joint: 1 });
  });

  it('is played at its offset', () => {
    const { wb } = bench();
    wb.store.replace('x', {
      document: documentOf(take('a', [0, 1], { timeOffsetSeconds: 0.25 })),
      selection: {},
    });
    runAction(wb, 'take.next');
    expect(wb.transport.get().range).toEqual([-0.25, 0.75]);
  });
});

describe('chosen takes', () => {
  it('play together, over all their time', () => {
    const { wb, seen } = bench();
    wb.timeline.takes.change({ chosen: new Set(['a/0', 'c/0']) });
    playTogether(wb, chosenTakes(wb));
    expect(seen()).toEqual(['a', 'c']);
    expect(wb.transport.get().range).toEqual([0, 4]);
    expect(wb.store.undoLabel).toBe('Play 2 takes together');
    runAction(wb, 'take.showAll');
    expect(seen()).toEqual(['a', 'b', 'c']);
  });

  it('are hidden and shown one by one', () => {
    const { wb, seen } = bench();
    toggleShown(wb, listOfTakes(wb)[1]);
    expect(seen()).toEqual(['a', 'c']);
    toggleShown(wb, listOfTakes(wb)[1]);
    expect(seen()).toEqual(['a', 'b', 'c']);
  });

  it('are removed, and the list goes on to the one after them', () => {
    const { wb } = bench();
    const rows = listOfTakes(wb);
    remove(wb, [rows[0], rows[1]]);
    expect(listOfTakes(wb).map((r) => r.name)).toEqual(['c']);
    expect(wb.timeline.takes.view.get().focused).toBe('c/0');
    remove(wb, listOfTakes(wb));
    expect(wb.timeline.takes.view.get()).not.toHaveProperty('focused');
  });
});

describe('two takes that are compared', () => {
  it('are all that is seen, in their common time', () => {
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

  it('of one character are drawn as two, and picked as the one', () => {
    const twice = take('d', [0, 1], { clips: [clip('x', [0]), clip('y', [1])] });
    const { wb } = bench(twice);
    const rows = listOfTakes(wb).filter((r) => r.characterId === 'd');
    compareTakes(wb, rows[0], rows[1]);
    const comparison = wb.timeline.takes.comparison.get();
    const drawn = drawnDocument(wb.store.document, comparison).characters.filter((c) => !c.isHidden);
    expect(drawn.map((c) => c.shownClip)).toEqual([0, 1]);
    expect(new Set(drawn.map((c) => c.id)).size).toBe(2);
    expect(drawn.map((c) => withoutTwin(c.id))).toEqual(['d', 'd']);
  });

  it('end with one of them', () => {
    const { wb } = bench();
    const rows = listOfTakes(wb);
    compareTakes(wb, rows[0], rows[1]);
    remove(wb, [rows[1]]);
    expect(comparedIn(wb.store.document, wb.timeline.takes.comparison.get())).toBeUndefined();
    expect(drawnDocument(wb.store.document, wb.timeline.takes.comparison.get())).toBe(wb.store.document);
  });

  it('are refused where they have no joint in common', () => {
    const other = skeleton(2);
    const joints = other.joints.map((j) => ({ ...j, name: `other ${j.name}` }));
    const { wb, seen } = bench(take('d', [0, 1], { skeleton: { ...other, joints } }));
    const rows = listOfTakes(wb);
    compareTakes(wb, rows[0], rows[3]);
    expect(wb.timeline.takes.comparison.get()).toBeUndefined();
    expect(seen()).toHaveLength(4);
    expect(wb.messages.list.get().at(-1)?.text).toContain('no joints in common');
  });
});
