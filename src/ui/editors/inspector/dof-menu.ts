/** The context menu of a DOF's row: its keys, its curve, its limits. */
import { clearLimit, setLimit } from '../../../edit/commands/limits.ts';
import { channelOf, dofCountOf, isDriven, poseAt } from '../../../evaluate/pose.ts';
import { silentChannels } from '../../../evaluate/retarget/moved-dofs.ts';
import { coupleOf } from '../../../model/couples.ts';
import { type Character, findCharacter } from '../../../model/document.ts';
import { type CharacterDof, characterDofs, filePose } from '../../../model/dofs.ts';
import { isUnlimited, type Limit, UNLIMITED } from '../../../model/skeleton.ts';
import { type MenuEntry, openMenu } from '../../kit/menu.ts';
import type { Slider } from '../../kit/slider.ts';
import { addKeyed } from '../../state/add-keys.ts';
import { openPanel } from '../../state/panels.ts';
import type { Uses } from '../../state/workbench.ts';
import { autoKey, deleteAllKeys, deleteKeysNow, isKeyedNow, keyNow, setOne } from '../posing/pose-edits.ts';
import { editLimits } from '../rig/limit-editor.ts';

/** @param at pointer position; absent if opened by keyboard in the row's number */
export function openDofMenu(
  wb: Uses<'store' | 'transport' | 'timeline' | 'posing' | 'settings'>,
  slider: Slider,
  characterId: string,
  index: number,
  at: { readonly x: number; readonly y: number } | undefined,
): void {
  const character = findCharacter(wb.store.document, characterId);
  const dof = character && characterDofs(character.skeleton, character.morphs)[index];
  if (!dof) return;
  const list = entries(wb, slider, character, index, dof);
  if (at) openMenu(at, list, { label: dof.name });
  else {
    openMenu(slider.$name.getBoundingClientRect(), list, {
      label: dof.name,
      opener: slider.$input,
      focusFirst: true,
    });
  }
}

function entries(
  wb: Uses<'store' | 'transport' | 'timeline' | 'posing' | 'settings'>,
  slider: Slider,
  character: Character,
  index: number,
  dof: CharacterDof,
): readonly MenuEntry[] {
  const { id } = character;
  const item = (label: string, enabled: boolean, run: () => void): MenuEntry => ({ kind: 'item', label, enabled, run });
  const hasKeys = isDriven(character, index) && channelOf(character, index) !== undefined;
  const value = shownValue(wb, character, index);
  const inFile = filePose(character.skeleton, character.morphs.length)[index] ?? 0;
  // A linked DOF has no value of its own.
  const isOwn = coupleOf(character.skeleton, index) === undefined;
  const set = (value: number) => {
    const own = { index, value };
    const beside = wb.posing.beside?.(id, [index]);
    const { timeSeconds } = wb.transport.get();
    const dofs = beside?.at([own]) ?? [own];
    addKeyed(wb, setOne(own), { characterId: id, dofs, timeSeconds, key: autoKey(wb) });
    beside?.shown();
  };
  const list: MenuEntry[] = [
    // While retargeted, a key of its own would have no effect.
    item('Key at current time', character.skeleton !== undefined && index >= silentChannels(character), () =>
      keyNow(wb, id, [index]),
    ),
    item('Delete key at current time', isKeyedNow(wb, character, index), () => deleteKeysNow(wb, character, [index])),
    item('Delete all keys', hasKeys, () => deleteAllKeys(wb, character, index)),
    { kind: 'line' },
    item('Show curve', hasKeys, () => showCurve(wb, character, index)),
    { kind: 'line' },
    item('Reset to file pose', isOwn && value !== inFile, () => set(inFile)),
    item(`Reset to ${dof.rest === 0 ? 'zero' : 'one'}`, isOwn && value !== dof.rest, () => set(dof.rest)),
  ];
  if (!dof.takesLimits) return list;
  const { min, max } = holds(dof.limit) ? dof.limit : UNLIMITED;
  const limit = (next: Limit) => wb.store.apply(setLimit, { characterId: id, dof: index, ...next });
  return [
    ...list,
    { kind: 'line' },
    item('Set lower limit here', value <= max, () => limit({ min: value, max })),
    item('Set upper limit here', value >= min, () => limit({ min, max: value })),
    item('Edit limits…', true, () => editLimits(wb, slider, id, index)),
    item('No limits', !isUnlimited(dof.limit), () => wb.store.apply(clearLimit, { characterId: id, dof: index })),
  ];
}

/** Crossed limits count as none. */
function holds({ min, max }: Limit): boolean {
  return min <= max;
}

function shownValue(wb: Uses<'transport'>, character: Character, index: number): number {
  const pose = new Float64Array(dofCountOf(character));
  poseAt(character, wb.transport.get().timeSeconds, pose);
  return pose[index];
}

/** Opens the curve editor with this curve isolated. */
function showCurve(wb: Uses<'store' | 'timeline' | 'settings'>, character: Character, index: number): void {
  wb.store.select({ ...wb.store.selection, characterId: character.id });
  wb.timeline.isolate(undefined);
  const hidden = wb.timeline.view.get().hidden.filter((c) => c !== index);
  wb.timeline.change({ tab: 'curves', list: 'pinned', pinned: [index], hidden, filter: '' });
  openPanel(wb, 'timeline', true);
}
