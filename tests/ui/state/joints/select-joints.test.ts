import { expect, it } from 'vitest';
import { reselect } from '../../../../src/ui/state/joints/select-joints.ts';
import { character, documentOf, skeleton, workbench } from '../../builders.ts';

it('what a cancelled drag had deselected is selected again, unless it is gone', () => {
  const bones = skeleton(['hips', -1], ['leg', 0]);
  const { wb } = workbench(documentOf(character({ skeleton: bones })));
  const { store } = wb;
  const other = { characterId: 'c1', joint: 0 };
  for (const before of [{}, { characterId: 'c1' }, { characterId: 'c1', joint: 1, placement: 0 }]) {
    store.select(other);
    reselect(wb, before);
    expect(store.selection).toBe(before);
  }
  for (const gone of [{ characterId: 'c2' }, { characterId: 'c1', joint: 2 }]) {
    store.select(other);
    reselect(wb, gone);
    expect(store.selection).toBe(other);
  }
});
