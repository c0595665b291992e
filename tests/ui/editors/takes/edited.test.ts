import { describe, expect, it } from 'vitest';
import { setRetarget } from '../../../../src/edit/commands/retarget.ts';
import { outlineRows } from '../../../../src/ui/editors/outliner/outline-rows.ts';
import { takeEntries } from '../../../../src/ui/editors/outliner/row-menu.ts';
import { takesToEdit, takesToInsert, takesToJoin } from '../../../../src/ui/editors/takes/edited.ts';
import { takeKey } from '../../../../src/ui/editors/takes/rows.ts';
import { timeEntries } from '../../../../src/ui/editors/timeline/time-menu.ts';
import { actionLabel, findAction, isEnabled, reasonNot } from '../../../../src/ui/state/actions/action.ts';
import { menuEntries } from '../../../../src/ui/state/actions/menu-entries.ts';
import type { MenuEntry } from '../../../../src/ui/widgets/menu.ts';
import { sliding } from '../../../edit/hold/sliding.ts';
import { character, documentOf, take, workbench } from '../../builders.ts';

const ref = (take: number, characterId = 'c1') => ({ characterId, take });

describe('which takes are edited', () => {
  it('several selected takes are edited together, else the one that the current character plays', () => {
    const walker = character({ takes: [take([0, 1]), { ...take([0, 2]), name: 'run' }], shownTake: 1 });
    const { wb } = workbench(documentOf(walker));
    expect(takesToEdit(wb)).toEqual([ref(1)]);
    wb.timeline.takes.change({ chosen: new Set([takeKey(ref(0))]) });
    expect(takesToEdit(wb)).toEqual([ref(1)]);
    // In the list, the row that is clicked is meant.
    wb.timeline.change({ tab: 'takes' });
    expect(takesToEdit(wb)).toMatchObject([ref(0)]);
    wb.timeline.change({ tab: 'curves' });
    wb.timeline.takes.change({ chosen: new Set([takeKey(ref(0)), takeKey(ref(1))]) });
    expect(takesToEdit(wb).map(({ take: index }) => index)).toEqual([0, 1]);
  });

  it('what edits takes is found in the Edit menu, at a time, and at the shown take in the outliner', () => {
    const { wb } = workbench(documentOf(character({ takes: [take([0, 1]), { ...take([0, 2]), name: 'run' }] })));
    const tools = ['Mirror', 'Join…', 'Insert take or hold…', 'Cut out…', 'Make loop…', 'Lock feet…', 'Change speed…'];
    const rows = outlineRows(wb.store.document, () => true).filter(({ kind }) => kind === 'take');
    expect(rows.map(({ shown }) => shown)).toEqual([true, false]);
    const within = (entries: readonly MenuEntry[]) => {
      const found = entries.find((entry) => entry.kind === 'menu' && entry.label === 'Edit takes');
      if (found?.kind !== 'menu') return [];
      return found.entries().flatMap((entry) => (entry.kind === 'item' ? [entry.label] : []));
    };
    expect(within(menuEntries(wb, 'Edit'))).toEqual(expect.arrayContaining(tools));
    expect(within(timeEntries(wb, 0.5))).toEqual(expect.arrayContaining(tools));
    expect(within(takeEntries(wb, rows[0], () => undefined))).toEqual(expect.arrayContaining(tools));
    expect(within(takeEntries(wb, rows[1], () => undefined))).toEqual([]);
  });

  it('the greyed Make loop of curves leads to that of takes, and what is retargeted is changed, not retargeted anew', () => {
    const { wb } = workbench(documentOf({ ...sliding(0), id: 'a' }, { ...sliding(0), id: 'b' }));
    wb.store.select({ characterId: 'b' });
    const action = (id: string) => {
      const found = findAction(wb, id);
      if (!found) throw new Error(`There is no ${id}.`);
      return found;
    };
    expect(isEnabled(wb, action('timeline.loop'))).toBe(false);
    expect(reasonNot(wb, action('timeline.loop'))).toContain('Edit > Edit takes > Make loop');
    expect(isEnabled(wb, action('take.loopTake'))).toBe(true);
    expect(actionLabel(wb, action('retarget.open'))).toBe('Retarget take…');
    wb.store.apply(setRetarget, { characterId: 'b', sourceId: 'a' });
    expect(actionLabel(wb, action('retarget.open'))).toBe('Change retargeting…');
    expect(isEnabled(wb, action('take.checkTake'))).toBe(true);
  });

  it('the only two takes are joined without being selected, and all but the current can be inserted into it', () => {
    const walker = character({ takes: [take([0, 1]), { ...take([0, 2]), name: 'run' }], shownTake: 1 });
    const { wb } = workbench(documentOf(walker));
    expect(takesToJoin(wb).map(({ take: index }) => index)).toEqual([0, 1]);
    expect(takesToInsert(wb).map(({ take: index }) => index)).toEqual([0]);
    expect(takesToJoin(workbench(documentOf(character({ takes: [take([0, 1])] }))).wb)).toEqual([]);
  });
});
