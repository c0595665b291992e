/**
 * Arrow keys move the selected pin: over the screen, with Alt up and down in depth, with Shift further. Presses that
 * follow each other are one undo step.
 */
import type { Vec3 } from '../../../math/vec3.ts';
import type { Workbench } from '../../state/workbench.ts';
import { HandPull, type PullState } from './hand-pull.ts';
import { selectedPin } from './in-hand.ts';
import { unpinByHand } from './pin-edits.ts';

/** CSS pixels a press. */
const STEP = 5;
const LONG_STEP = 25;
/** After so long without a press the step is done. */
const BURST_MS = 700;

const WAYS: Readonly<Record<string, readonly [number, number]>> = {
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  ArrowUp: [0, -1],
  ArrowDown: [0, 1],
};

export class PinNudge {
  private hand: HandPull | undefined;
  private goal: Vec3 | undefined;
  private pin = Number.NaN;
  private timer: ReturnType<typeof setTimeout> | undefined;

  constructor(private readonly wb: Workbench) {}

  get state(): PullState | undefined {
    return this.hand?.isOver === false ? this.hand.state : undefined;
  }

  /** Whether the key was for the selected pin; its default is prevented then. */
  key(event: KeyboardEvent): boolean {
    const { wb } = this;
    const found = selectedPin(wb);
    if (!found || event.ctrlKey || event.metaKey) return false;
    const { character, pin } = found;
    if ((event.key === 'Delete' || event.key === 'Backspace') && !event.altKey) {
      event.preventDefault();
      this.finish();
      unpinByHand(wb, { characterId: character.id, pin: pin.id });
      return true;
    }
    const way = WAYS[event.key];
    if (!way) return false;
    event.preventDefault();
    if (this.hand && (this.hand.isOver || this.pin !== pin.id)) this.finish();
    if (!this.hand) {
      const { joint, point } = pin;
      const placement = wb.viewport.pickedCopy(character);
      this.hand = HandPull.begin(wb, { characterId: character.id, placement, joint, point, pin: pin.id });
      this.goal = this.hand?.anchor;
      this.pin = pin.id;
      wb.posing.ik.hasDragged.set(true);
    }
    const { hand, goal } = this;
    if (!hand || !goal) return true;
    const { eye } = wb.viewport;
    const length = event.shiftKey ? LONG_STEP : STEP;
    if (event.altKey) this.goal = eye.inDepth(goal, -way[1] * length * eye.unitsPerPixel(goal));
    else {
      const { x, y } = eye.toScreen(goal);
      this.goal = eye.inPlaneOf(goal, x + way[0] * length, y + way[1] * length);
    }
    hand.to(this.goal);
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.finish(), BURST_MS);
    return true;
  }

  /** What follows is another step. */
  finish(): void {
    clearTimeout(this.timer);
    this.hand?.finish();
    this.hand = undefined;
    this.goal = undefined;
  }
}
