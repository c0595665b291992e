/** The context menu of a DOF's row: its keys, its curve, its limits. */
import { clearLimit, setLimit } from '../../../edit/commands/limits.ts';
import { inTurn } from '../../../edit/in-turn.ts';
import { channelOf, isDriven } from '../../../evaluate/pose.ts';
import { silentChannels } from '../../../evaluate/retarget/moved-dofs.ts';
import { type Character, findCharacter } from '../../../model/document.ts';
import { lockedDofs } from '../../../model/sets.ts';
import { coupleOf } from '../../../model/skeleton/couples.ts';
import { characterDofs, wholeFilePose } from '../../../model/skeleton/dofs.ts';
import { isUnlimited, type Limit, UNLIMITED } from '../../../model/skeleton/skeleton.ts';
import { attempt } from '../../state/actions/attempt.ts';
import { addKeyed } from '../../state/add-keys.ts';
import { openPanel } from '../../state/panels/panels.ts';
import type { Uses } from '../../state/workbench.ts';
import { type MenuEntry, openMenu } from '../../widgets/menu.ts';
import type { Slider } from '../../widgets/numbers/slider.ts';
import { shownDofs } from '../posing/active-dof.ts';
import { autoKey, deleteAllKeys, deleteKeysNow, isKeyedNow, keyNow, setOwn } from '../posing/pose-edits.ts';
import { editLimits } from '../rig/limit-editor.ts';
import { toggleLocks } from '../sets/toggle-locks.ts';

/**
 * @param dofs of the row: one, or the same of several joints, which the entries are for; the first is the shown one
 * @param at pointer position; absent if opened by keyboard in the row's number
 */
export function openDofMenu(
  wb: Uses<'store' | 'transport' | 'timeline' | 'posing' | 'settings' | 'messages'>,
  slider: Slider,
  characterId: string,
  dofs: readonly number[],
  at: { readonly x: number; readonly y: number } | undefined,
): void {
  const character = findCharacter(wb.store.document, characterId);
  const dof = character && characterDofs(character.skeleton, character.morphs)[dofs[0]];
  if (!dof) return;
  const list = dofEntries(wb, character, dofs, (limited) => editLimits(wb, slider, characterId, limited));
  const label = dofs.length === 1 ? dof.name : `${dof.name} of ${dofs.length} joints`;
  if (at) openMenu(at, list, { label });
  else {
    openMenu(slider.nameElement.getBoundingClientRect(), list, {
      label,
      opener: slider.field,
      focusFirst: true,
    });
  }
}

type Parts = Uses<'store' | 'transport' | 'timeline' | 'posing' | 'settings' | 'messages'>;

/** @param openLimits shows the fields for limits of these DOFs */
export function dofEntries(
  wb: Parts,
  character: Character,
  [index, ...others]: readonly number[],
  openLimits: (dofs: readonly number[]) => void,
): readonly MenuEntry[] {
  const { id } = character;
  const item = itemOf(wb);
  const all = characterDofs(character.skeleton, character.morphs);
  const dof = all[index];
  const each = [index, ...others].sort((a, b) => a - b);
  const isForSeveral = others.length > 0;
  const keys = isForSeveral ? 'keys' : 'key';
  const locks = lockedDofs(character);
  const isLocked = each.every((one) => locks.has(one));
  const withKeys = each.filter((one) => isDriven(character, one) && channelOf(character, one) !== undefined);
  const hasKeys = withKeys.length > 0;
  const values = shownDofs(wb, character);
  const inFile = wholeFilePose(character.skeleton, character.morphs);
  // A linked DOF has no value of its own, and a locked one keeps it.
  const isOwn = coupleOf(character.skeleton, index) === undefined && !isLocked;
  const set = (wanted: (one: number) => number) => {
    const own = [index, ...others].map((one) => ({ index: one, value: wanted(one) }));
    const beside = wb.posing.beside?.(id, each);
    const { timeSeconds } = wb.transport.get();
    const dofs = beside?.at(own) ?? own;
    addKeyed(wb, setOwn(wb, own), { characterId: id, dofs, timeSeconds, key: autoKey(wb) });
    beside?.shown();
  };
  const fromFile = (one: number) => inFile[one] ?? 0;
  const atRest = (one: number) => all[one].rest;
  const isAnyOff = (wanted: (one: number) => number) => isOwn && each.some((one) => values[one] !== wanted(one));
  const list: MenuEntry[] = [
    // While retargeted, a key of its own would have no effect.
    item(
      'Key at current time',
      character.skeleton !== undefined && each.every((one) => one >= silentChannels(character)),
      () => keyNow(wb, [{ character, dofs: each }]),
    ),
    item(
      `Delete ${keys} at current time`,
      each.some((one) => isKeyedNow(wb, character, one)),
      () => deleteKeysNow(wb, [{ character, dofs: each }]),
    ),
    item('Delete all keys', hasKeys, () => deleteAllKeys(wb, character, each)),
    { kind: 'line' },
    item(isForSeveral ? 'Show curves' : 'Show curve', hasKeys, () => showCurves(wb, character, withKeys)),
    { kind: 'line' },
    item(isLocked ? 'Unlock' : 'Lock', dof.joint >= 0, () => toggleLocks(wb, id, each)),
    item('Reset to file pose', isAnyOff(fromFile), () => set(fromFile)),
    item(`Reset to ${dof.rest === 0 ? 'zero' : 'one'}`, isAnyOff(atRest), () => set(atRest)),
  ];
  const limited = [index, ...others].filter((one) => all[one].takesLimits);
  if (limited.length === 0) return list;
  const name = isForSeveral ? `${dof.name} of ${each.length} joints` : dof.name;
  return [...list, { kind: 'line' }, ...limitEntries(wb, character, limited, { name, openLimits })];
}

