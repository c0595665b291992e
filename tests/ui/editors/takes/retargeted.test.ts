import { describe, expect, it } from 'vitest';
import { bakeRetarget, clearRetarget, setRetarget } from '../../../../src/edit/commands/retarget.ts';
import { showTakes } from '../../../../src/edit/commands/takes.ts';
import { RETARGETED } from '../../../../src/edit/drivers.ts';
import { type Character, findCharacter } from '../../../../src/model/document.ts';
import { filePose, jointDofCount } from '../../../../src/model/skeleton/dofs.ts';
import { compareEntries } from '../../../../src/ui/editors/takes/compare-menu.ts';
import {
  farthestPair,
  jointLabels,
  leftOutEntries,
  worstSeconds,
} from '../../../../src/ui/editors/takes/joint-labels.ts';
import { Measuring } from '../../../../src/ui/editors/takes/measuring.ts';
import { listOfTakes, playAlone, removeTakeRows, startAt } from '../../../../src/ui/editors/takes/play.ts';
import { compareTakes } from '../../../../src/ui/editors/takes/start-comparison.ts';
import { followSelection, takesToCompare } from '../../../../src/ui/editors/takes/which-takes.ts';
import { findAction, isEnabled, runAction, tryAction } from '../../../../src/ui/state/actions/action.ts';
import { comparedIn, drawnDocument, playedName } from '../../../../src/ui/state/takes.ts';
import { person, takeOfRows } from '../../../evaluate/retarget/people.ts';
import { character, documentOf } from '../../../helpers/builders.ts';
import { workbench } from '../../builders.ts';

/** A person who stands at x, under names of their own. */
function captured(id: string, x: number, names: (part: string) => string): Character {
  const skeleton = person({ names });
  const row = [x, 0.9, 0, ...new Array<number>(jointDofCount(skeleton) - 3).fill(0)];
  const take = { ...takeOfRows(skeleton, [row, row, row]), name: id };
  return character({ id, name: id, skeleton, pose: filePose(skeleton, 0), takes: [take], shownTake: 0 });
}

function bench() {
  const { wb } = workbench(
    documentOf(
      captured('boxer', 0, (part) => part),
      captured('dancer', 2, (part) => part.toUpperCase()),
    ),
  );
  const measuring = new Measuring(wb);
  const row = (key: string) => {
    const found = listOfTakes(wb).find((r) => r.key === key);
    if (!found) throw new Error(`there is no row ${key}`);
    return found;
  };
  const compared = () => comparedIn(wb.store.document, wb.timeline.takes.comparison.get());
  /** The mean distance once it is measured. */
  const measured = () =>
    new Promise<number | undefined>((resolve) => {
      const stop = measuring.result.subscribe((result) => {
        stop();
        resolve(result?.distances?.mean[0]);
      });
    });
  const retarget = () => wb.store.apply(setRetarget, { characterId: 'boxer', sourceId: 'dancer' });
  return { wb, measuring, row, compared, measured, retarget };
}

const LIVE = `boxer/${RETARGETED}`;

