/** Which two takes are compared without further choice, and which one others are compared with. */
import { findCharacter } from '../../../model/document.ts';
import type { Uses } from '../../state/workbench.ts';
import { chosenTakes, currentPlace } from './play.ts';
import { shownKey, type TakeRow, takeRows } from './rows.ts';

/**
 * The two takes that need no further choice: those selected, the only two, or the only two that play; undefined if
 * there are others.
 */
export function takesToCompare(wb: Uses<'store' | 'timeline'>): readonly [TakeRow, TakeRow] | undefined {
  const { document } = wb.store;
  const chosen = chosenTakes(wb);
  const all = takeRows(document);
  const playing = all.filter((row) => row.isShown);
  const [first, second] = chosen.length === 2 ? chosen : all.length === 2 ? all : onlyTwo(playing, chosen);
  return first && second && [first, second];
}

/** Unless another take is selected. */
function onlyTwo(playing: readonly TakeRow[], chosen: readonly TakeRow[]): readonly TakeRow[] {
  return playing.length === 2 && chosen.length < 2 && chosen.every((row) => playing.includes(row)) ? playing : [];
}

/** The take that others are compared with: the selected one, else the current or the first. */
export function takeToCompare(wb: Uses<'store' | 'timeline'>): TakeRow | undefined {
  const all = takeRows(wb.store.document);
  const { focused } = wb.timeline.takes.view.get();
  const chosen = chosenTakes(wb);
  return chosen.find(({ key }) => key === focused) ?? chosen[0] ?? all[Math.max(0, currentPlace(wb, all))];
}

/**
 * A take that was selected because its character plays it stays with the character: when another is retargeted or baked
 * into it, that one is selected. What deselects everything deselects takes.
 */
export function followSelection(wb: Uses<'store' | 'timeline'>): () => void {
  const { takes } = wb.timeline;
  return wb.store.subscribe((now, before) => {
    const { chosen, focused } = takes.view.get();
    if (before.selection.characterId !== undefined && now.selection.characterId === undefined) {
      if (chosen.size > 0) takes.change({ chosen: new Set() });
      return;
    }
    const [key] = chosen;
    if (now.document === before.document || chosen.size !== 1 || focused !== key) return;
    const was = before.document.characters.find((c) => shownKey(c) === key);
    const is = was && findCharacter(now.document, was.id);
    const next = is && shownKey(is);
    if (next !== undefined && next !== key) takes.change({ chosen: new Set([next]), focused: next });
  });
}
