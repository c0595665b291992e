import { describe, expect, it } from 'vitest';
import { rigState } from '../../../../src/ui/editors/rig/rig-state.ts';
import { character, documentOf, skeleton, workbench } from '../../builders.ts';

describe('what rig mode remembers', () => {
  it('is one state a page, and begins with nothing being added', () => {
    const { wb } = workbench();
    expect(rigState(wb)).toBe(rigState(wb));
    expect(rigState(wb)).not.toBe(rigState(workbench().wb));
    expect(rigState(wb).adding.get()).toBe(false);
  });
});

describe('adding joints', () => {
  it('begins at the root where no joint is selected, and leaves one that is', async () => {
    const { RIG_ACTIONS } = await import('../../../../src/ui/editors/rig/actions.ts');
    const add = RIG_ACTIONS.find(({ id }) => id === 'rigging.addJoints');
    const { wb } = workbench(documentOf(character({ skeleton: skeleton(['root', -1], ['leg', 0]) })));
    expect(add?.enabled?.(wb)).toBe(false);
    wb.posing.mode.set('rig');
    expect(add?.enabled?.(wb)).toBe(true);
    add?.run(wb);
    expect(wb.store.selection).toEqual({ characterId: 'c1', joint: 0 });
    add?.run(wb);
    wb.store.select({ characterId: 'c1', joint: 1 });
    add?.run(wb);
    expect(wb.store.selection.joint).toBe(1);
    expect(rigState(wb).adding.get()).toBe(true);
  });
});