/** @param limited the DOFs that take limits; the first is the one of the menu */
function limitEntries(
  wb: Parts,
  character: Character,
  limited: readonly number[],
  { name, openLimits }: { readonly name: string; readonly openLimits: (dofs: readonly number[]) => void },
): readonly MenuEntry[] {
  const { id } = character;
  const all = characterDofs(character.skeleton, character.morphs);
  const values = shownDofs(wb, character);
  const dofs = limited.toSorted((a, b) => a - b);
  const limitsOf = (one: number) => (holds(all[one].limit) ? all[one].limit : UNLIMITED);
  /** Each at its own value. */
  const limit = (next: (one: number) => Limit) => {
    const args = dofs.map((one) => ({ characterId: id, dof: one, ...next(one) }));
    wb.store.apply(inTurn(setLimit, `Set limits of ${name}`), args);
  };
  const clear = () => {
    const args = dofs.map((one) => ({ characterId: id, dof: one }));
    wb.store.apply(inTurn(clearLimit, `Remove limits of ${name}`), args);
  };
  const canBeLower = dofs.every((one) => values[one] <= limitsOf(one).max);
  const canBeUpper = dofs.every((one) => values[one] >= limitsOf(one).min);
  const isLimited = dofs.some((one) => !isUnlimited(all[one].limit));
  const item = itemOf(wb);
  return [
    item('Set lower limit here', canBeLower, () => limit((one) => ({ min: values[one], max: limitsOf(one).max }))),
    item('Set upper limit here', canBeUpper, () => limit((one) => ({ min: limitsOf(one).min, max: values[one] }))),
    item('Edit limits…', true, () => openLimits(limited)),
    item('No limits', isLimited, clear),
  ];
}

function itemOf({ messages }: Parts) {
  return (label: string, enabled: boolean, run: () => void): MenuEntry => ({
    kind: 'item',
    label,
    enabled,
    // What was drawn when the menu opened may no longer be so.
    run: () => attempt(messages, run),
  });
}

/** Crossed limits count as none. */
function holds({ min, max }: Limit): boolean {
  return min <= max;
}

/** Opens the curve editor with these curves isolated. */
function showCurves(
  wb: Uses<'store' | 'timeline' | 'settings'>,
  character: Character,
  channels: readonly number[],
): void {
  wb.store.select({ ...wb.store.selection, characterId: character.id });
  wb.timeline.isolate(undefined);
  const hidden = wb.timeline.view.get().hidden.filter((c) => !channels.includes(c));
  wb.timeline.change({ tab: 'curves', list: 'pinned', pinned: [...channels], hidden, filter: '' });
  openPanel(wb, 'timeline', true);
}
