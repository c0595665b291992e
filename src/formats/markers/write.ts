/** Writes `.markers.json`, a line for each marker. */
import type { Marker } from '../../model/markers.ts';
import type { WriteResult } from '../reader.ts';

export function writeMarkers(markers: readonly Marker[]): WriteResult {
  const lines = markers.map(({ timeSeconds, endSeconds, label }) =>
    JSON.stringify({ time: timeSeconds, ...(endSeconds !== undefined && { end: endSeconds }), label }),
  );
  return { text: lines.length ? `[\n  ${lines.join(',\n  ')}\n]\n` : '[]\n', diagnostics: [] };
}
