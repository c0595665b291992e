import { expect, it } from 'vitest';
import { removeClip } from '../../../../src/edit/commands/clips.ts';
import { takeRows } from '../../../../src/ui/editors/takes/rows.ts';
import { compareTakes } from '../../../../src/ui/editors/takes/start-comparison.ts';
import { character, clip, documentOf, skeleton, workbench } from '../../builders.ts';

it('two takes of one character stay compared when an earlier take is removed, and when it comes back', () => {
  const clips = ['first', 'second', 'third'].map((name) => ({ ...clip([0, 1]), name }));
  const hero = character({ skeleton: skeleton(['hips', -1], ['leg', 0]), clips, shownClip: 1 });
  const { wb } = workbench(documentOf(hero));
  const rows = takeRows(wb.store.document);
  compareTakes(wb, rows[1], rows[2]);
  const names = () => {
    const comparison = wb.timeline.takes.comparison.get();
    return comparison && wb.store.document.characters[0].clips[comparison.second.clip]?.name;
  };
  expect(names()).toBe('third');
  wb.store.apply(removeClip, { characterId: hero.id, clip: 0 });
  expect(names()).toBe('third');
  wb.store.undo();
  expect(names()).toBe('third');
});
