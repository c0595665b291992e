/**
 * When to save: a while after the last change, and under steady changes every few seconds. Not with a hand on the
 * mouse, for what is being dragged is half done and the moment is a bad one to be late in; but not never either.
 */

const QUIET_MS = 800;
const MAX_MS = 5000;
/** A hand that stays down so long holds up nothing. */
const PATIENCE_MS = 30_000;

export class Rhythm {
  private timer: ReturnType<typeof setTimeout> | undefined;
  private firstMs: number | undefined;
  private handIsDown = false;
  /** Due, but for the hand. */
  private isHeldUp = false;

  /** @param due called when it is time; not again before the next change */
  constructor(private readonly due: () => void) {}

  /** Whether a change waits to be saved. */
  get isPending(): boolean {
    return this.firstMs !== undefined;
  }

  changed(): void {
    const now = performance.now();
    this.firstMs ??= now;
    this.wait(Math.min(QUIET_MS, this.firstMs + MAX_MS - now));
  }

  /** Waits so long before the next try: the last one failed. */
  changedLater(milliseconds: number): void {
    this.firstMs = performance.now() + milliseconds - MAX_MS;
    this.wait(milliseconds);
  }

  hand(isDown: boolean): void {
    this.handIsDown = isDown;
    if (!isDown && this.isHeldUp) this.wait(0);
  }

  /** It is being saved, or need not be. */
  clear(): void {
    clearTimeout(this.timer);
    this.firstMs = undefined;
    this.isHeldUp = false;
  }

  private wait(milliseconds: number): void {
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.over(), Math.max(0, milliseconds));
  }

  private over(): void {
    if (this.firstMs === undefined) return;
    const held = performance.now() - this.firstMs;
    if (this.handIsDown && held < PATIENCE_MS) {
      this.isHeldUp = true;
      this.wait(PATIENCE_MS - held);
      return;
    }
    this.clear();
    this.due();
  }
}
