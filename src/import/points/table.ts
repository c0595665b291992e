/** Points over time as their readers leave them: labels, and where each is in every frame. */
import { NO_PLACE, type Place } from '../../formats/places.ts';
import { LONGEST_FRAME, SHORTEST_FRAME } from '../../model/takes/samples.ts';
import type { Budget } from '../budget.ts';
import { ImportError } from '../imported.ts';

/** Numbers of a point in a frame: x y z, and 1 if it is there, 0 if it is missing. */
export const POINT_WIDTH = 4;
/** Of those, the one that tells whether the point is there. */
const THERE = 3;
/** Most points of a file, as many as a C3D can count. */
export const MAX_POINTS = 65_535;
/** Larger than any unit makes a place, and small enough to be multiplied a few times. */
export const FARTHEST = 1e30;

/** Thrown inside a reader of points when nothing of the file can be used. */
export class PointsError extends ImportError {
  constructor(
    code: string,
    message: string,
    /** In a text. */
    readonly place: Place,
  ) {
    super(code, message);
  }
}

/** Ends the reading of a file. @param place in a text */
export function fail(code: string, message: string, place = NO_PLACE): never {
  throw new PointsError(code, message, place);
}

/** The points of a file. */
export interface PointTable {
  /** One per point, each once. */
  readonly labels: readonly string[];
  readonly frameCount: number;
  readonly framesPerSecond: number;
  /** Frame by frame, `POINT_WIDTH` numbers of each point. Where one is missing, it stays where it was last. */
  readonly values: Float64Array;
  /** Metres a unit, if the file states its unit. */
  readonly metres?: number;
  /** Whether labels are the numbers that a program which finds people in videos gives to joints. */
  readonly isNumbered?: true;
}

/** Room for the points of all frames. Fails if a file of its size can't have as many. */
export function roomFor(pointCount: number, frameCount: number, budget: Budget): Float64Array {
  const count = POINT_WIDTH * pointCount * frameCount;
  budget.spend(count, `A take of ${pointCount} points and ${frameCount} frames`);
  return new Float64Array(count);
}

/**
 * Fills what is missing: a point stays where it was last, before its first frame where it will be, and one that is never
 * there is in the middle of the others.
 */
export function holdMissing(values: Float64Array, pointCount: number, frameCount: number): void {
  const width = POINT_WIDTH * pointCount;
  const firstFrames = new Int32Array(pointCount).fill(-1);
  for (let frame = 0, at = 0; frame < frameCount; frame++) {
    for (let p = 0; p < pointCount; p++, at += POINT_WIDTH) {
      if (values[at + THERE] === 0) {
        if (firstFrames[p] >= 0) copyPlace(values, at - width, at);
      } else if (firstFrames[p] < 0) firstFrames[p] = frame;
    }
  }
  firstFrames.forEach((first, p) => {
    const from = first * width + POINT_WIDTH * p;
    for (let at = POINT_WIDTH * p; at < from; at += width) copyPlace(values, from, at);
  });
  if (!firstFrames.includes(-1)) return;
  const middle = middleOf(values, firstFrames);
  firstFrames.forEach((first, p) => {
    if (first >= 0) return;
    for (let at = POINT_WIDTH * p; at < values.length; at += width) values.set(middle, at);
  });
}

function copyPlace(values: Float64Array, from: number, to: number): void {
  values[to] = values[from];
  values[to + 1] = values[from + 1];
  values[to + 2] = values[from + 2];
}

/** The mean of the points of the first frame that are ever there; 0 without any. */
function middleOf(values: Float64Array, firstFrames: Int32Array): Float64Array {
  const sum = new Float64Array(3);
  let count = 0;
  firstFrames.forEach((first, p) => {
    if (first < 0) return;
    for (let k = 0; k < 3; k++) sum[k] += values[POINT_WIDTH * p + k];
    count++;
  });
  return sum.map((total) => total / Math.max(1, count));
}

/** Labels for as many points: those that are missing or double are called after their number, `point12`. */
export function labelsFor(given: readonly string[], pointCount: number): readonly string[] {
  const taken = new Set<string>();
  const own = Array.from({ length: pointCount }, (_, p) => {
    const label = given[p] ?? '';
    if (label === '' || taken.has(label)) return '';
    taken.add(label);
    return label;
  });
  return own.map((label, p) => {
    if (label !== '') return label;
    let made = `point${p + 1}`;
    while (taken.has(made)) made += '_';
    taken.add(made);
    return made;
  });
}

/** Whether a take can have that many frames per second. */
export function isRate(framesPerSecond: number): boolean {
  return framesPerSecond >= 1 / LONGEST_FRAME && framesPerSecond <= 1 / SHORTEST_FRAME;
}

/** Metres of the units that files state, by their names in lower case. */
const UNITS: Readonly<Record<string, number>> = {
  ...{ m: 1, meter: 1, meters: 1, metre: 1, metres: 1 },
  ...{ mm: 1e-3, millimeter: 1e-3, millimeters: 1e-3, millimetre: 1e-3, millimetres: 1e-3 },
  ...{ cm: 0.01, centimeter: 0.01, centimeters: 0.01, centimetre: 0.01, centimetres: 0.01 },
  ...{ dm: 0.1, in: 0.0254, inch: 0.0254, inches: 0.0254, ft: 0.3048, foot: 0.3048, feet: 0.3048 },
};

/** Metres of a unit as files name it; undefined if it is none. */
export function metresOf(unit: string): number | undefined {
  const name = unit.trim().toLowerCase();
  return Object.hasOwn(UNITS, name) ? UNITS[name] : undefined;
}
