/**
 * Converts pointer motion to world positions. Owns the press, its kind and one step per frame; the document belongs to
 * `HandPull`, the pose to `evaluate/ik/drag/pull.ts`.
 *
 * The mouse drags a point in the camera-facing plane through it, or in depth (up is away) while Alt is held or a second
 * finger is down, or always with the right button. A press without motion is a click, and starts nothing; a finger held
 * still is a long press.
 */
import type { Vec3 } from '../../../math/vec3.ts';
import { findCharacter } from '../../../model/document.ts';
import { withJointActive } from '../../../model/skeleton/joint-selection.ts';
import type { Workbench } from '../../state/workbench.ts';
import { type CanvasDrag, type CanvasPointer, CLICK_PIXELS, LONG_PRESS_MS } from '../viewport/canvas-tools.ts';
import { HandPull, type IkGrip, type PullState } from './hand-pull.ts';

/** Schedules a call; returns a function that cancels it. */
export type Later = (run: () => void, afterMs: number) => () => void;

const byTimer: Later = (run, afterMs) => {
  const timer = setTimeout(run, afterMs);
  return () => clearTimeout(timer);
};

export interface PinDragEvents {
  /** The press was a click. */
  click(at: CanvasPointer): void;
  /** A long press without motion: no longer a click. */
  longPress(): void;
  /** The drag has begun. */
  began(): void;
  /**
   * After each step. @param depth distance moved away from the viewer, in the character's unit; undefined: not in depth
   */
  moved(depth: number | undefined, at: CanvasPointer): void;
  /** The press has ended, either way. */
  over(): void;
}

/** A drag that the pointer doesn't lead freely, such as along an axis. */
export interface Steering {
  /** The drag has begun: what moves the hand for each position of the pointer. */
  begin(hand: HandPull): (at: CanvasPointer) => void;
  /** The press has ended, either way. */
  over(): void;
}

export class PinDrag implements CanvasDrag {
  readonly ownsLongPress = true;
  private hand: HandPull | undefined;
  private steer: ((at: CanvasPointer) => void) | undefined;
  private refused = false;
  /** Positions of the point and the pointer when the drag began or switched to or from depth. */
  private from: Vec3 | undefined;
  private fromY: number;
  /** Offset from the pointer to the point on screen. */
  private besideX = 0;
  private besideY = 0;
  private inDepth: boolean;
  /** Depth of the whole drag: at the last switch, and now; in the character's unit. */
  private depthBefore = 0;
  private depth = 0;
  private fingerCount = 1;
  private wasLong = false;
  private readonly stopWaiting: () => void;
  private latest: CanvasPointer | undefined;
  /** Pointer position of the last step. */
  private stepped: CanvasPointer | undefined;
  private frame = 0;

  constructor(
    private readonly wb: Workbench,
    private readonly grip: IkGrip,
    private readonly press: CanvasPointer,
    private readonly events: PinDragEvents,
    private readonly steering?: Steering,
    later = byTimer,
  ) {
    this.fromY = press.clientY;
    this.inDepth = this.isInDepth(press);
    this.stopWaiting = press.pointerType === 'touch' ? later(this.onLongPress, LONG_PRESS_MS) : () => {};
  }

  get hasBegun(): boolean {
    return this.hand !== undefined;
  }

  /** State for drawing, once the drag has begun. */
  get state(): PullState | undefined {
    return this.hand?.isOver === false ? this.hand.state : undefined;
  }

  /** At most one step per frame, with the latest position. A pose that has not converged continues by itself. */
  move(at: CanvasPointer): void {
    if (this.hasMoved(at)) this.stopWaiting();
    this.latest = at;
    if (this.frame) return;
    this.step();
    this.frame = requestAnimationFrame(this.onFrame);
  }

  /** A second finger switches to depth. */
  fingers(count: number): void {
    this.stopWaiting();
    this.fingerCount = count;
  }

  end(at: CanvasPointer): void {
    this.stopWaiting();
    cancelAnimationFrame(this.frame);
    if (!this.hand && !this.hasMoved(at)) {
      if (!this.wasLong) this.events.click(at);
    } else {
      // No step is needed if the pointer is where the last one was.
      if (this.latest || !this.standsAt(at)) {
        this.latest = at;
        this.step();
      }
      this.release();
    }
    this.over();
  }

