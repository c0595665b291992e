import { describe, expect, it } from 'vitest';
import { character, documentOf, skeleton, workbench } from '../../builders.ts';

describe('adding joints', () => {
  it('adding joints starts at the root if none is selected', async () => {
    const { RIG_ACTIONS } = await import('../../../../src/ui/editors/rig/actions.ts');
    const add = RIG_ACTIONS.find(({ id }) => id === 'rigging.addJoints');
    const { wb } = workbench(documentOf(character({ skeleton: skeleton(['root', -1], ['leg', 0]) })));
    expect(add?.refuses?.(wb)).toBe('Switch to rig mode first.');
    wb.posing.mode.set('rig');
    expect(add?.refuses?.(wb)).toBeUndefined();
    add?.run(wb);
    expect(wb.store.selection).toEqual({ characterId: 'c1', joint: 0 });
    add?.run(wb);
    wb.store.select({ characterId: 'c1', joint: 1 });
    add?.run(wb);
    expect(wb.store.selection.joint).toBe(1);
    expect(wb.posing.rig.adding.get()).toBe(true);
  });
});
