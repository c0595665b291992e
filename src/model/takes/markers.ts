/** Labels of times and spans of a take. */
export interface Marker {
  /** Seconds of the take. */
  readonly timeSeconds: number;
  /** The end of a labelled span; at least `timeSeconds`. Absent: a marker of one time. */
  readonly endSeconds?: number;
  /** May be empty. */
  readonly label: string;
}

/** The end of what its files are called: `walk.markers.json`. */
export const MARKERS_EXTENSION = 'markers.json';

/** By time; of equal times, spans after single times. */
export function inOrder(markers: readonly Marker[]): readonly Marker[] {
  const end = ({ timeSeconds, endSeconds = timeSeconds }: Marker) => endSeconds;
  return markers.toSorted((a, b) => a.timeSeconds - b.timeSeconds || end(a) - end(b));
}
