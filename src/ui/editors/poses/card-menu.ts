/** A card's context menu. */
import type { MenuEntry } from '../../kit/menu.ts';
import type { PoseOptions } from './tools.ts';

export interface CardActions {
  take(options: PoseOptions): void;
  rename(): void;
  save(): void;
  remove(): void;
}

/** @param joint name of the selected joint, if it belongs to that character */
export function cardEntries(joint: string | undefined, does: CardActions): readonly MenuEntry[] {
  const item = (label: string, run: () => void, shortcut?: string): MenuEntry => ({
    kind: 'item',
    label,
    enabled: true,
    run,
    shortcut,
  });
  const branch = item(`Apply from ${joint} down`, () => does.take({ share: 1, branch: true }));
  return [
    item('Apply', () => does.take({ share: 1, branch: false }), 'Enter'),
    item('Apply at 50%', () => does.take({ share: 0.5, branch: false })),
    ...(joint === undefined ? [] : [branch]),
    { kind: 'line' },
    // Keys of the grid itself.
    item('Rename', () => does.rename(), 'F2'),
    item('Save poses…', () => does.save()),
    { kind: 'line' },
    item('Remove', () => does.remove(), 'Del'),
  ];
}
