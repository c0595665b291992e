/** The markers of the current character's take, at times of the transport. */

import { shownTake } from '../../../../model/document.ts';
import type { Take } from '../../../../model/takes/take.ts';
import { currentCharacter } from '../../../state/actions/action.ts';
import type { Uses } from '../../../state/workbench.ts';
import { NO_MARKERS, type ShownMarker } from '../../../widgets/time/markers-picture.ts';

/** In the order of the take's markers. */
export function shownMarkers(wb: Uses<'store'>): readonly ShownMarker[] {
  const character = currentCharacter(wb);
  const take = character && shownTake(character);
  return take ? markersAt(take, character.timeOffsetSeconds) : NO_MARKERS;
}

function markersAt({ markers }: Pick<Take, 'markers'>, offsetSeconds: number): readonly ShownMarker[] {
  if (!markers) return NO_MARKERS;
  if (offsetSeconds === 0) return markers;
  return markers.map(({ timeSeconds, endSeconds, label }) => ({
    timeSeconds: timeSeconds - offsetSeconds,
    ...(endSeconds !== undefined && { endSeconds: endSeconds - offsetSeconds }),
    label,
  }));
}
