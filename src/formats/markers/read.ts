/**
 * `NAME.markers.json`, our own format: the markers and labelled spans of the take `NAME`, in seconds of the take.
 *
 *     [ { "time": 1.2, "label": "step" }, { "time": 2, "end": 3.5, "label": "stand" } ]
 */
import { inOrder, type Marker } from '../../model/takes/markers.ts';
import { WHOLE_FILE } from '../places.ts';
import { bytesReader, type Reader } from '../reader.ts';
import type { Report } from '../report.ts';

/** A reader of `.markers.json`; markers that are out of order are sorted by time. */
export function markersReader(fileName: string): Reader<readonly Marker[]> {
  return bytesReader(fileName, (bytes, report) => {
    const rows = rowsIn(new TextDecoder().decode(bytes), report);
    return rows && inOrder(rows.flatMap((row, i) => markerOf(row, i, report) ?? []));
  });
}

function rowsIn(text: string, report: Report): readonly unknown[] | undefined {
  let found: unknown;
  try {
    found = JSON.parse(text);
  } catch (error) {
    const why = error instanceof Error ? error.message : String(error);
    report.error('json-wrong', `Expected JSON: ${why}`, WHOLE_FILE);
    return undefined;
  }
  if (Array.isArray(found)) return found;
  report.error('list-expected', 'Expected a list of markers: [ { "time": 1.2, "label": "step" } ].', WHOLE_FILE);
  return undefined;
}

/** Undefined, with a warning, if it is none. */
function markerOf(row: unknown, index: number, report: Report): Marker | undefined {
  // Only these fields are read, and all are checked.
  const { time, end, label } = (typeof row === 'object' && row ? row : {}) as Readonly<Record<string, unknown>>;
  const isSpan = end !== undefined && end !== null;
  if (!isTime(time) || (isSpan && !(isTime(end) && end >= time))) {
    const meant = 'a time in seconds, and an end that is not before it';
    report.warn('marker-wrong', `Marker ${index + 1}: expected ${meant}.`, WHOLE_FILE, 'left it out');
    return undefined;
  }
  const called = typeof label === 'string' ? label : '';
  return isSpan && isTime(end)
    ? { timeSeconds: time, endSeconds: end, label: called }
    : { timeSeconds: time, label: called };
}

function isTime(value: unknown): value is number {
  return typeof value === 'number' && Number.isFinite(value);
}
