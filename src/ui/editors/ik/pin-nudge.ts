/**
 * Arrow keys move the selected pin: in the screen plane, with Alt up and down in depth, with Shift further. Presses in
 * quick succession are one undo step. Owns which presses belong together; `Pull` knows the target.
 */
import type { Workbench } from '../../state/workbench.ts';
import { HandPull, type PullState } from './hand-pull.ts';
import { unpinByHand } from './pin-edits.ts';
import { selectedPin } from './selected-pin.ts';

/** CSS pixels per press. */
const STEP = 5;
const LONG_STEP = 25;
/** A pause this long ends the undo step. */
const BURST_MS = 700;

const WAYS: Readonly<Record<string, readonly [number, number]>> = {
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  ArrowUp: [0, -1],
  ArrowDown: [0, 1],
};

export class PinNudge {
  private hand: HandPull | undefined;
  private pin = Number.NaN;
  private timer: ReturnType<typeof setTimeout> | undefined;

  constructor(private readonly wb: Workbench) {}

  get state(): PullState | undefined {
    return this.hand?.isOver === false ? this.hand.state : undefined;
  }

  /** Whether the key was used; its default is then prevented. */
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
      this.pin = pin.id;
      wb.posing.ik.hasDragged.set(true);
    }
    const { hand } = this;
    if (!hand) return true;
    const from = hand.hand;
    const { eye } = wb.viewport;
    const length = event.shiftKey ? LONG_STEP : STEP;
    if (event.altKey) hand.to(eye.inDepth(from, -way[1] * length * eye.unitsPerPixel(from)));
    else {
      const { x, y } = eye.toScreen(from);
      hand.to(eye.inPlaneOf(from, x + way[0] * length, y + way[1] * length));
    }
    // No frames follow a press in which the rest of the way could be shown.
    while (hand.goOn());
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.finish(), BURST_MS);
    return true;
  }

  /** The next press starts a new step. */
  finish(): void {
    clearTimeout(this.timer);
    this.hand?.finish();
    this.hand = undefined;
  }
}
