/** Markers of a take whose times change. */

import type { Marker } from '../model/takes/markers.ts';

/** Times closer than this are the same. */
const SAME_TIME = 1e-9;

/** At other times. If time runs backwards, spans begin at their ends. */
export function retimed(markers: readonly Marker[] = [], at: (seconds: number) => number): readonly Marker[] {
  return markers.map(({ timeSeconds, endSeconds, label }) => {
    if (endSeconds === undefined) return { timeSeconds: at(timeSeconds), label };
    const [a, b] = [at(timeSeconds), at(endSeconds)];
    return { timeSeconds: Math.min(a, b), endSeconds: Math.max(a, b), label };
  });
}

/** Those from one time to another, both included; spans are cut there. */
export function markersWithin(markers: readonly Marker[] = [], from: number, to: number): readonly Marker[] {
  return markers.flatMap((marker): readonly Marker[] => {
    const { timeSeconds, endSeconds } = marker;
    if ((endSeconds ?? timeSeconds) < from - SAME_TIME || timeSeconds > to + SAME_TIME) return [];
    if (endSeconds === undefined || (timeSeconds >= from && endSeconds <= to)) return [marker];
    return [{ ...marker, timeSeconds: Math.max(from, timeSeconds), endSeconds: Math.min(to, endSeconds) }];
  });
}

/** Those that lie between two frames that are no longer neighbours: each at the nearer of these. */
export function markersBeside(markers: readonly Marker[] = [], before: number, after: number): readonly Marker[] {
  const nearer = (seconds: number) => (seconds - before <= after - seconds ? before : after);
  return markers.flatMap((marker) => {
    const isBetween = marker.timeSeconds > before && (marker.endSeconds ?? marker.timeSeconds) < after;
    return isBetween ? retimed([marker], nearer) : [marker];
  });
}

/**
 * After time was taken out or put in at one time: later ones move along, spans across it become shorter or longer. What
 * was inside of time that was taken out is gone.
 * @param seconds added; negative: those after `atSeconds` that are removed
 */
export function rippledMarkers(markers: readonly Marker[] = [], atSeconds: number, seconds: number): readonly Marker[] {
  const gone = Math.max(0, -seconds);
  const at = (time: number) => {
    if (time < atSeconds - SAME_TIME) return time;
    return Math.max(atSeconds, time + seconds);
  };
  return markers.flatMap((marker): readonly Marker[] => {
    const { timeSeconds, endSeconds = timeSeconds } = marker;
    const isInside = (time: number) => time > atSeconds - SAME_TIME && time < atSeconds + gone - SAME_TIME;
    if (gone > 0 && isInside(timeSeconds) && isInside(endSeconds)) return [];
    return retimed([marker], at);
  });
}
