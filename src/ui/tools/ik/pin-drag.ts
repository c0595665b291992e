/**
 * The mouse that drags a point: in the plane through it that faces the camera, or in depth (up is away) while Alt is held
 * or from the beginning by the right button. A press that goes nowhere is a click, and nothing has begun.
 */
import type { Vec3 } from '../../../math/vec3.ts';
import type { Workbench } from '../../workbench.ts';
import { type CanvasDrag, type CanvasPointer, CLICK_PIXELS } from '../canvas-tools.ts';
import { type Grip, HandPull, type PullState } from './hand-pull.ts';
import { ikInHand } from './in-hand.ts';

export interface PinDragEvents {
  /** The press went nowhere. */
  click(at: CanvasPointer): void;
  /** It has moved: it is a drag. */
  began(): void;
  /** The press is over, either way. */
  over(): void;
}

export class PinDrag implements CanvasDrag {
  private hand: HandPull | undefined;
  private refused = false;
  /** Where the point and the pointer were when the drag began, or changed its manner. */
  private from: Vec3 | undefined;
  private fromY: number;
  /** Where the hand is in the world. */
  private last: Vec3 | undefined;
  /** From the pointer to the point on the screen. */
  private besideX = 0;
  private besideY = 0;
  private inDepth: boolean;
  private latest: CanvasPointer | undefined;
  private frame = 0;

  constructor(
    private readonly wb: Workbench,
    private readonly grip: Grip,
    private readonly press: CanvasPointer,
    private readonly events: PinDragEvents,
  ) {
    this.fromY = press.clientY;
    this.inDepth = isInDepth(press, press);
  }

  /** What there is to be drawn of it, once it has begun. */
  get state(): PullState | undefined {
    return this.hand?.isOver === false ? this.hand.state : undefined;
  }

  /** At most one step a frame: what comes in between is the next one's. A pose that is on its way goes on by itself. */
  move(at: CanvasPointer): void {
    this.latest = at;
    if (this.frame) return;
    this.step();
    this.frame = requestAnimationFrame(this.onFrame);
  }

  end(at: CanvasPointer): void {
    cancelAnimationFrame(this.frame);
    if (!this.hand && !this.hasMoved(at)) this.events.click(at);
    else {
      this.latest = at;
      this.step();
      this.hand?.finish();
    }
    this.events.over();
  }

  cancel(): void {
    cancelAnimationFrame(this.frame);
    this.hand?.cancel();
    this.events.over();
  }

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
    const { hand } = this;
    if (!hand || !this.from) return;
    const { eye } = wb.viewport;
    if (isInDepth(this.press, at) !== this.inDepth) this.change(at);
    if (this.inDepth) {
      const away = (this.fromY - at.clientY) * eye.unitsPerPixel(this.from);
      hand.to(this.goal(eye.inDepth(this.from, away)));
    } else hand.to(this.goal(eye.inPlaneOf(this.from, at.clientX + this.besideX, at.clientY + this.besideY)));
  }

  private begin(): boolean {
    const { wb, press } = this;
    this.hand = HandPull.begin(wb, this.grip);
    this.refused = this.hand === undefined;
    if (!this.hand) return false;
    ikInHand(wb).hasDragged.set(true);
    this.from = this.hand.anchor;
    this.last = this.from;
    this.standBeside(press);
    this.events.began();
    return true;
  }

  private goal(world: Vec3): Vec3 {
    this.last = world;
    return world;
  }

  /** From the plane to depth or back: goes on from where it is. */
  private change(at: CanvasPointer): void {
    this.inDepth = !this.inDepth;
    this.from = this.last;
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
}

function isInDepth(press: CanvasPointer, now: CanvasPointer): boolean {
  return press.button === 2 || now.altKey;
}