describe('a retargeted take in the list', () => {
  it('a retargeted take has a row of its own in the list, while its character’s own take is hidden', () => {
    const { wb, retarget } = bench();
    retarget();
    expect(listOfTakes(wb).map(({ key, name, note, isShown }) => [key, name, note, isShown])).toEqual([
      ['boxer/0', 'boxer', '', false],
      [LIVE, 'dancer', 'retargeted to boxer', true],
      ['dancer/0', 'dancer', 'drives boxer', true],
    ]);
  });

  it('a retargeted take plays alone, starts at a time, and is removed by ending the retargeting', () => {
    const { wb, row, retarget } = bench();
    retarget();
    playAlone(wb, row(LIVE));
    const boxer = () => findCharacter(wb.store.document, 'boxer');
    expect([boxer()?.driver === undefined, boxer()?.isHidden ?? false]).toEqual([false, false]);
    expect(findCharacter(wb.store.document, 'dancer')?.isHidden).toBe(true);
    startAt(wb, row(LIVE), 1.5);
    expect(row(LIVE).startSeconds).toBe(1.5);
    // Nothing is retargeted to the dancer.
    expect(() => wb.store.apply(showTakes, { takes: [{ characterId: 'dancer', take: RETARGETED }] })).toThrow('take');
    removeTakeRows(wb, [row(LIVE)]);
    expect(boxer()?.driver).toBeUndefined();
    expect(boxer()?.takes).toHaveLength(1);
  });

  it('a character’s selected take stays selected when another one is retargeted or baked into it', () => {
    const { wb, retarget } = bench();
    followSelection(wb);
    wb.timeline.takes.change({ chosen: new Set(['boxer/0']), focused: 'boxer/0' });
    retarget();
    expect([...wb.timeline.takes.view.get().chosen]).toEqual([LIVE]);
    wb.store.apply(bakeRetarget, { characterId: 'boxer' });
    expect([...wb.timeline.takes.view.get().chosen]).toEqual(['boxer/1']);
    wb.store.undo();
    expect([...wb.timeline.takes.view.get().chosen]).toEqual([LIVE]);
  });
});

it('what deselects everything deselects takes too', () => {
  const { wb } = bench();
  followSelection(wb);
  wb.store.select({ characterId: 'boxer' });
  wb.timeline.takes.change({ chosen: new Set(['boxer/0', 'dancer/0']), focused: 'boxer/0' });
  wb.store.select({});
  expect([...wb.timeline.takes.view.get().chosen]).toEqual([]);
});

