/** Views as numbers in a text: of links, and of the element of other pages. */
import type { CameraView } from './camera.ts';

/** Beyond it, single-precision numbers of the graphics card are no places any more. */
const FARTHEST = 1e6;

/** Numbers with commas between; undefined if they aren't as many, or one is none or too large. */
export function numbersIn(text: string, count: number): readonly number[] | undefined {
  const all = text.split(',').map((part) => (part.trim() === '' ? Number.NaN : Number(part)));
  return all.length === count && all.every((value) => Math.abs(value) <= FARTHEST) ? all : undefined;
}

/** The view of a camera; undefined if it is where it looks, or straight above or below, where no side is up. */
export function viewOf(numbers: readonly number[] | undefined): CameraView | undefined {
  if (!numbers) return undefined;
  const [x, y, z, tx, ty, tz] = numbers;
  const distance = Math.hypot(x - tx, y - ty, z - tz);
  if (!(distance > 0)) return undefined;
  return {
    target: [tx, ty, tz],
    distance,
    polar: Math.acos(Math.max(-1, Math.min(1, (y - ty) / distance))),
    azimuth: Math.atan2(x - tx, z - tz),
  };
}

/** The six numbers of a view. */
export function numbersOf({ target: [tx, ty, tz], distance, polar, azimuth }: CameraView): readonly number[] {
  const flat = distance * Math.sin(polar);
  const from = [tx + flat * Math.sin(azimuth), ty + distance * Math.cos(polar), tz + flat * Math.cos(azimuth)];
  return [...from, tx, ty, tz];
}
