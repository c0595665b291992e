/** A card's context menu. */
import type { MenuEntry } from '../../widgets/menu.ts';

export interface CardActions {
  /** @param isBranch from the selected joints down only */
  take(share: number, isBranch: boolean): void;
  update(): void;
  rename(): void;
  save(): void;
  remove(): void;
}

/** @param joint name of the selected joint, or `3 joints`, if they belong to that character */
export function cardEntries(joint: string | undefined, does: CardActions): readonly MenuEntry[] {
  const item = (label: string, run: () => void, shortcut?: string): MenuEntry => ({
    kind: 'item',
    label,
    enabled: true,
    run,
    shortcut,
  });
  const branch = item(`Apply from ${joint} down`, () => does.take(1, true));
  return [
    item('Apply', () => does.take(1, false), 'Enter'),
    item('Apply at 50%', () => does.take(0.5, false)),
    ...(joint === undefined ? [] : [branch]),
    { kind: 'line' },
    item('Update to current pose', () => does.update()),
    // Keys of the grid itself.
    item('Rename', () => does.rename(), 'F2'),
    item('Save poses…', () => does.save()),
    { kind: 'line' },
    item('Remove', () => does.remove(), 'Del'),
  ];
}
