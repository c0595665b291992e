/** The menus of rows of the outliner. */
import { removeCopy, showSkin, showTake } from '../../../edit/commands/characters.ts';
import { duplicateTake, removeTake } from '../../../edit/commands/take.ts';
import { findCharacter } from '../../../model/document.ts';
import { actionsOf, currentCharacter, tryAction } from '../../state/actions/action.ts';
import { itemOf, sectionsOf } from '../../state/actions/menu-entries.ts';
import { onDemand } from '../../state/on-demand.ts';
import type { Uses, Workbench } from '../../state/workbench.ts';
import { type MenuEntry, type MenuPlace, openMenu } from '../../widgets/menu.ts';
import { movedEntries } from '../retarget/moved.ts';
import type { OutlineRow } from './outline-rows.ts';

const CHARACTER_ACTIONS = [
  'character.hide',
  'character.copy',
  'character.attach',
  'character.putDown',
  'character.detach',
  'pose.resetToFile',
  'pose.resetToZero',
  'pose.holdLimits',
];
const JOINT_ACTIONS = [
  'key.joint',
  'pose.copyJoints',
  'pose.paste',
  'pose.resetJoints',
  'character.attach',
  'select.hierarchy',
  'select.mirrored',
  'view.frameSelection',
  'draw.follow',
  'draw.skin.heat',
];

export function rowMenu(wb: Workbench, row: OutlineRow, at: MenuPlace, rename: (row: OutlineRow) => void): void {
  const character = findCharacter(wb.store.document, row.characterId);
  if (character && row.kind === 'take') return void openMenu(at, takeEntries(wb, row, rename), { label: row.label });
  if (character && row.kind === 'skin') return void openMenu(at, skinEntries(wb, row), { label: row.label });
  if (!character || (row.kind !== 'character' && row.kind !== 'joint')) return;
  const ids = row.kind === 'joint' ? JOINT_ACTIONS : CHARACTER_ACTIONS;
  const actions = actionsOf(wb);
  const pick = (id: string) => actions.filter((a) => a.id === id).map((a) => itemOf(wb, a));
  const entries = ids.flatMap(pick);
  if (row.kind === 'joint') {
    void onDemand(wb.messages, 'The joint menu', () => import('./tree-menu.ts')).then((module) => {
      // If it can't be loaded, the other entries remain.
      const rigging = module?.jointEntries(wb, character, row.index, () => rename(row)) ?? [];
      openMenu(at, [...rigging, ...entries], { label: row.label || 'Joint' });
    });
    return;
  }
  const last = character.placements.length - 1;
  const removeLast = () => wb.store.apply(removeCopy, { characterId: character.id, index: last });
  openMenu(
    at,
    [
      ...movedEntries(wb, character),
      { kind: 'item', label: 'Rename', shortcut: 'F2', enabled: true, run: () => rename(row) },
      ...entries,
      { kind: 'item', label: 'Remove last instance', enabled: last > 0, run: removeLast },
      { kind: 'line' },
      ...pick('character.remove'),
    ],
    { label: character.name },
  );
}

function skinEntries(wb: Uses<'store' | 'actions' | 'settings'>, row: OutlineRow): MenuEntry[] {
  const { characterId, index } = row;
  /** Applies to what is shown, of the selected character. */
  const showIt = () => {
    if (currentCharacter(wb)?.id !== characterId) wb.store.select({ characterId });
    if (findCharacter(wb.store.document, characterId)?.shownSkin === index) return;
    wb.store.apply(showSkin, { characterId, skin: index });
  };
  const weights = actionsOf(wb).filter((a) => a.id === 'skin.weights');
  return [
    { kind: 'item', label: 'Show', enabled: !row.shown, run: showIt },
    ...weights.map((action): MenuEntry => {
      const hasSkeleton = findCharacter(wb.store.document, characterId)?.skeleton !== undefined;
      const run = () => {
        showIt();
        tryAction(wb, action);
      };
      return { ...itemOf(wb, action), enabled: hasSkeleton, run };
    }),
  ];
}

export function takeEntries(
  wb: Uses<'store' | 'actions' | 'settings'>,
  row: OutlineRow,
  rename: (row: OutlineRow) => void,
): MenuEntry[] {
  const { characterId, index } = row;
  const ref = { characterId, take: index };
  const item = (label: string, run: () => void): MenuEntry => ({ kind: 'item', label, enabled: true, run });
  return [
    row.shown
      ? item('Show no take', () => wb.store.apply(showTake, { characterId, take: -1 }))
      : item('Show', () => wb.store.apply(showTake, ref)),
    { kind: 'item', label: 'Rename', shortcut: 'F2', enabled: true, run: () => rename(row) },
    item('Duplicate', () => wb.store.apply(duplicateTake, ref)),
    // They edit the take that the current character shows.
    ...(row.shown && currentCharacter(wb)?.id === characterId ? sectionsOf(wb, [['Edit/Edit takes']]) : []),
    { kind: 'line' },
    item(`Remove ${row.label}`, () => wb.store.apply(removeTake, ref)),
  ];
}
