import { expect, it } from 'vitest';
import { removeTake } from '../../../../src/edit/commands/take.ts';
import { takeRows } from '../../../../src/ui/editors/takes/rows.ts';
import { compareTakes } from '../../../../src/ui/editors/takes/start-comparison.ts';
import { character, documentOf, skeleton, take, workbench } from '../../builders.ts';

it('two takes of one character stay compared when an earlier take is removed, and when it comes back', () => {
  const takes = ['first', 'second', 'third'].map((name) => ({ ...take([0, 1]), name }));
  const hero = character({ skeleton: skeleton(['hips', -1], ['leg', 0]), takes, shownTake: 1 });
  const { wb } = workbench(documentOf(hero));
  const rows = takeRows(wb.store.document);
  compareTakes(wb, rows[1], rows[2]);
  const names = () => {
    const comparison = wb.timeline.takes.comparison.get();
    return comparison && wb.store.document.characters[0].takes[comparison.second.take]?.name;
  };
  expect(names()).toBe('third');
  wb.store.apply(removeTake, { characterId: hero.id, take: 0 });
  expect(names()).toBe('third');
  wb.store.undo();
  expect(names()).toBe('third');
});
