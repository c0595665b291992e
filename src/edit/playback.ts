/**
 * The transport: the current time and how it advances. A value and pure functions without a clock: the page passes the
 * elapsed seconds. (three.js's mixer has its own wrapping at the ends, so it is only ever told the time.)
 */
export const LOOP_MODES = ['once', 'loop', 'pingpong', 'continue'] as const;
/** `continue` plays past the range, to show extrapolation. */
export type LoopMode = (typeof LOOP_MODES)[number];

/** The state of the transport; times are seconds of the transport. */
export interface Playback {
  readonly timeSeconds: number;
  readonly playing: boolean;
  /** First and last second that play. */
  readonly range: readonly [number, number];
  readonly loop: LoopMode;
  /** Playback speed, −4 to 4. */
  readonly rate: number;
  /** Whether ping-pong is on its way back; the speed itself is unchanged. */
  readonly turned: boolean;
  /** For display in frames and steps by frame; within `FRAME_RATES`. */
  readonly framesPerSecond: number;
}

/** Minimum and maximum FPS for display in frames. */
export const FRAME_RATES = [1, 1000] as const;

/** The transport of a page that has opened nothing: paused at 0, looping. */
export const DEFAULT_PLAYBACK: Playback = {
  timeSeconds: 0,
  playing: false,
  // Some time for posing before there is any take.
  range: [0, 2],
  loop: 'loop',
  rate: 1,
  turned: false,
  framesPerSecond: 30,
};

/**
 * The transport after `elapsedSeconds` of the clock. `once` stops at the end; `pingpong` reverses at both ends, and
 * continues in the same direction after a pause.
 */
export function advance(playback: Playback, elapsedSeconds: number): Playback {
  if (!playback.playing || elapsedSeconds === 0) return playback;
  const { loop, range } = playback;
  const [start, end] = range;
  const length = end - start;
  const rate = loop === 'pingpong' && playback.turned ? -playback.rate : playback.rate;
  const timeSeconds = playback.timeSeconds + elapsedSeconds * rate;
  if (loop === 'continue') return { ...playback, timeSeconds };
  if (length <= 0) return { ...playback, timeSeconds: start, playing: loop !== 'once' };
  if (timeSeconds >= start && timeSeconds <= end) return { ...playback, timeSeconds };
  switch (loop) {
    case 'once':
      // Playing away from the range continues forever; playing back towards it continues too.
      if (rate > 0 ? timeSeconds < start : timeSeconds > end) return { ...playback, timeSeconds };
      return { ...playback, timeSeconds: rate > 0 ? end : start, playing: false };
    case 'loop':
      return { ...playback, timeSeconds: start + modulo(timeSeconds - start, length) };
    case 'pingpong': {
      const along = modulo(timeSeconds - start, 2 * length);
      const turns = Math.floor((timeSeconds - start) / length) % 2 !== 0;
      return {
        ...playback,
        timeSeconds: start + (along > length ? 2 * length - along : along),
        turned: turns ? !playback.turned : playback.turned,
      };
    }
  }
}

/** Starts playing; from the other end if `once` had reached its end. */
export function play(playback: Playback): Playback {
  const [start, end] = playback.range;
  const atEnd = playback.rate >= 0 ? playback.timeSeconds >= end : playback.timeSeconds <= start;
  const timeSeconds = playback.loop === 'once' && atEnd ? (playback.rate >= 0 ? start : end) : playback.timeSeconds;
  return { ...playback, timeSeconds, playing: true, turned: playback.loop === 'pingpong' && playback.turned };
}

/**
 * Pauses at the current time, or on the nearest frame if times are shown in frames. If the range doesn't end on a
 * frame, on the nearest one inside.
 */
export function pause(playback: Playback, onFrame: boolean): Playback {
  const { timeSeconds, framesPerSecond, range } = playback;
  const stopped = { ...playback, playing: false };
  if (!onFrame) return stopped;
  const isInside = (time: number) => time >= range[0] && time <= range[1];
  const at = timeSeconds * framesPerSecond;
  // Adding 0 avoids −0.
  const near = [Math.round(at), Math.floor(at), Math.ceil(at)].map((frame) => (frame + 0) / framesPerSecond);
  const found = isInside(timeSeconds) ? near.find(isInside) : near[0];
  return { ...stopped, timeSeconds: found ?? timeSeconds };
}

/** Moves a time beyond the range to its nearer end. */
export function intoRange(playback: Playback): Playback {
  const { range, timeSeconds } = playback;
  const inside = Math.min(range[1], Math.max(range[0], timeSeconds));
  return inside === timeSeconds ? playback : { ...playback, timeSeconds: inside };
}

/** Uses this frame rate for display, if it is valid; otherwise unchanged. */
export function countedAt(playback: Playback, framesPerSecond: number | undefined): Playback {
  const [least, most] = FRAME_RATES;
  if (framesPerSecond === undefined || framesPerSecond < least || framesPerSecond > most) return playback;
  return playback.framesPerSecond === framesPerSecond ? playback : { ...playback, framesPerSecond };
}

/** Steps by whole frames on the frame grid; from between two frames, to the next one in that direction. */
export function stepFrames(playback: Playback, frames: number): Playback {
  const at = playback.timeSeconds * playback.framesPerSecond;
  // A time that is a frame up to rounding counts as that frame.
  const from = Math.abs(at - Math.round(at)) < 1e-6 ? Math.round(at) : frames > 0 ? Math.floor(at) : Math.ceil(at);
  return { ...playback, timeSeconds: (from + frames) / playback.framesPerSecond, playing: false };
}

function modulo(a: number, n: number): number {
  return ((a % n) + n) % n;
}
