/** The takes that one can be compared with, as a menu. */
import { type ComparedJoints, comparedJoints } from '../../../evaluate/compare/compared-joints.ts';
import type { Document } from '../../../model/document.ts';
import { showing } from '../../state/takes.ts';
import type { Uses } from '../../state/workbench.ts';
import type { MenuEntry } from '../../widgets/menu.ts';
import { plural } from '../../widgets/numbers/number-text.ts';
import { type TakeRow, takeRows } from './rows.ts';
import { compareTakes } from './start-comparison.ts';

/** `Compare with…` as one entry of a menu: the only other take, or a submenu of all; none without another. */
export function compareWith(
  wb: Uses<'store' | 'viewport' | 'transport' | 'timeline' | 'messages' | 'dialog'>,
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
  wb: Uses<'store' | 'viewport' | 'transport' | 'timeline' | 'messages' | 'dialog'>,
  row: TakeRow,
): readonly MenuEntry[] {
  const others = othersOf(wb.store.document, row);
  const entries = others.flatMap(({ other, match, rank }, i): MenuEntry[] => {
    const run = () => compareTakes(wb, row, other);
    const detail = [other.note || other.character, rank === 0 ? '' : inCommon(match)].filter(Boolean).join(', ');
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
  readonly match: ComparedJoints | undefined;
  /** 0: the same skeleton; 1: some joints in common; 2: none. */
  readonly rank: 0 | 1 | typeof NOTHING_IN_COMMON;
}

function othersOf(document: Document, row: TakeRow): readonly Other[] {
  const own = showing(document, row);
  return takeRows(document)
    .filter(({ key }) => key !== row.key)
    .map((other): Other => {
      const its = showing(document, other);
      const match = own && its && comparedJoints(own, its);
      if (!match?.first.length) return { other, match, rank: NOTHING_IN_COMMON };
      return { other, match, rank: match.isSame ? 0 : 1 };
    })
    .sort((a, b) => a.rank - b.rank);
}

function inCommon(match: ComparedJoints | undefined): string {
  return match?.first.length ? `${plural(match.first.length, 'joint')} in common` : 'no joints in common';
}
