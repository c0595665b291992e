/** Adds markers at the current time, or a span over the playback range, and goes from one to the next. */
import { addMarkers } from '../../../../edit/commands/markers.ts';
import type { Uses } from '../../../state/workbench.ts';
import { currentTake, takeTime } from '../current-take.ts';

type Page = Uses<'store' | 'transport' | 'messages' | 'dialog'>;

export function addMarkerHere(wb: Page): void {
  const current = currentTake(wb);
  if (!current) return;
  const { character, take } = current;
  const label = String((take.markers?.length ?? 0) + 1);
  const marker = { timeSeconds: takeTime(wb, character), label };
  wb.store.apply(addMarkers, { characterId: character.id, markers: [marker] });
  wb.messages.note(`Marker ${label} added. Name it in Play > Markers.`);
}

export function addSpanOfRange(wb: Page): void {
  const current = currentTake(wb);
  if (!current) return;
  const { character, take } = current;
  const [from, to] = wb.transport.get().range.map((seconds) => seconds + character.timeOffsetSeconds);
  const label = String((take.markers?.length ?? 0) + 1);
  const span = { timeSeconds: from, endSeconds: to, label };
  wb.store.apply(addMarkers, { characterId: character.id, markers: [span] });
  wb.dialog.set('markers');
}
