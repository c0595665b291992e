/** Pointer and held keys in the plot. Their meaning is in `tools/intent.ts`, what they do in the other tools. */
import { hasKey } from '../../../edit/keys/selection.ts';
import { followPointer } from '../../widgets/drag.ts';
import { buttonMeant, isMac, waitOutDrag } from '../../widgets/focus/keyboard.ts';
import { oncePerFrame } from '../../widgets/frame.ts';
import { asksForMenu } from '../../widgets/menu.ts';
import { timeAt } from '../../widgets/time/time-window.ts';
import { wheelTurn } from '../../widgets/time/wheel.ts';
import { openPlotMenu } from './context-menu.ts';
import { insertOnCurve } from './insert.ts';
import { hitTest } from './scene/hit.ts';
import type { CurveHit } from './scene/scene.ts';
import { pan, zoom } from './scene/space.ts';
import { boxDrag } from './tools/box.ts';
import { cursorOf, type Intent, intentOf } from './tools/intent.ts';
import { keysDrag } from './tools/move-keys.ts';
import { panDrag, zoomDrag } from './tools/navigate.ts';
import { scaleDrag } from './tools/scale.ts';
import { slopeDrag } from './tools/slope.ts';
import type { Drag, PlotAccess, PointerAt } from './tools/tool.ts';

/** A press that moves no further than this is a click. */
const TREMBLE_PIXELS = 3;
const REACH_MOUSE = 6;
const REACH_TOUCH = 14;
const NO_HIT: CurveHit = { kind: 'empty' };
/** Drags that change neither document nor selection. */
const LOOKING: readonly Intent[] = ['pan', 'zoom'];

/** What input needs of the plot, beyond `PlotAccess`. */
export interface PlotHost extends PlotAccess {
  readonly element: HTMLElement;
  /** While frozen, nothing is refitted or renormalised. */
  freeze(frozen: boolean): void;
  /** Redraws with the next frame, since the hover has changed. */
  drawSoon(): void;
  /** After a drag was finished or cancelled. */
  afterDrag(): void;
}

export class PlotInput {
  private hover: CurveHit = NO_HIT;
  /**
   * The dragged key, as an index into its channel's selected keys: its index in the channel changes as it passes
   * others.
   */
  private grabbed = -1;
  /** Pointer position; undefined outside. */
  pointer: PointerAt | undefined;
  /**
   * Code of the key that is down, and of the one that holds scaling on; undefined if scaling was switched on otherwise.
   */
  private down: string | undefined;
  private heldForScaling: string | undefined;
  private drag:
    | { readonly drag: Drag; readonly from: PointerAt; readonly letGo: () => void; moved: boolean; waiting?: PointerAt }
    | undefined;
  private readonly moveSoon = oncePerFrame(() => this.flushMove());

  constructor(
    private readonly plot: PlotHost,
    private readonly mac = isMac,
  ) {
    this.listen();
  }

  get dragging(): boolean {
    return this.drag !== undefined;
  }

  /** What is hovered or dragged. */
  shownHover(): CurveHit {
    const { hover, drag } = this;
    if (!drag || hover.kind !== 'key') return hover;
    const keys = this.plot.scene()?.selected.find((k) => k.channel === hover.channel);
    const index = keys?.indices[this.grabbed];
    return index === undefined ? NO_HIT : { ...hover, index };
  }

  /** The scene has changed: updates the hover. */
  refresh(): void {
    if (this.pointer && !this.drag) this.lookUnder(this.pointer);
  }

  /** Cancelled, with the button still down. */
  get cancelled(): boolean {
    return this.drag?.drag.cancelled?.() ?? false;
  }

  private listen(): void {
    const { element: target } = this.plot;
    target.addEventListener('pointerdown', (event) => this.onPress(event));
    target.addEventListener('pointermove', (event) => this.onMove(event));
    target.addEventListener('pointerleave', () => this.onLeave());
    target.addEventListener('wheel', (event) => this.onWheel(event), { passive: false });
    target.addEventListener('dblclick', (event) => this.onDoubleClick(event));
    target.addEventListener('contextmenu', (event) => this.onMenu(event));
    target.addEventListener('keydown', (event) => {
      if (asksForMenu(event) && !this.drag) {
        event.preventDefault();
        event.stopPropagation();
        this.openMenuByKey();
        return;
      }
      if (!event.repeat) this.down = event.code;
      this.holdKeys(event);
    });
    target.addEventListener('keyup', (event) => {
      const { scaling } = this.plot.wb.timeline;
      if (event.code === this.heldForScaling) scaling.set(false);
      if (event.code === this.down) this.down = undefined;
      this.holdKeys(event);
    });
    target.addEventListener('blur', () => {
      this.down = undefined;
      this.plot.wb.timeline.scaling.set(false);
    });
    this.plot.wb.timeline.scaling.subscribe((scales) => {
      this.heldForScaling = scales ? this.down : undefined;
      this.refresh();
    });
  }

