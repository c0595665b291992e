/**
 * When to save: shortly after the last change, and every other second during continuous changes. Not during a drag,
 * whose state is half done and where a delay would be felt; but a drag doesn't postpone saving for ever.
 */

const QUIET_MS = 800;
/** With the time that saving takes, no more than two seconds of work are lost. */
const MAX_MS = 1500;
/** A longer drag no longer postpones saving. */
const PATIENCE_MS = 30_000;

export class Rhythm {
  private timer: ReturnType<typeof setTimeout> | undefined;
  private firstMs: number | undefined;
  private pointerIsDown = false;
  /** Due, but postponed by a drag. */
  private isHeldUp = false;

  /** @param due called when it is time to save; not again before the next change */
  constructor(private readonly due: () => void) {}

  /** Whether a change is waiting to be saved. */
  get isPending(): boolean {
    return this.firstMs !== undefined;
  }

  changed(): void {
    const now = performance.now();
    this.firstMs ??= now;
    this.wait(Math.min(QUIET_MS, this.firstMs + MAX_MS - now));
  }

  /** Schedules a retry after a failed save. */
  changedLater(milliseconds: number): void {
    this.firstMs = performance.now() + milliseconds - MAX_MS;
    this.wait(milliseconds);
  }

  setPointerDown(isDown: boolean): void {
    this.pointerIsDown = isDown;
    if (!isDown && this.isHeldUp) this.wait(0);
  }

  /** Saved, or no longer needed. */
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
    if (this.pointerIsDown && held < PATIENCE_MS) {
      this.isHeldUp = true;
      this.wait(PATIENCE_MS - held);
      return;
    }
    this.clear();
    this.due();
  }
}
