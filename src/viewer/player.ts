/** The time of an element: it plays while the element is seen. */
import { advance, DEFAULT_PLAYBACK, type Playback } from '../edit/playback.ts';
import { oncePerFrame } from '../ui/widgets/frame.ts';

/** An element that comes into sight again continues where it was. */
const LONGEST_STEP_SECONDS = 1;

export class Player {
  private now: Playback = { ...DEFAULT_PLAYBACK, loop: 'once' };
  private before: number | undefined;
  private isSeen = false;
  private readonly ask = oncePerFrame((nowMs) => this.advance(nowMs), 'advance');

  /** @param changed learns of each change */
  constructor(private readonly changed: (now: Playback, before: Playback) => void) {}

  get playback(): Playback {
    return this.now;
  }

  update(change: (now: Playback) => Playback): void {
    const before = this.now;
    this.now = change(before);
    if (!before.playing) this.before = undefined;
    if (this.now !== before) this.changed(this.now, before);
    this.go();
  }

  /** Out of sight the time doesn’t pass. */
  setSeen(isSeen: boolean): void {
    this.isSeen = isSeen;
    this.before = undefined;
    this.go();
  }

  private go(): void {
    if (this.now.playing && this.isSeen) this.ask();
  }

  private advance(nowMs: number): void {
    if (!this.now.playing || !this.isSeen) return;
    const { before = nowMs } = this;
    this.before = nowMs;
    this.update((now) => advance(now, Math.min(LONGEST_STEP_SECONDS, (nowMs - before) / 1000)));
  }
}
