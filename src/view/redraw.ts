/**
 * When the picture is drawn: with the next frame after a request, once for all requests before it. A picture that can't
 * be drawn isn't tried again in each frame, where it would fail again, but when something else is shown.
 */
export class Redraw {
  private isStale = false;
  private hasFailed = false;
  private hasEnded = false;
  private readonly requestFrame: () => void;

  /**
   * @param inFrame makes of a function a request for the next frame, which calls it once
   * @param draw may throw
   * @param failed is told what it has thrown
   */
  constructor(
    inFrame: (draw: (nowMs: number) => void) => () => void,
    private readonly draw: (nowMs: number) => void,
    private readonly failed: (error: unknown) => void,
  ) {
    this.requestFrame = inFrame((nowMs) => {
      if (this.isStale) this.tryNow(nowMs);
    });
  }

  request(): void {
    if (this.hasEnded) return;
    this.isStale = true;
    this.requestFrame();
  }

  /** What was requested while a frame is prepared is drawn by that frame. */
  include(): void {
    this.isStale = false;
  }

  /** Draws without waiting for a frame; nothing after a failure. */
  tryNow(nowMs: number): void {
    this.isStale = false;
    if (this.hasFailed) return;
    try {
      this.now(nowMs);
    } catch (error) {
      this.fail(error);
    }
  }

  /**
   * Draws without waiting for a frame, whatever failed before.
   *
   * @throws whatever `draw` does
   */
  now(nowMs: number): void {
    this.isStale = false;
    if (!this.hasEnded) this.draw(nowMs);
  }

  /** There is something else to draw: tries again with the next request. */
  retry(): void {
    this.hasFailed = false;
  }

  /** What is to be drawn can't be prepared: nothing is drawn until `retry`. */
  fail(error: unknown): void {
    this.hasFailed = true;
    this.failed(error);
  }

  /** For good. */
  end(): void {
    this.hasEnded = true;
    this.isStale = false;
  }
}