  private at(event: MouseEvent): PointerAt {
    const box = this.plot.element.getBoundingClientRect();
    return {
      x: event.clientX - box.left,
      y: event.clientY - box.top,
      shift: event.shiftKey,
      ctrl: this.mac ? event.metaKey : event.ctrlKey,
      alt: event.altKey,
    };
  }

  private hitAt(at: PointerAt, reach: number): CurveHit {
    const scene = this.plot.scene();
    return scene ? hitTest(scene, at.x, at.y, reach) : NO_HIT;
  }

  private intent(at: PointerAt, button: number, hit: CurveHit): Intent {
    return intentOf({ ...at, button, scaling: this.plot.wb.timeline.scaling.get() }, hit);
  }

  private onPress(event: PointerEvent): void {
    if (this.drag || event.target instanceof HTMLButtonElement) return;
    const at = this.at(event);
    const hit = this.hitAt(at, event.pointerType === 'mouse' ? REACH_MOUSE : REACH_TOUCH);
    const intent = this.intent(at, buttonMeant(event, this.mac), hit);
    event.preventDefault();
    this.plot.element.focus({ preventScroll: true });
    if (intent === 'menu' || !this.plot.scene()) return;
    if (intent === 'insert' && hit.kind === 'curve') {
      insertOnCurve(this.plot.wb, hit.channel, hit.timeSeconds);
      return;
    }
    const drag = this.dragFor(intent, at, hit);
    if (!drag) return;
    const letGo = followPointer(this.plot.element, event, {
      move: (now) => this.onDrag(this.at(now)),
      over: (_, release) => (release ? this.endDrag(this.at(release)) : this.cancelDrag()),
    });
    this.drag = { drag, from: at, letGo, moved: false };
    this.hover = hit;
    this.grabbed = this.placeInSelection(hit);
    this.plot.freeze(true);
    this.plot.element.style.cursor = drag.cursor(at);
    window.addEventListener('keydown', LOOKING.includes(intent) ? this.onLookingKey : this.onDragKey, true);
  }

  private placeInSelection(hit: CurveHit): number {
    if (hit.kind !== 'key') return -1;
    const keys = this.plot.scene()?.selected.find((k) => k.channel === hit.channel);
    return keys?.indices.indexOf(hit.index) ?? -1;
  }

  private dragFor(intent: Intent, at: PointerAt, hit: CurveHit): Drag | undefined {
    if (intent === 'pan') return panDrag(this.plot, at);
    if (intent === 'zoom') return zoomDrag(this.plot, at);
    if (intent === 'scale') return scaleDrag(this.plot, at);
    if (intent === 'slope' && hit.kind === 'handle') return slopeDrag(this.plot, hit);
    if (intent === 'keys' && hit.kind === 'key') return keysDrag(this.plot, hit, at);
    if (intent === 'curve' && hit.kind === 'curve') return boxDrag(this.plot, at, hit.channel);
    return intent === 'box' ? boxDrag(this.plot, at) : undefined;
  }

  private onMove(event: PointerEvent): void {
    // A second finger is nothing to the drag.
    if (this.drag) return;
    this.pointer = this.at(event);
    this.lookUnder(this.pointer);
    this.plot.drawSoon();
  }

  private onDrag(at: PointerAt): void {
    const { drag } = this;
    if (!drag) return;
    this.pointer = at;
    drag.moved ||= Math.hypot(at.x - drag.from.x, at.y - drag.from.y) >= TREMBLE_PIXELS;
    drag.waiting = at;
    this.moveSoon();
    this.plot.drawSoon();
  }

  /** At most once a frame: moving many keys may take longer than the next event. */
  private flushMove(): void {
    const { drag } = this;
    if (!drag?.waiting) return;
    const at = drag.waiting;
    delete drag.waiting;
    if (!drag.moved) return;
    drag.drag.move(at);
    this.plot.element.style.cursor = drag.drag.cursor(at);
  }

