/** What is done with takes as wholes: playing one alone or several together, the next one, comparing two. */
import { setTimeOffset } from '../../edit/commands/characters.ts';
import { setHidden } from '../../edit/commands/spaces.ts';
import {
  type Arrangement,
  alignStarts,
  arrange,
  overlayTakes,
  removeTakes,
  setTimeOffsets,
  showTakes,
} from '../../edit/commands/takes.ts';
import { isSameSkeleton, matchJoints } from '../../evaluate/joint-match.ts';
import { findCharacter, shownClip } from '../../model/document.ts';
import type { Selection } from '../../model/session.ts';
import { attempt } from '../attempt.ts';
import { clipsRange } from '../shown-keys.ts';
import { fitWindow } from '../time-window.ts';
import type { Workbench } from '../workbench.ts';
import { listedTakes, shownKey, type TakeRow, takeRows } from './rows.ts';

/** As the list has them now. */
export function listOfTakes(wb: Workbench): readonly TakeRow[] {
  const { filter, order } = wb.timeline.takes.view.get();
  return listedTakes(takeRows(wb.store.document), filter, order);
}

/** Those that are chosen in the list, in its order. */
export function chosenTakes(wb: Workbench): TakeRow[] {
  const { chosen } = wb.timeline.takes.view.get();
  return chosen.size ? listOfTakes(wb).filter((row) => chosen.has(row.key)) : [];
}

/** Whose time and place are meant: those of the chosen takes, or of every take that is seen where one at most is chosen. */
export function charactersMeant(wb: Workbench): string[] {
  const chosen = chosenTakes(wb);
  const rows = chosen.length > 1 ? chosen : takeRows(wb.store.document).filter((row) => row.isShown);
  return [...new Set(rows.map((row) => row.characterId))];
}

/**
 * The take that one is at, by its place in the list: the only one that plays, else the shown one of the selected
 * character; -1 where there is none.
 */
export function currentPlace(wb: Workbench, rows: readonly TakeRow[]): number {
  const shown = rows.filter((row) => row.isShown);
  if (shown.length === 1) return rows.indexOf(shown[0]);
  const character = findCharacter(wb.store.document, wb.store.selection.characterId);
  const key = character && shownKey(character);
  return rows.findIndex((row) => row.key === key);
}

/** Nothing else is seen; the transport plays its range, from its start. Plays on where something played. */
export function playAlone(wb: Workbench, row: TakeRow): void {
  attempt(wb.messages, () => {
    endComparison(wb);
    wb.store.apply(showTakes, { takes: [row], alone: true });
    wb.timeline.takes.change({ chosen: new Set([row.key]), focused: row.key });
    selectCharacter(wb, row.characterId);
    playRange(wb, [row.range[0] - row.offsetSeconds, row.range[1] - row.offsetSeconds]);
    wb.viewport.reveal(row.characterId);
  });
}

/** These and no others, over all the time that they take. */
export function playTogether(wb: Workbench, rows: readonly TakeRow[]): void {
  attempt(wb.messages, () => {
    endComparison(wb);
    wb.store.apply(showTakes, { takes: rows, alone: true });
    const range = clipsRange(wb.store.document);
    if (range) playRange(wb, range);
  });
}

/** The next take of the list, or the one before; past the last comes the first. */
export function stepTake(wb: Workbench, step: 1 | -1): void {
  const rows = listOfTakes(wb);
  if (!rows.length) return;
  const at = currentPlace(wb, rows);
  const from = at < 0 && step < 0 ? 0 : at;
  playAlone(wb, rows[(from + step + rows.length) % rows.length]);
}

/** Into the picture, showing this take, or out of it. */
export function toggleShown(wb: Workbench, row: TakeRow): void {
  attempt(wb.messages, () => {
    if (row.isShown) wb.store.apply(setHidden, { ids: [row.characterId], hidden: true });
    else wb.store.apply(showTakes, { takes: [row] });
  });
}

export function showAll(wb: Workbench): void {
  endComparison(wb);
  const ids = wb.store.document.characters.filter((c) => c.isHidden).map((c) => c.id);
  if (ids.length) wb.store.apply(setHidden, { ids, hidden: false });
  followRangeOfTakes(wb);
}

export function remove(wb: Workbench, rows: readonly TakeRow[]): void {
  if (!rows.length) return;
  const list = listOfTakes(wb);
  const gone = new Set(rows.map((row) => row.key));
  const after = list.slice(list.indexOf(rows[0])).find((row) => !gone.has(row.key));
  const before = list.slice(0, list.indexOf(rows[0])).findLast((row) => !gone.has(row.key));
  attempt(wb.messages, () => {
    wb.store.apply(removeTakes, { takes: rows });
    // Numbers of a character's later takes are others now; which is next is said by what is there.
    const next = (after && rowLike(wb, after)) ?? (before && rowLike(wb, before));
    const { focused: _gone, ...view } = wb.timeline.takes.view.get();
    wb.timeline.takes.view.set({
      ...view,
      chosen: new Set(next ? [next.key] : []),
      ...(next && { focused: next.key }),
    });
  });
}

