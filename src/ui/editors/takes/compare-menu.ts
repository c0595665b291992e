/** Which two takes are compared: the selected ones, or one and another chosen in a menu. */
import { isSameSkeleton, type JointMatch, matchJoints } from '../../../evaluate/joint-match.ts';
import { type Document, findCharacter } from '../../../model/document.ts';
import type { MenuEntry } from '../../kit/menu.ts';
import { plural } from '../../kit/number-text.ts';
import type { Uses } from '../../state/workbench.ts';
import { compareTakes } from './compare.ts';
import { chosenTakes, currentPlace } from './play.ts';
import { type TakeRow, takeRows } from './rows.ts';

/** The two takes that need no further choice: those selected, or the only two; undefined if there are others. */
export function takesToCompare(wb: Uses<'store' | 'timeline'>): readonly [TakeRow, TakeRow] | undefined {
  const chosen = chosenTakes(wb);
  const all = takeRows(wb.store.document);
  const [first, second] = chosen.length === 2 ? chosen : all.length === 2 ? all : [];
  return first && second && [first, second];
}

/** The take that others are compared with: the selected one, else the current or the first. */
export function takeToCompare(wb: Uses<'store' | 'timeline'>): TakeRow | undefined {
  const all = takeRows(wb.store.document);
  const { focused } = wb.timeline.takes.view.get();
  const chosen = chosenTakes(wb);
  return chosen.find(({ key }) => key === focused) ?? chosen[0] ?? all[Math.max(0, currentPlace(wb, all))];
}

/** `Compare with…` as one entry of a menu: the only other take, or a submenu of all; none without another. */
export function compareWith(
  wb: Uses<'store' | 'viewport' | 'transport' | 'timeline' | 'messages'>,
  row: TakeRow,
): readonly MenuEntry[] {
  const others = othersOf(wb.store.document, row);
  if (others.length === 0) return [];
  const [{ other }] = others;
  if (others.length > 1) return [{ kind: 'menu', label: 'Compare with', entries: () => compareEntries(wb, row) }];
  const run = () => compareTakes(wb, row, other);
  return [{ kind: 'item', label: `Compare with ${other.name || 'unnamed'}`, enabled: true, run }];
}

/** The other takes, each compared with this one when chosen: those of the same skeleton first. */
export function compareEntries(
  wb: Uses<'store' | 'viewport' | 'transport' | 'timeline' | 'messages'>,
  row: TakeRow,
): readonly MenuEntry[] {
  const others = othersOf(wb.store.document, row);
  const entries = others.flatMap(({ other, match, rank }, i): MenuEntry[] => {
    const run = () => compareTakes(wb, row, other);
    const detail = [other.character, rank === 0 ? '' : inCommon(match)].filter(Boolean).join(', ');
    const item: MenuEntry = {
      kind: 'item',
      label: other.name || 'unnamed',
      ...(detail && { detail }),
      // Without a joint in common choosing it says what to do instead.
      enabled: rank < NOTHING_IN_COMMON,
      refuse: run,
      run,
    };
    return i > 0 && rank !== others[i - 1].rank ? [{ kind: 'line' }, item] : [item];
  });
  return [{ kind: 'note', text: `Compare ${row.name || 'unnamed'} with` }, ...entries];
}

const NOTHING_IN_COMMON = 2;

interface Other {
  readonly other: TakeRow;
  readonly match: JointMatch | undefined;
  /** 0: the same skeleton; 1: some joints in common; 2: none. */
  readonly rank: 0 | 1 | typeof NOTHING_IN_COMMON;
}

function othersOf(document: Document, row: TakeRow): readonly Other[] {
  const skeleton = findCharacter(document, row.characterId)?.skeleton;
  return takeRows(document)
    .filter(({ key }) => key !== row.key)
    .map((other): Other => {
      const own = findCharacter(document, other.characterId)?.skeleton;
      const match = skeleton && own && matchJoints(skeleton, own);
      if (!match?.first.length) return { other, match, rank: NOTHING_IN_COMMON };
      return { other, match, rank: isSameSkeleton(match) ? 0 : 1 };
    })
    .sort((a, b) => a.rank - b.rank);
}

function inCommon(match: JointMatch | undefined): string {
  return match?.first.length ? `${plural(match.first.length, 'joint')} in common` : 'no joints in common';
}
