/** What is done to rows of the outliner: selecting, activating, renaming. */
import { renameCharacter, showSkin, showTake } from '../../../edit/commands/characters.ts';
import { renameTake } from '../../../edit/commands/take.ts';
import { withCharacterToggled, withJointsOfAll, withJointToggled } from '../../../model/skeleton/joint-selection.ts';
import { selectedJointsOf } from '../../state/joints/selected-joint.ts';
import type { Uses } from '../../state/workbench.ts';
import type { OutlineRow } from './outline-rows.ts';

export function select(wb: Uses<'store'>, { kind, characterId, index }: OutlineRow): void {
  if (kind === 'joint') wb.store.select({ characterId, joint: index });
  else if (kind === 'character' || wb.store.selection.characterId !== characterId) wb.store.select({ characterId });
}

export function isSelected(wb: Uses<'store'>, { kind, characterId, index }: OutlineRow): boolean {
  return kind === 'joint' && selectedJointsOf(wb, characterId).includes(index);
}

/** Joints and characters can be selected together. */
export function toggleSelected({ store }: Uses<'store'>, row: OutlineRow): void {
  const { kind, characterId, index } = row;
  if (kind === 'joint') store.select(withJointToggled(store.selection, { characterId, joint: index }));
  else if (kind === 'character') store.select(withCharacterToggled(store.selection, characterId));
  else select({ store }, row);
}

/** The joints among these rows, of all characters. */
export function selectRange(wb: Uses<'store'>, rows: readonly OutlineRow[]): void {
  const last = rows.at(-1);
  if (last?.kind === 'joint') {
    const joints = rows.filter(({ kind }) => kind === 'joint');
    wb.store.select(withJointsOfAll(joints.map(({ characterId, index }) => ({ characterId, joint: index }))));
  } else if (last) select(wb, last);
}

/** Shows a skin or a take. Whoever has found a joint or a character uses the keys of the viewport next. */
export function activate(wb: Uses<'store' | 'viewport'>, { kind, characterId, index }: OutlineRow): void {
  if (kind === 'skin') wb.store.apply(showSkin, { characterId, skin: index });
  else if (kind === 'take') wb.store.apply(showTake, { characterId, take: index });
  else if (kind !== 'morph') wb.viewport.canvas.focus({ preventScroll: true });
}

/** Moves the camera to a joint. */
export function frame(wb: Uses<'viewport'>, { kind, characterId, index }: OutlineRow): void {
  if (kind === 'joint') wb.viewport.camera.frameSelection({ characterId, joint: index });
}

export function canRename({ kind }: OutlineRow): boolean {
  return kind === 'character' || kind === 'take' || kind === 'joint';
}

export function rename(
  wb: Uses<'store' | 'transport' | 'posing' | 'messages'>,
  { kind, characterId, index }: OutlineRow,
  name: string,
): void {
  if (kind === 'joint') void import('../rig/rig-edits.ts').then((m) => m.renameIt(wb, characterId, index, name));
  else if (kind === 'take') wb.store.apply(renameTake, { characterId, take: index, name });
  else wb.store.apply(renameCharacter, { characterId, name });
}
