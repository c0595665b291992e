/** What all checks of takes share. */
import { type Flag, type FlagKind, MAX_FLAGS } from '../flags.ts';
import type { TakeFrames } from '../frames.ts';

/** One check of a take. Frames come in order; a frame allocates nothing unless it has a flag. */
export interface Check {
  /**
   * @param points x y z of each joint and End Site, metres
   * @param dofs all of the character's
   */
  frame(frame: number, points: Float64Array, dofs: Float64Array): void;
  /** After the last frame. */
  end(): readonly Flag[];
}

/** The points of the last frames. */
export class RecentPoints {
  private readonly ring: readonly Float64Array[];
  private next = 0;
  private held = 0;

  constructor(length: number, values: number) {
    this.ring = Array.from({ length }, () => new Float64Array(values));
  }

  push(points: Float64Array): void {
    this.ring[this.next].set(points);
    this.next = (this.next + 1) % this.ring.length;
    this.held = Math.min(this.held + 1, this.ring.length);
  }

  get isFull(): boolean {
    return this.held === this.ring.length;
  }

  /** Points so many frames ago; 0 is the newest. */
  ago(frames: number): Float64Array {
    const { length } = this.ring;
    return this.ring[(this.next - 1 - frames + 2 * length) % length];
  }
}

/** A span of frames that is open while something lasts; a flag when it ends. */
export class Span {
  private first = -1;
  private last = -1;
  amount = 0;

  /** @param gap frames that may lack it within one span */
  constructor(private readonly gap: number) {}

  get isOpen(): boolean {
    return this.first >= 0;
  }

  /** Frames from the first to the last, both included. */
  get length(): number {
    return this.isOpen ? this.last - this.first + 1 : 0;
  }

  get start(): number {
    return this.first;
  }

  get end(): number {
    return this.last;
  }

  add(frame: number, amount: number): void {
    if (this.first < 0) {
      this.first = frame;
      this.amount = 0;
    }
    this.last = frame;
    if (amount > this.amount) this.amount = amount;
  }

  /** Whether no frame was added for longer than the gap. */
  isOver(frame: number): boolean {
    return this.isOpen && frame - this.last > this.gap;
  }

  clear(): void {
    this.first = -1;
    this.last = -1;
    this.amount = 0;
  }
}

/** A flag from frame to frame. */
export function flagOf(
  frames: TakeFrames,
  kind: FlagKind,
  first: number,
  last: number,
  amount: number,
  joint = -1,
): Flag {
  const name = joint < 0 ? '' : frames.nameOf(joint);
  return {
    kind,
    from: frames.secondsOf(first),
    to: frames.secondsOf(last),
    amount,
    ...(name !== '' && { joint: name }),
  };
}

/** The largest of too many, in order of time. */
export function largest(flags: readonly Flag[]): readonly Flag[] {
  if (flags.length <= MAX_FLAGS) return flags;
  const kept = [...flags].sort((a, b) => b.amount - a.amount).slice(0, MAX_FLAGS);
  return kept.sort((a, b) => a.from - b.from);
}
