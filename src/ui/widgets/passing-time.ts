/** How long a passing message is shown: a total time during which the pointer isn't on it. */

/** `setTimeout` and related functions, replaceable in tests. */
export interface Clock {
  now(): number;
  /** Calls back once; returns a function that cancels it. */
  after(ms: number, run: () => void): () => void;
}

const PAGE_CLOCK: Clock = {
  now: () => performance.now(),
  after(ms, run) {
    const timer = setTimeout(run, ms);
    return () => clearTimeout(timer);
  },
};

export class PassingTime {
  private left = 0;
  private isHeld = false;
  private since = 0;
  private callOff: (() => void) | undefined;

  constructor(
    private readonly ms: number,
    private readonly over: () => void,
    private readonly clock: Clock = PAGE_CLOCK,
  ) {}

  /** Restarts, for another message. */
  begin(): void {
    this.callOff?.();
    this.callOff = undefined;
    this.left = this.ms;
    this.goOn();
  }

  /** The message was closed, and isn't hovered any more. */
  end(): void {
    this.callOff?.();
    this.callOff = undefined;
    this.left = 0;
    this.isHeld = false;
  }

  /** While hovered, its time is paused. */
  hold(isHeld: boolean): void {
    if (isHeld === this.isHeld) return;
    this.isHeld = isHeld;
    if (!isHeld) this.goOn();
    else if (this.callOff) {
      this.callOff();
      this.callOff = undefined;
      this.left -= this.clock.now() - this.since;
    }
  }

  private goOn(): void {
    if (this.isHeld || this.left <= 0) return;
    this.since = this.clock.now();
    this.callOff = this.clock.after(this.left, () => {
      this.callOff = undefined;
      this.left = 0;
      this.over();
    });
  }
}
