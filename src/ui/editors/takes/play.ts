/** Edits of takes: playing one or several, the next one, when and where. */

import { setTimeOffset } from '../../../edit/commands/characters.ts';
import { setHidden } from '../../../edit/commands/spaces.ts';
import {
  type Arrangement,
  alignStarts,
  arrange,
  removeTakes,
  setTimeOffsets,
  showTakes,
} from '../../../edit/commands/takes.ts';
import { takesRange } from '../../../evaluate/plot/shown-keys.ts';
import { findCharacter, shownTake } from '../../../model/document.ts';
import type { Selection } from '../../../model/session.ts';
import { attempt } from '../../state/actions/attempt.ts';
import { needs } from '../../state/actions/needs.ts';
import type { Uses } from '../../state/workbench.ts';
import { endComparison } from './compared-takes.ts';
import { followRangeOfTakes, playRange } from './played-range.ts';
import { listedTakes, shownKey, type TakeRow, takeRows } from './rows.ts';

/** In the list's current order and filter. */
export function listOfTakes(wb: Uses<'store' | 'timeline'>): readonly TakeRow[] {
  const { filter, order } = wb.timeline.takes.view.get();
  return listedTakes(takeRows(wb.store.document), filter, order);
}

/** The takes selected in the list, in its order. */
export function chosenTakes(wb: Uses<'store' | 'timeline'>): TakeRow[] {
  const { chosen } = wb.timeline.takes.view.get();
  return chosen.size ? listOfTakes(wb).filter((row) => chosen.has(row.key)) : [];
}

/**
 * Characters whose time and place are edited: those of the selected takes, or of all visible ones if fewer than two are
 * selected.
 */
export function charactersMeant(wb: Uses<'store' | 'timeline'>): string[] {
  const chosen = chosenTakes(wb);
  const rows = chosen.length > 1 ? chosen : takeRows(wb.store.document).filter((row) => row.isShown);
  return [...new Set(rows.map((row) => row.characterId))];
}

/**
 * Index in the list of the current take: the only one that plays, else the selected character's shown one; -1 if there
 * is none.
 */
export function currentPlace(wb: Uses<'store'>, rows: readonly TakeRow[]): number {
  const shown = rows.filter((row) => row.isShown);
  if (shown.length === 1) return rows.indexOf(shown[0]);
  const character = findCharacter(wb.store.document, wb.store.selection.characterId);
  const key = character && shownKey(character);
  return rows.findIndex((row) => row.key === key);
}

/** Hides all others; the transport plays its range from the start. Playback continues if it was playing. */
export function playAlone(wb: Uses<'store' | 'viewport' | 'transport' | 'timeline' | 'messages'>, row: TakeRow): void {
  attempt(wb.messages, () => {
    endComparison(wb);
    wb.store.apply(showTakes, { takes: [row], alone: true });
    wb.timeline.takes.change({ chosen: new Set([row.key]), focused: row.key });
    selectCharacter(wb, row.characterId);
    playRange(wb, [row.range[0] - row.offsetSeconds, row.range[1] - row.offsetSeconds]);
    wb.viewport.camera.reveal(row.characterId);
  });
}

/** Shows only these, over their whole time range. */
export function playTogether(
  wb: Uses<'store' | 'viewport' | 'transport' | 'timeline' | 'messages'>,
  rows: readonly TakeRow[],
): void {
  attempt(wb.messages, () => {
    endComparison(wb);
    wb.store.apply(showTakes, { takes: rows, alone: true });
    const range = takesRange(wb.store.document);
    if (range) playRange(wb, range);
    wb.viewport.camera.reveal(...rows.map((row) => row.characterId));
  });
}

/** The next or previous take of the list, cyclically. */
export function stepTake(wb: Uses<'store' | 'viewport' | 'transport' | 'timeline' | 'messages'>, step: 1 | -1): void {
  const rows = listOfTakes(wb);
  if (!rows.length) return;
  const at = currentPlace(wb, rows);
  const from = at < 0 && step < 0 ? 0 : at;
  playAlone(wb, rows[(from + step + rows.length) % rows.length]);
}

/** Hides these takes if any is visible, else shows them; for several takes of one character, the first. */
export function toggleShown(wb: Uses<'store' | 'messages'>, ...rows: readonly TakeRow[]): void {
  const shown = rows.filter((row) => row.isShown);
  const takes = rows.filter((row, i) => rows.findIndex((r) => r.characterId === row.characterId) === i);
  attempt(wb.messages, () => {
    if (shown.length) wb.store.apply(setHidden, { ids: shown.map((row) => row.characterId), hidden: true });
    else if (takes.length) wb.store.apply(showTakes, { takes });
  });
}

