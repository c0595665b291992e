/** Actions on the document and its selection. */

import { addCopy, removeCharacter } from '../../edit/commands/characters.ts';
import { ownHeights, sameHeight, sameUnit } from '../../edit/commands/heights.ts';
import { resetPose, setClamping } from '../../edit/commands/pose.ts';
import { setHidden } from '../../edit/commands/spaces.ts';
import { DEFAULT_PLACEMENT } from '../../model/document.ts';
import { NOTHING_SELECTED } from '../../model/session.ts';
import { autoKey } from '../editors/posing/pose-edits.ts';
import { currentCharacter } from '../state/actions/action.ts';
import { needs, needsCharacter } from '../state/actions/needs.ts';
import { addKeyed } from '../state/add-keys.ts';
import type { Action, Uses } from '../state/workbench.ts';

const idsOf = (wb: Uses<'store'>) => wb.store.document.characters.map((c) => c.id);
const hasSeveral = (wb: Uses<'store'>) => wb.store.document.characters.length > 1;
const isComparing = (wb: Uses<'timeline'>) => wb.timeline.takes.comparison.get() !== undefined;
/** Heights of several characters, and not of takes that lie over each other: they would be put side by side. */
const needsSeveral = needs(
  (wb: Uses<'store' | 'timeline'>) =>
    isComparing(wb)
      ? 'Takes are being compared. Stop comparing first (Takes tab).'
      : 'This compares several characters. Open another one first.',
  (wb: Uses<'store' | 'timeline'>) => hasSeveral(wb) && !isComparing(wb),
);