function rowLike(wb: Workbench, { characterId, name }: TakeRow): TakeRow | undefined {
  return listOfTakes(wb).find((row) => row.characterId === characterId && row.name === name);
}

export function align(wb: Workbench): void {
  const characterIds = charactersMeant(wb);
  attempt(wb.messages, () => wb.store.apply(alignStarts, { characterIds }));
  followRangeOfTakes(wb);
}

export function resetOffsets(wb: Workbench): void {
  const characterIds = charactersMeant(wb);
  attempt(wb.messages, () => wb.store.apply(setTimeOffsets, { characterIds, seconds: 0 }));
  followRangeOfTakes(wb);
}

export function offset(wb: Workbench, row: TakeRow, seconds: number): void {
  attempt(wb.messages, () => wb.store.apply(setTimeOffset, { characterId: row.characterId, seconds }));
}

export function putTakes(wb: Workbench, how: Arrangement): void {
  const characterIds = charactersMeant(wb);
  attempt(wb.messages, () => wb.store.apply(arrange, { characterIds, how }));
  wb.viewport.frameAll();
}

/** One over the other, tinted, with the distance of their joints; refused with a word where they have nothing in common. */
export function compareTakes(wb: Workbench, first: TakeRow, second: TakeRow): void {
  const { document } = wb.store;
  const skeletons = [first, second].map((row) => findCharacter(document, row.characterId)?.skeleton);
  const [a, b] = skeletons;
  if (!a || !b) {
    wb.messages.note('Takes are compared joint by joint: both need a skeleton.', 'warning');
    return;
  }
  const match = matchJoints(a, b);
  if (!match.first.length) {
    wb.messages.note(
      `${first.name} and ${second.name} have no joints in common: they are matched by their names and parents.`,
      'warning',
    );
    return;
  }
  attempt(wb.messages, () => {
    wb.store.apply(overlayTakes, { first, second });
    if (!isSameSkeleton(match)) {
      const missing = match.onlyFirst.length + match.onlySecond.length;
      wb.messages.note(
        `${match.first.length} joints are compared; ${missing} have no partner and are left out.`,
        'info',
      );
    }
    wb.timeline.takes.distances.update((now) => ({ ...now, picked: [] }));
    wb.timeline.takes.comparison.set({
      first: { characterId: first.characterId, clip: first.clip },
      second: { characterId: second.characterId, clip: second.clip },
    });
    const ends = [first, second].map(({ range, offsetSeconds }) => range.map((t) => t - offsetSeconds));
    const common: [number, number] = [Math.max(ends[0][0], ends[1][0]), Math.min(ends[0][1], ends[1][1])];
    const both: [number, number] = [Math.min(ends[0][0], ends[1][0]), Math.max(ends[0][1], ends[1][1])];
    playRange(wb, common[1] > common[0] ? common : both);
    wb.timeline.change({ tab: 'takes', window: fitWindow(both) });
    wb.viewport.reveal(first.characterId);
  });
}

export function endComparison(wb: Workbench): void {
  wb.timeline.takes.comparison.set(undefined);
}

/** The range is played from its start; whether anything plays stays as it is. */
function playRange(wb: Workbench, range: readonly [number, number]): void {
  wb.transport.update((p) => ({ ...p, range, timeSeconds: range[0], turned: false }));
}

function followRangeOfTakes(wb: Workbench): void {
  const range = clipsRange(wb.store.document);
  if (range) wb.transport.update((p) => ({ ...p, range }));
}

/** Another character, and of it the joint that was selected, if it has one of that name: its trail can be compared. */
export function selectCharacter(wb: Workbench, characterId: string): void {
  const { document, selection } = wb.store;
  if (selection.characterId === characterId) return;
  const before = findCharacter(document, selection.characterId);
  const now = findCharacter(document, characterId);
  const name = selection.joint === undefined ? undefined : before?.skeleton?.joints[selection.joint]?.name;
  const joint = name === undefined ? -1 : (now?.skeleton?.joints.findIndex((j) => j.name === name) ?? -1);
  const next: Selection = joint >= 0 ? { characterId, joint } : { characterId };
  wb.store.select(next);
}

/** Whether there is any take that plays. */
export function hasTakes(wb: Workbench): boolean {
  return wb.store.document.characters.some((c) => c.clips.length > 0 || shownClip(c) !== undefined);
}
