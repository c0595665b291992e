/** Mouse, wheel and Escape over the sheet: panning, zooming, and the gestures of `gestures.ts`. */
import { followPointer } from '../../widgets/drag.ts';
import { isMac } from '../../widgets/focus/keyboard.ts';
import { oncePerFrame } from '../../widgets/frame.ts';
import { asksForMenu, type MenuPlace } from '../../widgets/menu.ts';
import { panWindow, secondsPerPixel, type TimeWindow, timeAt, zoomWindow } from '../../widgets/time/time-window.ts';
import { wheelTurn } from '../../widgets/time/wheel.ts';
import type { DopeDrag, DopeHost, Pointer } from './gesture.ts';
import { cursorFor, gestureAt } from './gestures.ts';
import { hitSheet, type SheetHit } from './hit.ts';
import { rowsTop } from './sheet.ts';

export interface SheetPointerHost extends DopeHost {
  look(window: TimeWindow): void;
  /** Pixels, clamped to the rows. */
  scrollBy(pixels: number): void;
  /** By keyboard `hit` means nothing. */
  menu(hit: SheetHit, at: MenuPlace): void;
  overlayChanged(): void;
}

/** A press that moves no further than this is a click. */
const CLICK_PIXELS = 3;

export class SheetPointer {
  private gesture: DopeDrag | undefined;
  private last: Pointer | undefined;
  private hover: { readonly x: number; readonly y: number } | undefined;
  private moved = false;

  constructor(
    private readonly target: HTMLElement,
    private readonly host: SheetPointerHost,
  ) {
    target.addEventListener('pointerdown', (event) => this.onDown(event));
    target.addEventListener('pointermove', (event) => {
      this.hover = this.placeOf(event);
      if (!this.dragging) this.showCursor(event);
    });
    target.addEventListener('pointerleave', () => {
      this.hover = undefined;
    });
    target.addEventListener('wheel', (event) => this.onWheel(event), { passive: false });
    target.addEventListener('dblclick', (event) => this.onDoubleClick(event));
    target.addEventListener('contextmenu', (event) => this.onMenu(event));
    // Modifiers change what a press would do.
    for (const type of ['keydown', 'keyup'] as const) target.addEventListener(type, (e) => this.onKey(e));
  }

  private dragging = false;

  /** Box and readout of the current drag. */
  get overlay() {
    const { gesture, last } = this;
    const text = gesture?.readout;
    return { box: gesture?.box, readout: text && last ? { x: last.x, y: last.y, text } : undefined };
  }

  private placeOf(event: MouseEvent): { readonly x: number; readonly y: number } {
    const box = this.target.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  }

  private pointerOf(event: PointerEvent): Pointer {
    const ctrl = isMac ? event.metaKey : event.ctrlKey;
    return { ...this.placeOf(event), shift: event.shiftKey, ctrl, alt: event.altKey };
  }

  private hitAt({ x, y }: { readonly x: number; readonly y: number }): SheetHit {
    return hitSheet(this.host.sheet(), this.host.shown(), x, y);
  }

  private showCursor(event: MouseEvent | KeyboardEvent): void {
    if (!this.hover || this.dragging) return;
    const ctrl = isMac ? event.metaKey : event.ctrlKey;
    const held = { shift: event.shiftKey, ctrl };
    this.target.style.cursor = cursorFor(this.host, this.hitAt(this.hover), held);
  }

  private onDown(event: PointerEvent): void {
    if (event.button > 1 || this.dragging) return;
    event.preventDefault();
    this.target.focus({ preventScroll: true });
    // On a Mac, Ctrl+click opens the context menu.
    if (event.button === 0 && isMac && event.ctrlKey) return;
    const at = this.pointerOf(event);
    const hit = this.hitAt(at);
    if (event.button === 1) this.follow(event, this.panning(at), 'grabbing');
    else {
      const gesture = gestureAt(this.host, hit, at);
      this.gesture = gesture;
      if (gesture) this.follow(event, this.gesturing(gesture), this.target.style.cursor);
    }
  }

