import { describe, expect, it } from 'vitest';
import { runAction } from '../../../../src/ui/state/actions/action.ts';
import { character, documentOf, skeleton, workbench } from '../../builders.ts';

const rig = () => skeleton(['hip', -1], ['arm_l', 0], ['arm_r', 0]);
const pose = [1, 0, 0, 0, 0, 0, 0.1, 0.2, 0.3, 0, 0, 0];

describe('poses by menus and keys', () => {
  it('a pose copied to another character reports what did not match', async () => {
    const other = character({ id: 'c2', name: 'crab', skeleton: skeleton(['hip', -1], ['claw', 0]), pose: [] });
    const { wb } = workbench(documentOf(character({ id: 'c1', skeleton: rig(), pose }), other));
    expect(() => runAction(wb, 'pose.paste')).toThrow();
    await runAction(wb, 'pose.copy');
    expect(wb.posing.copied.get()?.pose.root).toEqual([1, 0, 0]);
    wb.store.select({ characterId: 'c2' });
    await runAction(wb, 'pose.paste');
    expect(wb.store.document.characters[1].pose[0]).toBe(1);
    expect(wb.messages.list.get().at(-1)?.text).toContain('“arm_l” and 1 more');
    expect(wb.store.undoLabel).toBe('Paste pose on crab');
  });

  it('mirroring applies to the whole pose, or from the selected joint down', async () => {
    const { wb } = workbench(documentOf(character({ id: 'c1', skeleton: rig(), pose })));
    await runAction(wb, 'pose.mirror');
    expect(wb.store.document.characters[0].pose.slice(6)).toEqual([0, 0, 0, 0.1, -0.2, -0.3]);
    expect(() => runAction(wb, 'pose.copyToOther')).toThrow();
    wb.store.select({ characterId: 'c1', joint: 2 });
    await runAction(wb, 'pose.copyToOther');
    expect(wb.store.document.characters[0].pose.slice(6)).toEqual([0.1, 0.2, 0.3, 0.1, -0.2, -0.3]);
    wb.store.select({ characterId: 'c1', joint: 0 });
    await runAction(wb, 'pose.copyToOther');
    expect(wb.messages.list.get().at(-1)?.text).toContain('in the middle');
  });

  it('the focused pose in the library is updated to the current one, and says so', async () => {
    const { wb } = workbench(documentOf(character({ id: 'c1', skeleton: rig(), pose })));
    expect(() => runAction(wb, 'pose.update')).toThrow();
    await runAction(wb, 'pose.keep');
    await runAction(wb, 'pose.keep');
    wb.posing.libraryPose.set(1);
    await runAction(wb, 'pose.resetToFile');
    await runAction(wb, 'pose.update');
    expect(wb.store.document.characters[0].poses?.map(({ values }) => values[0])).toEqual([1, 0]);
    expect(wb.messages.passing.get()).toBe('Updated pose 2 to the current pose.');
    expect(wb.store.undoLabel).toBe('Update pose 2 in pose library');
  });

  it('saving a pose stops playback, and the library can be opened', async () => {
    const { wb } = workbench(documentOf(character({ id: 'c1', skeleton: rig(), pose })), { playing: true });
    await runAction(wb, 'pose.keep');
    expect(wb.transport.get().playing).toBe(false);
    expect(wb.store.document.characters[0].poses).toEqual([{ name: 'pose 1', values: pose }]);
    runAction(wb, 'page.tab.poses');
    expect(wb.timeline.view.get().tab).toBe('poses');
    runAction(wb, 'save.pose');
  });
});
