import { beforeEach, describe, expect, it } from 'vitest';
import { removeCharacter } from '../../../../src/edit/commands/characters.ts';
import { setLimit } from '../../../../src/edit/commands/limits.ts';
import type { Character } from '../../../../src/model/document.ts';
import { channelsInView } from '../../../../src/ui/editors/timeline/current-take.ts';
import { followCharacter } from '../../../../src/ui/editors/timeline/follow-character.ts';
import { DEFAULT_TIMELINE_VIEW } from '../../../../src/ui/state/timeline.ts';
import type { Workbench } from '../../../../src/ui/state/workbench.ts';
import { channel, character, documentOf, skeleton, take, workbench } from '../../builders.ts';

let wb: Workbench;
const animated = (id: string, ...joints: (readonly [string, number])[]) =>
  character({ id, skeleton: skeleton(...joints), takes: [take([0, 1], channel(0, 1), channel(0, 1), channel(0, 1))] });
const wasp = animated('c1', ['thorax', -1], ['wing', 0]);
const crab = animated('c2', ['shell', -1]);
const picked = () => {
  const { pinned, hidden, isolated, unfolded } = wb.timeline.view.get();
  return { pinned, hidden, isolated, unfolded };
};
const NOTHING = { pinned: [], hidden: [], isolated: undefined, unfolded: [] };
/** As when files are reloaded. */
const become = (...characters: Character[]) => wb.store.replace('Reload', documentOf(...characters));

beforeEach(() => {
  ({ wb } = workbench(documentOf(wasp, crab)));
  followCharacter(wb);
  wb.timeline.change({ pinned: [2], hidden: [1], unfolded: [-1, 0] });
  wb.timeline.isolate([0]);
});

describe('what is picked out in the timeline', () => {
  it('pinned, hidden and isolated channels stay with their character', () => {
    const before = picked();
    wb.store.select({ characterId: 'c2' });
    expect(picked()).toEqual(NOTHING);
    expect(channelsInView(wb)).toEqual([0, 1, 2]);
    wb.timeline.change({ hidden: [0] });
    wb.store.select({ characterId: 'c1' });
    expect(picked()).toEqual(before);
    wb.store.select({ characterId: 'c2' });
    expect(picked()).toEqual({ ...NOTHING, hidden: [0] });
  });

  it('leaves everything else of the timeline alone', () => {
    wb.timeline.change({ list: 'all', snapsToFrames: false });
    wb.store.select({ characterId: 'c2' });
    expect(wb.timeline.view.get()).toMatchObject({ list: 'all', snapsToFrames: false });
  });

  it('pinned, hidden and isolated channels are dropped with a skeleton of other DOFs, shown or not, and kept if only limits change', () => {
    const before = picked();
    wb.store.apply(setLimit, { characterId: 'c1', dof: 4, min: -1, max: 1 });
    expect(picked()).toEqual(before);
    become({ ...wasp, skeleton: skeleton(['thorax', -1], ['leg', 0]) }, crab);
    expect(picked()).toEqual(NOTHING);

    wb.timeline.change({ hidden: [2] });
    wb.store.select({ characterId: 'c2' });
    become(wasp, crab);
    wb.store.select({ characterId: 'c1' });
    expect(picked()).toEqual(NOTHING);
  });

  it('pinned, hidden and isolated channels are restored with a character that was removed', () => {
    const before = picked();
    wb.store.apply(removeCharacter, { characterId: 'c1' });
    expect(picked()).toEqual(NOTHING);
    wb.store.undo();
    wb.store.select({ characterId: 'c1' });
    expect(picked()).toEqual(before);
  });

  it('what is picked out in the timeline is plain data; an earlier page’s, which had no names of characters, is taken over', () => {
    wb.store.select({ characterId: 'c2' });
    expect(structuredClone(wb.timeline.view.get())).toEqual(wb.timeline.view.get());
    const { characterId: _none, others: _neither, ...earlier } = wb.timeline.view.get();
    wb.timeline.view.set({ ...DEFAULT_TIMELINE_VIEW, ...earlier, hidden: [2] });
    wb.store.select({ characterId: 'c2', joint: 0 });
    expect(wb.timeline.view.get()).toMatchObject({ characterId: 'c2', hidden: [2] });
  });
});
