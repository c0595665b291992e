/** Times of dumps, and of a character's take, beside those of the transport. */
import type { Playback } from '../../edit/playback.ts';
import { type Character, isMoved } from '../../model/document.ts';
import { isUntimed } from '../../model/dump.ts';
import type { NamedDump } from '../../teaching/dump/fit-dump.ts';
import type { Observable } from '../widgets/observable.ts';

/** Of the workbench. */
interface Clock {
  readonly transport: Observable<Playback>;
}

/** Seconds of the transport at which a time of the character's take is shown. */
export function transportTimeOf(character: Character, takeTime: number): number {
  return takeTime - offsetOf(character);
}

/** Seconds of the take at the transport's 0. A retargeted take has its own start. */
export function offsetOf({ driver, timeOffsetSeconds }: Character): number {
  return driver ? 0 : timeOffsetSeconds;
}

/** Time of the take that is shown; undefined if nothing moves the character: then the file pose is shown. */
export function takeTimeShown({ transport }: Clock, character: Character | undefined): number | undefined {
  if (!character || !isMoved(character)) return undefined;
  return transport.get().timeSeconds + offsetOf(character);
}

/**
 * The frame nearest to the time shown, within half a frame of the transport; −1 if there is none. What nothing moves is
 * in one pose at all times: its nearest frame is shown however far it is.
 */
export function frameShown(
  wb: Clock,
  character: Character,
  frames: readonly { readonly time: number | undefined }[],
): number {
  const { timeSeconds, framesPerSecond } = wb.transport.get();
  const isStill = !isMoved(character);
  const now = timeSeconds + offsetOf(character);
  let best = -1;
  // A little more, so that a time between two frames is always shown with one of them.
  let distance = isStill ? Number.POSITIVE_INFINITY : (0.5 + 1e-6) / framesPerSecond;
  frames.forEach(({ time = isStill ? 0 : Number.POSITIVE_INFINITY }, i) => {
    const own = Math.abs(time - now);
    if (own > distance || (own === distance && best >= 0)) return;
    best = i;
    distance = own;
  });
  return best;
}

/** Times that dumps state, ascending. */
export function statedTimes(dumps: readonly NamedDump[]): readonly number[] {
  const times = new Set<number>();
  for (const { dump } of dumps) {
    for (const block of dump.blocks) {
      const time = block.time ?? dump.time;
      if (time !== undefined) times.add(time);
    }
  }
  return [...times].sort((a, b) => a - b);
}

/** Whether all numbers of a dump have a time, or are of channels. */
export function statesTime({ dump }: NamedDump): boolean {
  return dump.time !== undefined || !dump.blocks.some(isUntimed);
}
