/** What a row of the outliner shows. */

import { setHidden } from '../../../edit/commands/spaces.ts';
import { cutText } from '../../../model/names/cut-text.ts';
import { isSkeletonKind, isTakeKind } from '../../../model/part.ts';
import type { Uses } from '../../state/workbench.ts';
import { element, setAttribute } from '../../widgets/dom.ts';
import { icon } from '../../widgets/icons.ts';
import { setTooltip } from '../../widgets/tooltip.ts';
import { groupKey, type OutlineRow } from './outline-rows.ts';
import { markElement, type RowMark } from './row-marks.ts';

const ICONS = {
  character: 'character',
  joint: 'joint',
  skin: 'skin',
  take: 'take',
  morph: 'morph',
} as const;

/** Of a long name both ends stay readable: what it is on the left, and its side or number on the right. */
const TAIL = 7;

export function drawRow(wb: Uses<'store' | 'files'>, row: OutlineRow, marks: readonly RowMark[]): Node[] {
  const unsaved = isUnsaved(wb, row);
  const unnamed = row.kind === 'joint' ? `joint ${row.detail}` : 'unnamed';
  const label = row.label === '' ? element('i', { class: 'label' }, unnamed) : element('span', { class: 'label' });
  const name = cutText(row.label);
  if (name) {
    if (name.length <= 2 * TAIL) label.textContent = name;
    else {
      // Read as one word.
      setAttribute(label, 'role', 'img');
      setAttribute(label, 'aria-label', name);
      label.append(
        element('span', { class: 'label-head' }, name.slice(0, -TAIL)),
        element('span', {}, name.slice(-TAIL)),
      );
    }
    setTooltip(label, row.name ?? row.label);
  }
  const isTold = row.kind === 'joint' && row.label === '';
  const detail = isTold ? '' : row.detail;
  const nodes: Node[] = [label, element('span', { class: 'detail', tooltip: detail }, detail)];
  if (unsaved)
    nodes.splice(
      1,
      0,
      element('span', { class: 'unsaved-dot', role: 'img', 'aria-label': 'Not saved', tooltip: 'Not saved' }),
    );
  if (marks.length > 0) nodes.splice(1, 0, ...marks.map(markElement));
  if (row.shown !== undefined) nodes.unshift(element('span', { class: 'radio', 'aria-hidden': 'true' }));
  else if (row.kind !== 'group') nodes.unshift(icon(ICONS[row.kind]));
  if (row.kind === 'character') nodes.push(eyeOf(wb, row));
  return nodes;
}

/** For the mouse; by keyboard the row's menu does the same. Children of rows are no tab stops. */
function eyeOf(wb: Uses<'store'>, { characterId, label, hidden = false }: OutlineRow): HTMLElement {
  const text = `${hidden ? 'Show' : 'Hide'} ${label}`;
  const eye = element(
    'button',
    {
      type: 'button',
      class: 'eye',
      tabindex: '-1',
      'aria-pressed': String(hidden),
      'aria-label': text,
      tooltip: text,
    },
    icon(hidden ? 'eyeOff' : 'eye'),
  );
  eye.addEventListener('click', (event) => {
    event.stopPropagation();
    wb.store.apply(setHidden, { ids: [characterId], hidden: !hidden });
  });
  eye.addEventListener('dblclick', (event) => event.stopPropagation());
  return eye;
}

/** Whether a row's part is unsaved; the joints represent the skeleton's file. */
function isUnsaved(wb: Uses<'files'>, { kind, key, characterId, index }: OutlineRow): boolean {
  const isSkeleton = key === groupKey(characterId, 'joint');
  if (!isSkeleton && kind !== 'skin' && kind !== 'morph' && kind !== 'take') return false;
  return wb.files.unsaved.get().some((part) => {
    if (part.characterId !== characterId) return false;
    // Motion capture has skeleton and take in one file.
    if (part.kind === 'bvh') return kind === 'take' && part.index === index;
    if (isSkeleton) return isSkeletonKind(part.kind);
    return (kind === 'take' ? isTakeKind(part.kind) : part.kind === kind) && part.index === index;
  });
}
