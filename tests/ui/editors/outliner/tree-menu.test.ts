import { expect, it } from 'vitest';
import type { Character } from '../../../../src/model/document.ts';
import { jointEntries } from '../../../../src/ui/editors/outliner/tree-menu.ts';
import type { MenuItem } from '../../../../src/ui/widgets/menu.ts';
import { character, documentOf, skeleton, workbench } from '../../builders.ts';

function menu(mode: 'fk' | 'rig', keys: Record<string, readonly string[]> = {}) {
  const { wb } = workbench(documentOf(character({ skeleton: skeleton(['hips', -1], ['leg', 0]) })));
  wb.posing.mode.set(mode);
  wb.settings.update((now) => ({ ...now, keys }));
  const entries = jointEntries(wb, wb.store.document.characters[0], 1, () => {});
  const items = entries.filter((entry): entry is MenuItem => entry.kind === 'item');
  return new Map(items.map(({ label, shortcut, ariaShortcut }) => [label, [shortcut, ariaShortcut]]));
}

it('shows the shortcuts of actions on the selected joint', () => {
  const items = menu('rig');
  expect(items.get('Rename')).toEqual(['F2', 'F2']);
  expect(items.get('Add child')).toEqual(['Shift+C', 'Shift+C']);
  expect(items.get('Delete with descendants')?.[1]).toBe('Shift+Delete');
  expect(items.get('Add joints by clicking')).toEqual([undefined, undefined]);
});

it('shows remapped shortcuts', () => {
  const items = menu('rig', { 'rigging.rename': ['Ctrl+R'], 'rigging.addChild': [] });
  expect(items.get('Rename')).toEqual(['Ctrl+R', 'Control+R']);
  expect(items.get('Add child')).toEqual([undefined, undefined]);
});

it('shows the tree’s own key outside of rig mode', () => {
  expect(menu('fk', { 'rigging.rename': ['Ctrl+R'] }).get('Rename')).toEqual(['F2', 'F2']);
});

it('pins and locks a joint outside of rig mode, with labels that tell which', () => {
  const skeletonOf = { skeleton: skeleton(['hips', -1], ['leg', 0]) };
  const pin = { id: 1, joint: 1, point: [0, 0, 0], weight: 1, holdsOrientation: false } as const;
  const labels = (ik?: Character['ik']) => {
    const { wb } = workbench(documentOf(character({ ...skeletonOf, ...(ik && { ik }) })));
    return jointEntries(wb, wb.store.document.characters[0], 1, () => {}).map((entry) =>
      entry.kind === 'item' ? entry.label : entry.kind,
    );
  };
  expect(labels()).toEqual(['Rename', 'Pin (IK)', 'Lock (IK)', 'Edit in rig mode']);
  const held = labels({ pins: [pin], stiff: [{ joint: 1 }], rootIsFree: true });
  expect(held.slice(1, 3)).toEqual(['Unpin (IK)', 'Unlock (IK)']);
  const stiffer = labels({ pins: [], stiff: [{ joint: 1, stiffness: 10 }], rootIsFree: true });
  expect(stiffer.slice(1, 3)).toEqual(['Pin (IK)', 'Lock (IK)']);
});

it('entries on one of several selected joints say how many they are for', () => {
  const bones = skeleton(['hips', -1], ['leg_l', 0], ['leg_r', 0]);
  const { wb } = workbench(documentOf(character({ skeleton: bones })));
  wb.store.select({ characterId: 'c1', joint: 2, others: [1] });
  const labels = (joint: number) =>
    jointEntries(wb, wb.store.document.characters[0], joint, () => {}).flatMap((entry) =>
      entry.kind === 'item' ? [entry.label] : [],
    );
  expect(labels(1)).toContain('Pin 2 joints (IK)');
  // Not a selected one: only for itself.
  expect(labels(0)).toContain('Pin (IK)');
  expect(labels(0)).toContain('Add to selection');
  expect(labels(1)).toContain('Remove from selection');
  wb.posing.mode.set('rig');
  expect(labels(1)).toEqual(expect.arrayContaining(['Delete 2 joints, keep children', 'Add child to leg_r']));
});

it('an entry of a menu that outlives its character is refused in words', () => {
  const { wb } = workbench(documentOf(character({ skeleton: skeleton(['hips', -1], ['leg', 0]) })));
  const entries = jointEntries(wb, wb.store.document.characters[0], 1, () => {});
  wb.store.replace('Open another', documentOf());
  for (const entry of entries) if (entry.kind === 'item' && entry.label.endsWith('(IK)')) entry.run();
  expect(wb.messages.passing.get()).toBe('Select a joint first.');
});
