/** Writes `.markers.json`, a line for each marker. (`JSON.stringify` would write NaN as null, and −0 as 0.) */
import type { Marker } from '../../model/takes/markers.ts';
import type { WriteResult } from '../reader.ts';
import { Text } from '../write-text.ts';

/** Writes a `.markers.json`. @param fileName appears in diagnostics */
export function writeMarkers(markers: readonly Marker[], fileName = ''): WriteResult {
  const text = new Text(fileName);
  const lines = markers.map(({ timeSeconds, endSeconds, label }, i) => {
    text.about(`marker ${i + 1}`);
    const end = endSeconds === undefined ? '' : `,"end":${text.number(endSeconds)}`;
    return `{"time":${text.number(timeSeconds)}${end},"label":${JSON.stringify(label)}}`;
  });
  return { text: lines.length ? `[\n  ${lines.join(',\n  ')}\n]\n` : '[]\n', diagnostics: [] };
}