  private endDrag(at: PointerAt): void {
    const { drag } = this;
    if (!drag) return;
    this.drag = undefined;
    drag.drag.end(drag.waiting ?? at, drag.moved);
    this.afterDrag();
  }

  private cancelDrag(): void {
    const { drag } = this;
    if (!drag) return;
    this.drag = undefined;
    drag.letGo();
    drag.drag.cancel();
    this.afterDrag();
  }

  private onEscape(event: KeyboardEvent): void {
    event.preventDefault();
    event.stopPropagation();
    this.cancelDrag();
  }

  private readonly onLookingKey = (event: KeyboardEvent) => {
    if (event.key === 'Escape') this.onEscape(event);
  };

  private readonly onDragKey = (event: KeyboardEvent) => {
    waitOutDrag(event);
    if (event.key === 'Escape') this.onEscape(event);
    // Modifiers change a drag at once, wherever the focus is.
    else this.holdKeys(event);
  };

  private afterDrag(): void {
    window.removeEventListener('keydown', this.onLookingKey, true);
    window.removeEventListener('keydown', this.onDragKey, true);
    // Scaling was on for this drag only, unless its key is still down.
    if (this.heldForScaling === undefined) this.plot.wb.timeline.scaling.set(false);
    if (this.pointer) this.lookUnder(this.pointer);
    this.plot.afterDrag();
  }

  private onLeave(): void {
    if (this.drag) return;
    this.pointer = undefined;
    this.hover = NO_HIT;
    this.plot.drawSoon();
  }

  /** Updates the hover, and the cursor for a press there. */
  private lookUnder(at: PointerAt): void {
    this.hover = this.hitAt(at, REACH_MOUSE);
    const { hover } = this;
    const isSelected = hover.kind === 'key' && hasKey(this.plot.scene()?.selected, hover.channel, hover.index);
    this.plot.element.style.cursor = cursorOf(this.intent(at, 0, hover), at, isSelected);
  }

  private onWheel(event: WheelEvent): void {
    const scene = this.plot.scene();
    if (!scene) return;
    event.preventDefault();
    const at = this.at(event);
    const turn = wheelTurn(event);
    const { space } = scene;
    if (turn.what === 'pan') this.plot.look(pan(space, -turn.pixels, 0));
    else {
      const { axes, factor } = turn;
      this.plot.look(zoom(space, at.x, at.y, axes === 'other' ? 1 : factor, axes === 'time' ? 1 : factor));
    }
  }

  private onDoubleClick(event: MouseEvent): void {
    const at = this.at(event);
    const scene = this.plot.scene();
    if (!scene || at.alt || at.shift || at.ctrl) return;
    const hit = hitTest(scene, at.x, at.y, REACH_MOUSE);
    if (hit.kind === 'curve') insertOnCurve(this.plot.wb, hit.channel, hit.timeSeconds);
    // Next to the only curve, that curve is meant.
    else if (hit.kind === 'empty' && scene.lines.length === 1) {
      insertOnCurve(this.plot.wb, scene.lines[0].channel, timeAt(scene.space, at.x) + scene.offsetSeconds);
    }
  }

  private onMenu(event: MouseEvent): void {
    event.preventDefault();
    // Alt and the right button zoom.
    if (event.altKey || this.drag) return;
    if (buttonMeant(event, this.mac) !== 2) {
      this.openMenuByKey();
      return;
    }
    const where = { x: event.clientX, y: event.clientY };
    openPlotMenu(this.plot.wb, this.hitAt(this.at(event), REACH_MOUSE), where);
  }

  /** Of the selected keys, else of the background. */
  private openMenuByKey(): void {
    const { left, top } = this.plot.element.getBoundingClientRect();
    openPlotMenu(this.plot.wb, NO_HIT, { x: left + 40, y: top + 40, byKeyboard: true });
  }

  /** Updates the cursor and the drag when a modifier changes. */
  private holdKeys(event: KeyboardEvent): void {
    const { pointer } = this;
    if (!pointer) return;
    this.pointer = {
      ...pointer,
      shift: event.shiftKey,
      ctrl: this.mac ? event.metaKey : event.ctrlKey,
      alt: event.altKey,
    };
    if (!this.drag) this.lookUnder(this.pointer);
    else if (this.drag.moved) {
      this.drag.waiting = this.pointer;
      this.moveSoon();
    }
  }
}
