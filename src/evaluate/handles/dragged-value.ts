/**
 * A DOF's value while it is dragged: what the hand has come to, slower or in steps if it wants so, and where a limit
 * stops it.
 */

export interface HandWants {
  /** A tenth of the way: Shift. */
  readonly fine: boolean;
  /** In whole steps: Ctrl. */
  readonly snap: boolean;
}

export interface ValueLimits {
  readonly min: number;
  readonly max: number;
  /** Whether they stop the hand, or are only told. */
  readonly hold: boolean;
}

export interface Dragged {
  readonly value: number;
  /** The limit that it has come to; with limits that don't hold, the one that it is past. */
  readonly stop: 'min' | 'max' | undefined;
}

const FINE = 0.1;

export class DraggedValue {
  private raw: number;

  /**
   * @param step that values snap to, above 0
   * @param sticks whether the hand is tied to the value, as on a ring, so that what it went too far has to be gone back
   *   before the value follows; else the value turns round when the hand does
   */
  constructor(
    start: number,
    private readonly limits: ValueLimits,
    private readonly step: number,
    private readonly sticks: boolean,
  ) {
    this.raw = start;
  }

  /** The hand went on by so much of the value. */
  by(delta: number, { fine, snap }: HandWants): Dragged {
    const { min, max, hold } = this.limits;
    const holds = hold && min <= max;
    this.raw += fine ? FINE * delta : delta;
    if (holds && !this.sticks) this.raw = Math.min(max, Math.max(min, this.raw));
    const wanted = snap ? this.step * Math.round(this.raw / this.step) : this.raw;
    // Snapping must not keep it from a limit that is no whole step.
    const value = holds ? Math.min(max, Math.max(min, wanted)) : wanted;
    const stop = !(min <= max) ? undefined : wanted >= max ? 'max' : wanted <= min ? 'min' : undefined;
    return { value: value + 0, stop };
  }
}
