/** When ghosts are: some before and some after the current time, apart by a step or at keys. */
import { playedTake } from '../../evaluate/bake.ts';
import { lastNotAbove } from '../../math/search.ts';
import { type Character, shownTake } from '../../model/document.ts';
import { perObject } from '../../model/per-object.ts';
import { type Display, MAX_GHOSTS } from '../../model/session.ts';
import type { Take } from '../../model/takes/take.ts';

/** Of the range's ends, and of times that are the same; seconds. */
const SLACK = 1e-9;
const SAME_TIME = 1e-6;

/** Seconds between two ghosts that are a step apart. @param framesPerSecond for takes without frames of their own */
export function ghostStepSeconds(character: Character, display: Display, framesPerSecond: number): number {
  const { ghostStepIn, ghostStep } = display;
  if (ghostStepIn === 'seconds') return ghostStep;
  const frameSeconds = shownTake(character)?.samples?.frameSeconds ?? 1 / framesPerSecond;
  // Each frame of samples is a key.
  return ghostStepIn === 'keys' ? frameSeconds : ghostStep * frameSeconds;
}

/** Filled for each frame, without allocating. */
export class GhostTimes {
  count = 0;
  /** Seconds of the transport, ascending. */
  readonly times = new Float64Array(2 * MAX_GHOSTS);
  /** How many ghosts away from the current time each is: −2 −1 1 2. */
  readonly steps = new Int32Array(2 * MAX_GHOSTS);

  /** Those of a character in the playback range. */
  fill(
    character: Character,
    display: Display,
    timeSeconds: number,
    range: readonly [number, number],
    framesPerSecond: number,
  ): void {
    this.count = 0;
    const take = playedTake(character);
    const keys = display.ghostStepIn === 'keys' && take ? keyTimesOf(take) : NO_TIMES;
    if (keys.length > 0) this.atKeys(keys, offsetOf(character), display, timeSeconds, range);
    else this.apart(ghostStepSeconds(character, display, framesPerSecond), display, timeSeconds, range);
  }

  private apart(stepSeconds: number, display: Display, now: number, range: readonly [number, number]): void {
    if (!(stepSeconds > 0)) return;
    for (let k = -display.ghostsBefore; k <= display.ghostsAfter; k++) {
      if (k !== 0) this.add(now + k * stepSeconds, k, range);
    }
  }

  private atKeys(
    keys: Float64Array,
    offset: number,
    display: Display,
    now: number,
    range: readonly [number, number],
  ): void {
    const before = notAbove(keys, now + offset - SAME_TIME);
    const after = notAbove(keys, now + offset + SAME_TIME);
    for (let k = -display.ghostsBefore; k < 0; k++) {
      if (before + k >= 0) this.add(keys[before + k] - offset, k, range);
    }
    for (let k = 1; k <= display.ghostsAfter; k++) {
      if (after + k - 1 < keys.length) this.add(keys[after + k - 1] - offset, k, range);
    }
  }

  private add(time: number, step: number, [start, end]: readonly [number, number]): void {
    if (!(time >= start - SLACK && time <= end + SLACK)) return;
    this.times[this.count] = time;
    this.steps[this.count++] = step;
  }
}

const NO_TIMES = new Float64Array(0);

/** How many times are at or before this. */
function notAbove(times: Float64Array, time: number): number {
  return times[0] > time ? 0 : lastNotAbove(times, 0, times.length, time) + 1;
}

/** The times of all keys of a take, or of its active layer, ascending and each once. */
const keyTimesOf = perObject(({ channels }: Take): Float64Array => {
  const times = new Set<number>();
  for (const channel of channels) if (channel.kind === 'keys') for (const time of channel.times) times.add(time);
  const all = Float64Array.from(times).sort();
  return all.filter((time, k) => k === 0 || time - all[k - 1] > SAME_TIME);
});

/** Added to times of the transport for those of the take. */
function offsetOf({ timeOffsetSeconds, driver }: Character): number {
  return timeOffsetSeconds + (driver?.source.timeOffsetSeconds ?? 0);
}