  cancel(): void {
    this.stopWaiting();
    cancelAnimationFrame(this.frame);
    this.hand?.cancel();
    this.over();
  }

  private over(): void {
    this.steering?.over();
    this.events.over();
  }

  private release(): void {
    const { hand } = this;
    if (!hand) return;
    const { isOver } = hand;
    hand.finish();
    if (!isOver) this.select();
  }

  /**
   * Selects the dragged joint, or makes it the active one of those selected, since it is what one keys and inspects
   * next. Only after a step: Escape leaves the selection alone, and undo restores the previous one.
   */
  private select(): void {
    const { store, viewport } = this.wb;
    const { characterId, placement, joint } = this.grip;
    const { selection } = store;
    const character = findCharacter(store.document, characterId);
    if (!character) return;
    const isSame = selection.characterId === characterId;
    if (isSame && selection.joint === joint) {
      if (viewport.pickedCopy(character) !== placement) store.select({ ...selection, placement });
    } else {
      const active = withJointActive(selection, { characterId, placement, joint });
      store.select({ ...active, ...(isSame && selection.keys && { keys: selection.keys }) });
    }
  }

  private readonly onLongPress = () => {
    this.wasLong = true;
    this.events.longPress();
  };

  private readonly onFrame = () => {
    this.frame = 0;
    if (this.latest) this.step();
    else if (!this.hand?.goOn()) return;
    this.frame = requestAnimationFrame(this.onFrame);
  };

  private step(): void {
    const { latest: at, wb } = this;
    this.latest = undefined;
    if (!at || this.refused || (!this.hand && !this.hasMoved(at))) return;
    if (!this.hand && !this.begin()) return;
    this.stepped = at;
    const { hand } = this;
    if (!hand || !this.from) return;
    if (this.steer) {
      this.steer(at);
      return;
    }
    const { eye } = wb.viewport;
    if (this.isInDepth(at) !== this.inDepth) this.change(at);
    if (this.inDepth) {
      const away = (this.fromY - at.clientY) * eye.unitsPerPixel(this.from);
      const goal = eye.inDepth(this.from, away);
      this.depth = this.depthBefore + Math.sign(away) * hand.inOwnUnit(this.from, goal);
      hand.to(goal);
    } else hand.to(eye.inPlaneOf(this.from, at.clientX + this.besideX, at.clientY + this.besideY));
    this.events.moved(this.inDepth ? this.depth : undefined, at);
  }

  private begin(): boolean {
    const { wb, press } = this;
    this.hand = HandPull.begin(wb, this.grip);
    this.refused = this.hand === undefined;
    if (!this.hand) return false;
    wb.posing.ik.hasDragged.set(true);
    this.from = this.hand.hand;
    this.steer = this.steering?.begin(this.hand);
    this.standBeside(press);
    this.events.began();
    return true;
  }

  private standsAt(at: CanvasPointer): boolean {
    const { stepped } = this;
    return (
      stepped?.clientX === at.clientX &&
      stepped.clientY === at.clientY &&
      this.isInDepth(stepped) === this.isInDepth(at)
    );
  }

  /** Switches between plane and depth, continuing from the current position. */
  private change(at: CanvasPointer): void {
    this.inDepth = !this.inDepth;
    this.from = this.hand?.hand;
    this.depthBefore = this.depth;
    this.fromY = at.clientY;
    this.standBeside(at);
  }

  private standBeside({ clientX, clientY }: CanvasPointer): void {
    if (!this.from) return;
    const { x, y } = this.wb.viewport.eye.toScreen(this.from);
    this.besideX = x - clientX;
    this.besideY = y - clientY;
  }

  private hasMoved({ clientX, clientY }: CanvasPointer): boolean {
    return Math.hypot(clientX - this.press.clientX, clientY - this.press.clientY) > CLICK_PIXELS;
  }

  private isInDepth({ altKey }: CanvasPointer): boolean {
    return this.press.button === 2 || altKey || this.fingerCount > 1;
  }
}
