/**
 * When to save: shortly after the last change, and every second during continuous changes. During a drag that changes
 * nearly all of a large document, seldom enough that saving leaves most of the time to the drag.
 */

const QUIET_MS = 500;
/** With the time that saving takes, on a busy machine too, no more than two seconds of work are lost. */
const MAX_MS = 1000;
/** The share of a drag's time that saving may take from it. */
const SHARE_OF_DRAG = 0.2;
/** However long saving takes, a drag postpones it no longer. */
const PATIENCE_MS = 3000;

export class Rhythm {
  private timer: ReturnType<typeof setTimeout> | undefined;
  private firstMs: number | undefined;
  private pointerIsDown = false;
  /** How long a drag postpones saving. */
  private patienceMs = MAX_MS;
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

  /** @param milliseconds for which the last save kept the page busy */
  saveTook(milliseconds: number): void {
    this.patienceMs = Math.min(Math.max(MAX_MS, milliseconds / SHARE_OF_DRAG), PATIENCE_MS);
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
    if (this.pointerIsDown && held < this.patienceMs) {
      this.isHeldUp = true;
      this.wait(this.patienceMs - held);
      return;
    }
    this.clear();
    this.due();
  }
}
