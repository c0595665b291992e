/** A DOF's value during a drag: follows the pointer, optionally slower or in steps, and stops at limits. */

/** Modifier keys during a drag. */
export interface HandWants {
  /** A tenth of the movement: Shift. */
  readonly fine: boolean;
  /** In whole steps: Ctrl. */
  readonly snap: boolean;
}

/** Range of a dragged value in the DOF's unit; min > max restricts nothing. */
export interface ValueLimits {
  readonly min: number;
  readonly max: number;
  /** Whether limits stop the value, or are only reported. */
  readonly hold: boolean;
}

/** A value during a drag, and whether it met a limit. */
export interface Dragged {
  readonly value: number;
  /** The limit that was reached; with limits that are not enforced, the one exceeded. */
  readonly stop: 'min' | 'max' | undefined;
}

const FINE = 0.1;

/** The value of one drag, from its start to its end, in the DOF's unit. */
export class DraggedValue {
  private raw: number;

  /**
   * @param step that values snap to; greater than 0
   * @param sticks whether the pointer is tied to the value, as on a ring, so that an overshoot has to be undone before
   * the value follows; else the value reverses as soon as the pointer does
   */
  constructor(
    start: number,
    private readonly limits: ValueLimits,
    private readonly step: number,
    private readonly sticks: boolean,
  ) {
    this.raw = start;
  }

  /** The pointer moved by this much of the value. */
  by(delta: number, { fine, snap }: HandWants): Dragged {
    const { min, max, hold } = this.limits;
    const holds = hold && min <= max;
    this.raw += fine ? FINE * delta : delta;
    if (holds && !this.sticks) this.raw = Math.min(max, Math.max(min, this.raw));
    const wanted = snap ? this.step * Math.round(this.raw / this.step) : this.raw;
    // Snapping must not keep it from a limit between steps.
    const value = holds ? Math.min(max, Math.max(min, wanted)) : wanted;
    const stop = !(min <= max) ? undefined : wanted >= max ? 'max' : wanted <= min ? 'min' : undefined;
    return { value: value + 0, stop };
  }
}