  private panning(from: Pointer): DopeDrag {
    let last = from;
    return {
      move: (at) => {
        const sheet = this.host.sheet();
        if (at.x !== last.x) this.host.look(panWindow(sheet.window, (last.x - at.x) * secondsPerPixel(sheet)));
        this.host.scrollBy(last.y - at.y);
        last = at;
      },
      release() {},
      cancel() {},
    };
  }

  /** Tells a click from a drag, and scrolls if the drag leaves the rows. */
  private gesturing(gesture: DopeDrag): DopeDrag {
    return {
      move: (at) => {
        if (gesture.box) this.scrollAtEdge(at);
        gesture.move(at);
      },
      release: (at, moved) => gesture.release(at, moved),
      cancel: () => gesture.cancel(),
    };
  }

  private scrollAtEdge({ y }: Pointer): void {
    const sheet = this.host.sheet();
    const over = y > sheet.height ? y - sheet.height : Math.min(0, y - rowsTop(sheet));
    if (over !== 0) this.host.scrollBy(over / 2);
  }

  /** Once a frame with the latest position, and again on release. */
  private follow(event: PointerEvent, gesture: DopeDrag, cursor: string): void {
    const from = this.pointerOf(event);
    let latest = from;
    this.last = from;
    this.moved = false;
    this.dragging = true;
    const { target } = this;
    target.style.cursor = cursor;
    const step = () => {
      if (!this.dragging || !this.moved) return;
      gesture.move(latest);
      this.last = latest;
      this.host.overlayChanged();
    };
    const soon = oncePerFrame(step);
    const take = (e: PointerEvent) => {
      latest = this.pointerOf(e);
      this.moved ||= Math.hypot(latest.x - from.x, latest.y - from.y) > CLICK_PIXELS;
    };
    const end = (finish: () => void) => {
      if (!this.dragging) return;
      finish();
      this.dragging = false;
      this.gesture = undefined;
      target.style.cursor = '';
      this.host.overlayChanged();
    };
    const key = (e: KeyboardEvent) => {
      if (e.key === 'Escape') {
        e.preventDefault();
        e.stopPropagation();
        end(() => gesture.cancel());
        giveUp();
      } else if (['Alt', 'Control', 'Shift', 'Meta'].includes(e.key)) {
        // Alt would open the browser's menu.
        e.preventDefault();
      } else if (this.gesture) {
        // Blocks shortcuts during a drag, which might delete the dragged key.
        e.preventDefault();
        e.stopPropagation();
      }
    };
    const giveUp = followPointer(target, event, {
      move: (e) => {
        take(e);
        if (this.moved) soon();
      },
      key,
      over: (_, release) => {
        // With two buttons down, only the first one drags.
        if (release?.button !== event.button) return end(() => gesture.cancel());
        take(release);
        end(() => {
          step();
          gesture.release(latest, this.moved);
        });
      },
    });
  }

  private onWheel(event: WheelEvent): void {
    event.preventDefault();
    const { host } = this;
    const sheet = host.sheet();
    const turn = wheelTurn(event);
    if (turn.what === 'pan') host.look(panWindow(sheet.window, turn.pixels * secondsPerPixel(sheet)));
    else if (turn.axes === 'other') host.scrollBy(turn.pixels);
    else host.look(zoomWindow(sheet.window, timeAt(sheet, this.placeOf(event).x), turn.factor));
  }

  private onDoubleClick(event: MouseEvent): void {
    const hit = this.hitAt(this.placeOf(event));
    if (hit.kind !== 'keys' || event.shiftKey || event.ctrlKey || event.metaKey) return;
    this.host.wb.transport.update((p) => ({ ...p, timeSeconds: hit.timeSeconds, playing: false }));
  }

  private onMenu(event: MouseEvent): void {
    event.preventDefault();
    if (this.dragging) return;
    this.host.menu(this.hitAt(this.placeOf(event)), { x: event.clientX, y: event.clientY });
  }

  private onKey(event: KeyboardEvent): void {
    this.showCursor(event);
    if (event.type !== 'keydown' || !asksForMenu(event) || this.dragging) return;
    event.preventDefault();
    event.stopPropagation();
    const { left, top } = this.target.getBoundingClientRect();
    this.host.menu({ kind: 'nothing' }, { x: left + 40, y: top + 40, byKeyboard: true });
  }
}