describe('comparing after retargeting', () => {
  it('the retargeted take and its source are compared without further choice', async () => {
    const { wb, measuring, measured, compared, retarget } = bench();
    retarget();
    const pair = takesToCompare(wb);
    expect(pair?.map(({ key }) => key)).toEqual([LIVE, 'dancer/0']);
    if (pair) compareTakes(wb, ...pair);
    const mean = measured();
    measuring.setVisible(true);
    expect(await mean).toBeLessThan(0.01);
    expect(measuring.result.get()?.match.first).toHaveLength(21);
    expect(compared()?.map(({ character: c }) => playedName(c))).toEqual(['dancer on boxer', 'dancer']);
  });

  it('the retargeted take is compared with its character’s own one, whichever is chosen first', async () => {
    for (const order of [
      [LIVE, 'boxer/0'],
      ['boxer/0', LIVE],
    ]) {
      const { wb, measuring, measured, compared, row, retarget } = bench();
      retarget();
      compareTakes(wb, row(order[0]), row(order[1]));
      const mean = measured();
      measuring.setVisible(true);
      expect(await mean).toBeCloseTo(2, 1);
      expect(compared()?.map(({ character: c }) => playedName(c))).toEqual(['dancer on boxer', 'boxer']);
      const drawn = drawnDocument(wb.store.document, wb.timeline.takes.comparison.get()).characters;
      expect(drawn.filter((c) => !c.isHidden).map(({ name }) => name)).toEqual(['dancer', 'boxer']);
    }
  });

  it('its own take is still compared with another character’s, and the retargeting is restored afterwards', () => {
    const { wb, row, compared, retarget } = bench();
    retarget();
    compareTakes(wb, row('boxer/0'), row('dancer/0'));
    expect(compared()?.map(({ character: c }) => playedName(c))).toEqual(['boxer', 'dancer']);
    wb.store.undo();
    expect(findCharacter(wb.store.document, 'boxer')?.driver).toBeDefined();
  });

  it('takes of rigs with other names are compared at once, and the menu tells how many joints', () => {
    const { wb, row } = bench();
    expect(compareEntries(wb, row('boxer/0'))).toMatchObject([
      {},
      { kind: 'item', label: 'dancer', detail: '21 joints in common', enabled: true },
    ]);
    compareTakes(wb, row('boxer/0'), row('dancer/0'));
    expect(wb.timeline.takes.comparison.get()).toBeDefined();
    expect(wb.messages.passing.get()).toBe('21 joints are compared, matched by name and body part.');
    runAction(wb, 'take.compare');
    expect(wb.messages.passing.get()).toBeUndefined();
  });

  it('takes that lie over each other are not put side by side', () => {
    const { wb, row } = bench();
    const sideBySide = findAction(wb, 'take.put.grid');
    if (!sideBySide) throw new Error('there is no such action');
    compareTakes(wb, row('boxer/0'), row('dancer/0'));
    const { document } = wb.store;
    tryAction(wb, sideBySide);
    expect(wb.store.document).toBe(document);
    expect(sideBySide.refuses?.(wb)).toContain('Stop comparing first');
    runAction(wb, 'take.compare');
    expect(isEnabled(wb, sideBySide)).toBe(true);
  });

  it('each compared joint tells its partner and when both are farthest apart, and each other one why it is left out', async () => {
    const { wb, measuring, measured, row } = bench();
    const [boxer, dancer] = wb.store.document.characters;
    const { skeleton } = dancer;
    if (!skeleton) throw new Error('the dancer has a skeleton');
    const tail = { ...skeleton.joints[4], name: 'TAIL', parent: 0 };
    const longer = { ...dancer, skeleton: { ...skeleton, joints: [...skeleton.joints, tail] } };
    wb.store.replace('x', { document: documentOf(boxer, longer) });
    compareTakes(wb, row('boxer/0'), row('dancer/0'));
    const mean = measured();
    measuring.setVisible(true);
    await mean;
    const result = measuring.result.get();
    if (!result?.distances) throw new Error('nothing was measured');
    expect(jointLabels(result, result.distances)[7]).toEqual({
      name: 'left forearm',
      partner: 'LEFT FOREARM',
      tooltip: 'left forearm and LEFT FOREARM: left forearm, same name',
      worst: 'At 0 s. Click to go there',
    });
    expect(worstSeconds(result.distances, farthestPair(result.distances))).toBe(0);
    const entries = leftOutEntries(wb, result);
    expect(entries).toMatchObject([
      { kind: 'note', text: 'Not compared of dancer' },
      { kind: 'item', label: 'TAIL', detail: 'boxer has no matching joint' },
    ]);
    if (entries[1].kind === 'item') entries[1].run();
    expect(wb.store.selection).toEqual({ characterId: 'dancer', joint: 21 });
  });

  it('a comparison follows its characters when one is retargeted, baked, or released, and undo', async () => {
    const { wb, measuring, measured, compared, row, retarget } = bench();
    compareTakes(wb, row('boxer/0'), row('dancer/0'));
    let mean = measured();
    measuring.setVisible(true);
    expect(await mean).toBeCloseTo(2, 6);
    mean = measured();
    retarget();
    expect(await mean).toBeLessThan(0.01);
    mean = measured();
    wb.store.apply(bakeRetarget, { characterId: 'boxer' });
    expect(await mean).toBeLessThan(0.01);
    expect(compared()?.map(({ character: c }) => c.shownTake)).toEqual([1, 0]);
    mean = measured();
    wb.store.undo();
    expect(await mean).toBeLessThan(0.01);
    mean = measured();
    wb.store.apply(clearRetarget, { characterId: 'boxer' });
    expect(await mean).toBeCloseTo(2, 6);
  });

  it('a comparison of one character’s takes ends when both are the same', () => {
    const { wb, compared, row, retarget } = bench();
    retarget();
    compareTakes(wb, row(LIVE), row('boxer/0'));
    expect(compared()).toBeDefined();
    wb.store.apply(clearRetarget, { characterId: 'boxer' });
    expect(compared()).toBeUndefined();
  });
});
