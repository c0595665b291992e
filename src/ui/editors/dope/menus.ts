/** Context menus of the dope sheet, for keys and rows. */
import { areSelected } from '../../../edit/keys/row-keys.ts';
import { allKeys, countKeys, keysAtTime, unionKeys } from '../../../edit/keys/selection.ts';
import { sectionsOf } from '../../state/actions/menu-entries.ts';
import type { Uses } from '../../state/workbench.ts';
import { type MenuEntry, type MenuPlace, openMenu } from '../../widgets/menu.ts';
import { plural } from '../../widgets/numbers/number-text.ts';
import { selectedKeys, selectedKeysInView, selectKeys } from '../timeline/current-take.ts';
import type { DopeRow } from '../timeline/dope-rows.ts';
import { insertAtPlayhead } from '../timeline/key-edits.ts';
import { timelineTake } from '../timeline/timeline-take.ts';
import type { SheetHit } from './hit.ts';
import { rowName } from './names.ts';
import { showCurves } from './show-curves.ts';

/** Actions, or a menu of the menu bar as a submenu. */
const KEY_IDS = [
  ['timeline.cut', 'timeline.copy', 'timeline.paste', 'timeline.duplicate', 'timeline.delete'],
  ['Keys/Tangents', 'timeline.snapToFrames', 'timeline.scaleKeys', 'dope.rippleEarlier', 'dope.rippleLater'],
  ['dope.curves', 'timeline.fitSelected'],
] as const;
const EMPTY_IDS = [
  ['timeline.paste', 'timeline.pasteInsert'],
  ['timeline.selectAll', 'timeline.selectBefore', 'timeline.selectHere', 'timeline.selectAfter', 'timeline.selectNone'],
  ['dope.allRows', 'dope.unfoldAll', 'dope.foldAll', 'timeline.fitAll'],
] as const;

const ATTACHED_IDS = [['character.putDown', 'character.detach', 'character.attach']] as const;

/**
 * The menu at a point of the sheet; by keyboard that of the selected keys, if there are any. Keys there are selected
 * first, so that the menu applies to what was clicked.
 */
export function sheetMenu(
  wb: Uses<'store' | 'actions' | 'transport' | 'timeline' | 'settings'>,
  rows: readonly DopeRow[],
  hit: SheetHit,
  at: MenuPlace,
): void {
  if (at.byKeyboard && selectedKeysInView(wb).length) show(wb, KEY_IDS, [], at, 'Keys');
  else if (hit.kind === 'keys' || hit.kind === 'strip') keysMenu(wb, rows, hit, at);
  else if (hit.kind === 'row') rowMenu(wb, rows[hit.row], at);
  else show(wb, EMPTY_IDS, [], at, 'Dope sheet');
}

function keysMenu(
  wb: Uses<'store' | 'actions' | 'transport' | 'timeline' | 'settings'>,
  rows: readonly DopeRow[],
  hit: SheetHit,
  at: MenuPlace,
): void {
  const own: MenuEntry[] = [];
  if (hit.kind === 'keys') {
    if (!areSelected(hit.keys, selectedKeysInView(wb))) selectKeys(wb, hit.keys);
    const { timeSeconds } = hit;
    own.push(
      item('Go to this time', () => wb.transport.update((p) => ({ ...p, timeSeconds, playing: false }))),
      item('Select all keys at this time', () => {
        const current = timelineTake(wb);
        if (!current) return;
        const takeSeconds = timeSeconds + current.character.timeOffsetSeconds;
        selectKeys(wb, keysAtTime(current.take, rows[0].channels, takeSeconds));
      }),
    );
  }
  show(wb, KEY_IDS, own, at, 'Keys');
}

/** The menu of a row, on its name as well as beside its keys. */
export function rowMenu(
  wb: Uses<'store' | 'actions' | 'transport' | 'timeline' | 'settings'>,
  row: DopeRow,
  at: MenuPlace,
): void {
  const current = timelineTake(wb);
  if (!current) return;
  if (row.kind === 'attached') {
    show(wb, ATTACHED_IDS, [], at, rowName(row));
    return;
  }
  const keys = allKeys(current.take, row.channels);
  const count = countKeys(current.take.channels, keys);
  const name = rowName(row);
  const own: MenuEntry[] = [
    item(`Select ${plural(count, 'key')} in row`, () => selectKeys(wb, keys), count > 0),
    item('Add to selection', () => selectKeys(wb, unionKeys(selectedKeys(wb), keys)), count > 0),
    item('Insert keys at current time', () => insertAtPlayhead(wb, row.channels), row.channels.length > 0),
    item('Show curves', () => showCurves(wb, row.channels)),
  ];
  show(wb, EMPTY_IDS, own, at, name);
}

function show(
  wb: Uses<'actions' | 'settings'>,
  sections: readonly (readonly string[])[],
  first: readonly MenuEntry[],
  at: MenuPlace,
  label: string,
): void {
  openMenu(at, sectionsOf(wb, [first, ...sections]), { label });
}

function item(label: string, run: () => void, enabled = true): MenuEntry {
  return { kind: 'item', label, enabled, run };
}
