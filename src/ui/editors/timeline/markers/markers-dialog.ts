/** The markers of the current take as a list: times, labels, going to one, deleting it. Each change is an undo step. */
import { changeMarker, removeMarkers } from '../../../../edit/commands/markers.ts';
import type { Marker } from '../../../../model/takes/markers.ts';
import { attempt } from '../../../state/actions/attempt.ts';
import { untilClosed } from '../../../state/until-closed.ts';
import type { Uses } from '../../../state/workbench.ts';
import type { DialogContent } from '../../../widgets/dialog.ts';
import { button, element } from '../../../widgets/dom.ts';
import { plainButton } from '../../../widgets/form/form.ts';
import { icon } from '../../../widgets/icons.ts';
import { parseNumber } from '../../../widgets/numbers/number-text.ts';
import { currentTake } from '../current-take.ts';
import { addMarkerHere, addSpanOfRange } from './marker-edits.ts';

type Page = Uses<'store' | 'transport' | 'messages' | 'dialog'>;

const DIGITS = 4;

export function markersDialog(wb: Page, close: () => void): DialogContent {
  const rows = element('div', { class: 'marker-rows', role: 'list' });
  const add = plainButton('Add at current time', () => {
    attempt(wb.messages, () => addMarkerHere(wb));
    rows.querySelector<HTMLInputElement>('.marker-row:last-child input')?.select();
  });
  const span = plainButton('Add span of playback range', () => attempt(wb.messages, () => addSpanOfRange(wb)));
  const done = element('button', { type: 'button', class: 'plain primary' }, 'Done');
  let shown: readonly Marker[] | undefined;
  const show = (force = false) => {
    const markers = currentTake(wb)?.take.markers ?? [];
    if (markers === shown && !force) return;
    shown = markers;
    rows.replaceChildren(
      ...(markers.length
        ? markers.map((marker, i) => markerRow(wb, marker, i))
        : [element('p', { class: 'empty' }, 'This take has no markers. M adds one at the current time.')]),
    );
  };
  done.addEventListener('click', close);
  untilClosed(wb).addEventListener(
    'abort',
    wb.store.subscribe(() => show()),
  );
  show(true);
  const body = element(
    'div',
    { class: 'tool-form' },
    element(
      'p',
      { class: 'faint' },
      `For ${currentTake(wb)?.take.name ?? 'no take'}. Saved next to it as .markers.json.`,
    ),
    rows,
    element('div', { class: 'tool-buttons' }, add, span, done),
  );
  return { title: 'Markers', body, kind: 'tool-dialog markers-dialog', stays: true };
}

function markerRow(wb: Page, marker: Marker, index: number): HTMLElement {
  const current = currentTake(wb);
  const offset = current?.character.timeOffsetSeconds ?? 0;
  const characterId = current?.character.id ?? '';
  const change = (next: Marker) =>
    attempt(wb.messages, () => wb.store.apply(changeMarker, { characterId, index, marker: next }));
  const label = element('input', { type: 'text', value: marker.label, 'aria-label': `Label of marker ${index + 1}` });
  label.addEventListener('change', () => change({ ...marker, label: label.value }));
  const time = timeField(marker.timeSeconds - offset, `Time of marker ${index + 1}`, (seconds) => {
    if (seconds !== undefined) change({ ...marker, timeSeconds: seconds + offset });
  });
  const { endSeconds: end, ...single } = marker;
  const until = timeField(end === undefined ? undefined : end - offset, `End of marker ${index + 1}`, (seconds) =>
    change(seconds === undefined ? single : { ...marker, endSeconds: seconds + offset }),
  );
  const go = () => wb.transport.update((p) => ({ ...p, timeSeconds: marker.timeSeconds - offset, playing: false }));
  const remove = () => attempt(wb.messages, () => wb.store.apply(removeMarkers, { characterId, indices: [index] }));
  return element(
    'div',
    { class: 'marker-row', role: 'listitem' },
    label,
    time,
    element('span', { class: 'faint' }, '–'),
    until,
    button(`Go to marker ${index + 1}`, { class: 'tool' }, icon('frame'), go),
    button(`Delete marker ${index + 1}`, { class: 'tool' }, icon('close'), remove),
  );
}

/** In seconds of the transport; an empty field is undefined. */
function timeField(
  seconds: number | undefined,
  name: string,
  set: (seconds: number | undefined) => void,
): HTMLInputElement {
  const value = seconds === undefined ? '' : String(Number(seconds.toFixed(DIGITS)));
  const field = element('input', {
    type: 'text',
    inputmode: 'decimal',
    class: 'number-field',
    value,
    'aria-label': name,
  });
  field.addEventListener('change', () => {
    const typed = field.value.trim() === '' ? undefined : parseNumber(field.value);
    if (typed === undefined && field.value.trim() !== '') field.value = value;
    else set(typed);
  });
  return field;
}