export const EDIT_ACTIONS: readonly Action[] = [
  {
    id: 'edit.undo',
    name: 'Undo',
    label: (wb) => (wb.store.undoLabel ? `Undo ${lowerFirst(wb.store.undoLabel)}` : 'Undo'),
    group: 'Edit',
    menu: 'Edit',
    shortcuts: ['Ctrl+Z'],
    repeats: true,
    refuses: needs('There is nothing to undo.', (wb) => wb.store.undoLabel !== undefined),
    run: (wb) => travel(wb, 'undo'),
  },
  {
    id: 'edit.redo',
    name: 'Redo',
    label: (wb) => (wb.store.redoLabel ? `Redo ${lowerFirst(wb.store.redoLabel)}` : 'Redo'),
    group: 'Edit',
    menu: 'Edit',
    shortcuts: ['Ctrl+Shift+Z', 'Ctrl+Y'],
    repeats: true,
    refuses: needs('There is nothing to redo.', (wb) => wb.store.redoLabel !== undefined),
    run: (wb) => travel(wb, 'redo'),
  },
  {
    id: 'pose.resetToFile',
    unchanged: 'This is already the file pose.',
    label: 'Reset to file pose',
    group: 'Edit',
    menu: 'Edit',
    section: 1,
    shortcuts: ['Shift+R'],
    refuses: needsCharacter,
    run: (wb) => reset(wb, 'file'),
  },
  {
    id: 'pose.resetToZero',
    unchanged: 'This is already the zero pose.',
    label: 'Reset to zero pose',
    group: 'Edit',
    menu: 'Edit',
    section: 1,
    refuses: needsCharacter,
    run: (wb) => reset(wb, 'zero'),
  },
  {
    id: 'pose.holdLimits',
    label: 'Enforce limits',
    group: 'Edit',
    menu: 'Edit',
    section: 1,
    refuses: needsCharacter,
    checked: (wb) => currentCharacter(wb)?.clampsToLimits ?? false,
    run(wb) {
      const character = currentCharacter(wb);
      if (!character) return;
      wb.store.apply(setClamping, { characterId: character.id, clamps: !character.clampsToLimits });
    },
  },
  {
    id: 'character.copy',
    label: 'Duplicate instance',
    group: 'Edit',
    menu: 'Edit',
    section: 2,
    refuses: needsCharacter,
    run(wb) {
      const character = currentCharacter(wb);
      if (!character) return;
      const last = character.placements.at(-1) ?? DEFAULT_PLACEMENT;
      const [x, y, z] = last.position;
      const [width] = wb.viewport.sizeOf(character.id, character.placements.length - 1) ?? [1];
      // A point has no width: its instances would coincide.
      const aside = 1.2 * (width || 1);
      wb.store.apply(addCopy, { characterId: character.id, placement: { ...last, position: [x + aside, y, z] } });
    },
  },
  {
    id: 'character.hide',
    name: 'Show or hide character',
    label: (wb) => `${currentCharacter(wb)?.isHidden ? 'Show' : 'Hide'} ${currentCharacter(wb)?.name ?? 'character'}`,
    group: 'Edit',
    menu: 'Edit',
    section: 2,
    refuses: needsCharacter,
    run(wb) {
      const character = currentCharacter(wb);
      if (character) wb.store.apply(setHidden, { ids: [character.id], hidden: !character.isHidden });
    },
  },
  {
    id: 'edit.sameHeight',
    name: 'Same height',
    unchanged: 'All characters already have the same height.',
    label: (wb) => (hasSeveral(wb) ? `Same height as ${currentCharacter(wb)?.name ?? ''}` : 'Same height'),
    group: 'Edit',
    menu: 'Edit',
    section: 2,
    also: 'scale size normalise compare',
    refuses: needsSeveral,
    run(wb) {
      const character = currentCharacter(wb);
      if (!character) return;
      wb.store.apply(sameHeight, { characterIds: idsOf(wb), like: character.id });
      wb.viewport.camera.frameAll();
    },
  },
  {
    id: 'edit.sameUnit',
    name: 'Same unit',
    unchanged: 'No power of ten brings the characters closer to the same height.',
    label: (wb) => (hasSeveral(wb) ? `Same unit as ${currentCharacter(wb)?.name ?? ''}` : 'Same unit'),
    group: 'Edit',
    menu: 'Edit',
    section: 2,
    also: 'scale size centimetres metres hundred compare',
    refuses: needsSeveral,
    run(wb) {
      const character = currentCharacter(wb);
      if (!character) return;
      wb.store.apply(sameUnit, { characterIds: idsOf(wb), like: character.id });
      wb.viewport.camera.frameAll();
    },
  },
  {
    id: 'edit.ownHeights',
    unchanged: 'All characters already have their own heights.',
    label: 'Own heights',
    group: 'Edit',
    menu: 'Edit',
    section: 2,
    also: 'scale size reset original',
    refuses: needsSeveral,
    run(wb) {
      wb.store.apply(ownHeights, { characterIds: idsOf(wb) });
      wb.viewport.camera.frameAll();
    },
  },
  {
    id: 'character.remove',
    name: 'Remove character',
    label: (wb) => `Remove ${currentCharacter(wb)?.name ?? 'character'}`,
    group: 'Edit',
    menu: 'Edit',
    section: 2,
    shortcuts: ['Delete'],
    panel: 'outliner',
    refuses: needsCharacter,
    run(wb) {
      const character = currentCharacter(wb);
      if (!character) return;
      wb.store.apply(removeCharacter, { characterId: character.id });
      wb.store.select(NOTHING_SELECTED);
      // It may have held unsaved work, and Delete is a key that is hit by mistake.
      const { document } = wb.store;
      const undo = { label: 'Undo', run: () => travel(wb, 'undo') };
      const led = document.characters.filter(({ leaders }) => leaders?.some(({ id }) => id === character.id));
      const moves = led.length ? ` It still moves ${led.map(({ name }) => name).join(', ')}.` : '';
      wb.messages.confirm(`${character.name} was removed.${moves}`, undo, () => wb.store.document !== document);
    },
  },
];

function lowerFirst(text: string): string {
  return text.charAt(0).toLowerCase() + text.slice(1);
}

/**
 * Messages about the previous step no longer apply. If undo or redo removes or restores characters, a message says so,
 * since that may be unexpected.
 */
function travel(wb: Uses<'store' | 'messages'>, way: 'undo' | 'redo'): void {
  const label = way === 'undo' ? wb.store.undoLabel : wb.store.redoLabel;
  const before = idsOf(wb).join();
  wb.messages.leaveBehind(wb.messages.said);
  if (way === 'undo') wb.store.undo();
  else wb.store.redo();
  const after = idsOf(wb).join();
  if (label === undefined || after === before) return;
  const text = way === 'undo' ? `Undone: ${label}. Redo restores it.` : `Redone: ${label}.`;
  wb.messages.note(text, 'info', 'until a step', () => idsOf(wb).join() !== after);
}

function reset(wb: Uses<'store' | 'transport' | 'timeline' | 'settings'>, to: 'file' | 'zero'): void {
  const character = currentCharacter(wb);
  if (!character) return;
  const { timeSeconds } = wb.transport.get();
  addKeyed(wb, resetPose, { characterId: character.id, to, timeSeconds, key: autoKey(wb) });
}