/** The takes that a key in the list applies to: the selected ones, or the focused row if it isn't among them. */
export function takesAtHand(wb: Uses<'store' | 'timeline'>): TakeRow[] {
  const { focused } = wb.timeline.takes.view.get();
  const chosen = chosenTakes(wb);
  if (focused === undefined || chosen.some((row) => row.key === focused)) return chosen;
  return listOfTakes(wb).filter((row) => row.key === focused);
}

export function showAll(wb: Uses<'store' | 'transport' | 'timeline' | 'messages'>): void {
  endComparison(wb);
  const ids = wb.store.document.characters.filter((c) => c.isHidden).map((c) => c.id);
  if (ids.length) wb.store.apply(setHidden, { ids, hidden: false });
  followRangeOfTakes(wb);
}

export function removeTakeRows(wb: Uses<'store' | 'timeline' | 'messages'>, rows: readonly TakeRow[]): void {
  if (!rows.length) return;
  const list = listOfTakes(wb);
  const gone = new Set(rows.map((row) => row.key));
  const after = list.slice(list.indexOf(rows[0])).find((row) => !gone.has(row.key));
  const before = list.slice(0, list.indexOf(rows[0])).findLast((row) => !gone.has(row.key));
  attempt(wb.messages, () => {
    wb.store.apply(removeTakes, { takes: rows });
    // Indices of the character's later takes have changed: find the neighbour by what it is.
    const next = (after && rowLike(wb, after)) ?? (before && rowLike(wb, before));
    const { focused: _gone, ...view } = wb.timeline.takes.view.get();
    wb.timeline.takes.view.set({
      ...view,
      chosen: new Set(next ? [next.key] : []),
      ...(next && { focused: next.key }),
    });
  });
}

function rowLike(wb: Uses<'store' | 'timeline'>, { characterId, name }: TakeRow): TakeRow | undefined {
  return listOfTakes(wb).find((row) => row.characterId === characterId && row.name === name);
}

export function align(wb: Uses<'store' | 'transport' | 'timeline' | 'messages'>): void {
  const characterIds = charactersMeant(wb);
  attempt(wb.messages, () => wb.store.apply(alignStarts, { characterIds }));
  followRangeOfTakes(wb);
}

export function resetOffsets(wb: Uses<'store' | 'transport' | 'timeline' | 'messages'>): void {
  const characterIds = charactersMeant(wb);
  attempt(wb.messages, () => wb.store.apply(setTimeOffsets, { characterIds, seconds: 0 }));
  followRangeOfTakes(wb);
}

/** @param atSeconds of the transport: when its first frame is to play */
export function startAt(wb: Uses<'store' | 'messages'>, row: TakeRow, atSeconds: number): void {
  const own = findCharacter(wb.store.document, row.characterId)?.timeOffsetSeconds ?? 0;
  // A retargeted take has its source's offset too. Plus 0: avoids an offset of −0.
  const seconds = row.range[0] - (row.offsetSeconds - own) - atSeconds + 0;
  attempt(wb.messages, () => wb.store.apply(setTimeOffset, { characterId: row.characterId, seconds }));
}

export function putTakes(wb: Uses<'store' | 'viewport' | 'timeline' | 'messages'>, how: Arrangement): void {
  const characterIds = charactersMeant(wb);
  attempt(wb.messages, () => wb.store.apply(arrange, { characterIds, how }));
  wb.viewport.camera.frameAll();
}

/**
 * Selects another character, and its joint of the same name as the selected one: their motion paths can be compared.
 */
export function selectCharacter(wb: Uses<'store'>, characterId: string): void {
  const { document, selection } = wb.store;
  if (selection.characterId === characterId) return;
  const before = findCharacter(document, selection.characterId);
  const now = findCharacter(document, characterId);
  const name = selection.joint === undefined ? undefined : before?.skeleton?.joints[selection.joint]?.name;
  const joint = name === undefined ? -1 : (now?.skeleton?.joints.findIndex((j) => j.name === name) ?? -1);
  const next: Selection = joint >= 0 ? { characterId, joint } : { characterId };
  wb.store.select(next);
}

/** Whether any take plays. */
export const needsTakes = needs('There are no takes. Open an .anim or .bvh file, or key a pose.', (wb: Uses<'store'>) =>
  wb.store.document.characters.some((c) => c.takes.length > 0 || shownTake(c) !== undefined),
);
