/**
 * The scrubber: the ruler of all plots of the timeline, whose time window it shares. Drag to change the time, drag the
 * handles at the ends of the shaded range to change it (`scrubber-handles.ts`), both in whole frames as
 * `scrub-frames.ts` says; the wheel zooms and pans (`wheel.ts`), the middle button pans, a double click fits. As a
 * slider it takes arrow keys.
 */
import { stepFrames } from '../../../edit/playback.ts';
import { type ShownChannel, shownKeys } from '../../../evaluate/plot/shown-keys.ts';
import { type Document, rangeOfTakes } from '../../../model/document.ts';
import type { Uses } from '../../state/workbench.ts';
import { element, setAttribute } from '../../widgets/dom.ts';
import { followPointer } from '../../widgets/drag.ts';
import { buttonMeant, isMac } from '../../widgets/focus/keyboard.ts';
import { oncePerFrame } from '../../widgets/frame.ts';
import { asksForMenu } from '../../widgets/menu.ts';
import { aligned, shown } from '../../widgets/numbers/number-text.ts';
import { MARKER_HEIGHT, type ShownMarker } from '../../widgets/time/markers-picture.ts';
import {
  panWindow,
  revealTime,
  secondsPerPixel,
  snapTime,
  type TimeStrip,
  type TimeWindow,
  timeAt,
  timeX,
  zoomWindow,
} from '../../widgets/time/time-window.ts';
import { wheelTurn } from '../../widgets/time/wheel.ts';
import type { MarkerDrag } from '../timeline/markers/marker-drag.ts';
import { shownMarkers } from '../timeline/markers/shown-markers.ts';
import { scrubFrames } from '../timeline/scrub-frames.ts';
import { openTimeMenu } from '../timeline/time-menu.ts';
import { type RangeEnd, rangeHandleAt } from './scrubber-handles.ts';
import { RULER_HEIGHT, ScrubberBackground, type ScrubberColours, type ScrubberPicture } from './scrubber-picture.ts';

/** Hit tolerance of markers. */
const GRAB_PIXELS = 6;
/** Of one key press. */
const ZOOM_STEP = 1.15;

type Handle = RangeEnd | 'time' | 'pan';

interface MarkerHit {
  readonly index: number;
  /** The end of a span. */
  readonly isEnd: boolean;
}

export class Scrubber {
  readonly element: HTMLCanvasElement = element('canvas', {
    class: 'scrubber',
    role: 'slider',
    tabindex: 0,
    'aria-label': 'Time',
    'data-panel': 'transport',
  });
  private readonly background = new ScrubberBackground();
  /** The times that were fitted last; the window follows the range until the user zooms or pans. */
  private whole: readonly [number, number] | undefined;
  private takes = '';
  private channels: readonly ShownChannel[] = [];
  private markers: readonly ShownMarker[];
  private colours: ScrubberColours | undefined;
  private stale = true;
  /** CSS pixels. Updated on resize only: reading them every frame would force a layout. */
  private width = 0;
  private height = 0;
  private readonly drawSoon = oncePerFrame(() => this.draw());

  constructor(
    private readonly wb: Uses<'store' | 'actions' | 'transport' | 'timeline' | 'settings' | 'messages' | 'dialog'>,
  ) {
    this.channels = shownKeys(wb.store.document, wb.store.selection);
    this.markers = shownMarkers(wb);
    this.takes = takesOf(wb.store.document);
    this.fit();
    wb.transport.subscribe((now, before) => {
      if (now.range !== before.range) this.onRange();
      if (now.framesPerSecond !== before.framesPerSecond) this.stale = true;
      // Time was changed by a key or a field: bring it into view. While playing, the window stays where the user put
      // it.
      if (now.timeSeconds !== before.timeSeconds && !now.playing) {
        const next = revealTime(this.window, now.timeSeconds);
        if (next !== this.window) this.look(next);
      }
      this.drawSoon();
    });
    wb.timeline.view.subscribe((now, before) => {
      if (now.window !== before.window) this.redraw();
    });
    wb.store.subscribe((now, before) => {
      if (now.document === before.document && now.selection === before.selection) return;
      this.channels = shownKeys(now.document, now.selection);
      this.markers = shownMarkers(wb);
      this.element.classList.toggle('with-markers', this.markers.length > 0);
      // The window of other takes means nothing for these.
      const takes = takesOf(now.document);
      if (takes !== this.takes) this.fit();
      this.takes = takes;
      this.redraw();
    });
    wb.settings.subscribe((now, before) => {
      if (now.timeDisplay !== before.timeDisplay) this.redraw();
    });
    new ResizeObserver(() => {
      this.width = this.element.clientWidth;
      this.height = this.element.clientHeight;
      if (this.width) wb.timeline.resize(this.width);
      this.redraw();
    }).observe(this.element);
    this.listen();
  }

  /** Redraws everything: another theme or size. */
  redraw(recolour = false): void {
    if (recolour) this.colours = undefined;
    this.stale = true;
    this.drawSoon();
  }

  private get window(): TimeWindow {
    return this.wb.timeline.view.get().window;
  }

  /** With the width of now, also before a frame was drawn with it. */
  private get strip(): TimeStrip {
    return { window: this.window, width: Math.max(1, this.element.clientWidth) };
  }

  /** The playback range and the takes: a shorter range is shown within them. */
  fit(): void {
    const { range } = this.wb.transport.get();
    const takes = rangeOfTakes(this.wb.store.document) ?? range;
    this.whole = [Math.min(range[0], takes[0]), Math.max(range[1], takes[1])];
    this.wb.timeline.fit(this.whole);
  }

  private onRange(): void {
    if (this.wb.timeline.fitted === this.whole && !this.dragging) this.fit();
    this.stale = true;
  }

  private look(window: TimeWindow): void {
    this.wb.timeline.change({ window });
  }

  private get framesPerSecond(): number | undefined {
    return this.wb.settings.get().timeDisplay === 'frames' ? this.wb.transport.get().framesPerSecond : undefined;
  }

  private draw(): void {
    const { width, height } = this;
    if (!width || !height) return;
    const ratio = window.devicePixelRatio;
    this.colours ??= readColours(this.element);
    const { timeSeconds, range } = this.wb.transport.get();
    const { framesPerSecond } = this;
    const timeText = framesPerSecond ? shown(timeSeconds * framesPerSecond, 1) : aligned(timeSeconds, 2);
    const picture: ScrubberPicture = {
      ...{ window: this.window, width, height },
      range,
      timeSeconds,
      channels: this.channels,
      markers: this.markers,
      framesPerSecond,
      timeText,
    };
    const wide = Math.round(width * ratio);
    const high = Math.round(height * ratio);
    if (this.element.width !== wide || this.element.height !== high) {
      this.element.width = wide;
      this.element.height = high;
      this.stale = true;
    }
    if (this.stale) this.background.draw(picture, ratio, this.colours);
    this.stale = false;
    const g = this.element.getContext('2d');
    if (!g) return;
    this.background.drawOn(g, picture, ratio, this.colours);
    this.describe(timeSeconds, range);
  }

  private describe(timeSeconds: number, range: readonly [number, number]): void {
    // A screen reader would read every frame.
    if (this.wb.transport.get().playing) return;
    setAttribute(this.element, 'aria-valuemin', String(range[0]));
    setAttribute(this.element, 'aria-valuemax', String(range[1]));
    setAttribute(this.element, 'aria-valuenow', String(timeSeconds));
    const frame = shown(timeSeconds * this.wb.transport.get().framesPerSecond, 2);
    setAttribute(this.element, 'aria-valuetext', `${shown(timeSeconds)} s, frame ${frame}`);
  }

  private dragging = false;

  private listen(): void {
    const { element: canvas } = this;
    canvas.addEventListener('pointerdown', (event) => this.onPointerDown(event));
    canvas.addEventListener('pointermove', (event) => {
      if (this.dragging) return;
      canvas.style.cursor = this.markerAt(event) || this.handleAt(event) !== 'time' ? 'ew-resize' : '';
    });
    canvas.addEventListener('wheel', (event) => this.onWheel(event), { passive: false });
    canvas.addEventListener('dblclick', (event) => {
      if (this.markerAt(event)) this.wb.dialog.set('markers');
      else this.fit();
    });
    canvas.addEventListener('keydown', (event) => this.onKey(event));
    canvas.addEventListener('contextmenu', (event) => this.onMenu(event));
  }

  /** Of the time under the pointer; by keyboard, of the current time. */
  private onMenu(event: MouseEvent): void {
    event.preventDefault();
    if (this.dragging) return;
    if (buttonMeant(event, isMac) !== 2) {
      this.openMenuByKey();
      return;
    }
    const frames = scrubFrames(this.wb, event.shiftKey);
    const time = snapTime(this.timeAt(event.clientX), secondsPerPixel(this.strip), frames);
    openTimeMenu(this.wb, time, { x: event.clientX, y: event.clientY });
  }

  private openMenuByKey(): void {
    const { timeSeconds } = this.wb.transport.get();
    const { left, right, bottom } = this.element.getBoundingClientRect();
    const x = left + timeX(this.strip, timeSeconds);
    openTimeMenu(this.wb, timeSeconds, { x: Math.min(right, Math.max(left, x)), y: bottom, byKeyboard: true });
  }

  /** A window made small in mid-drag leaves it no width, and no times. */
  private isLaidOut(): boolean {
    return this.element.clientWidth > 0;
  }

  private timeAt(clientX: number): number {
    return timeAt(this.strip, clientX - this.element.getBoundingClientRect().left);
  }

  private handleAt(event: PointerEvent): Handle {
    if (event.button === 1) return 'pan';
    const { left, top } = this.element.getBoundingClientRect();
    const [first, last] = this.wb.transport.get().range;
    const { strip } = this;
    const ends = [timeX(strip, first), timeX(strip, last)] as const;
    return rangeHandleAt(event.clientX - left, event.clientY - top, ends) ?? 'time';
  }

  /** The marker whose flag, or the end of whose span, is under the pointer. */
  private markerAt(event: MouseEvent): MarkerHit | undefined {
    const y = event.clientY - this.element.getBoundingClientRect().top - RULER_HEIGHT;
    if (y < 0 || y > MARKER_HEIGHT) return undefined;
    const at = this.timeAt(event.clientX);
    const near = (time: number) => Math.abs(time - at) / secondsPerPixel(this.strip) <= GRAB_PIXELS;
    const index = this.markers.findLastIndex(({ timeSeconds, endSeconds = timeSeconds }) => {
      return near(timeSeconds) || near(endSeconds);
    });
    if (index < 0) return undefined;
    const { timeSeconds, endSeconds } = this.markers[index];
    return { index, isEnd: endSeconds !== undefined && !near(timeSeconds) };
  }

  /** The script of edits is fetched with the first drag. */
  private dragMarker(event: PointerEvent, { index, isEnd }: MarkerHit, grabbed: number): void {
    this.dragging = true;
    let drag: MarkerDrag | undefined;
    let isOver = false;
    let last: PointerEvent | undefined;
    const grabbedOff = grabbed - this.timeOfMarker(index, isEnd);
    const move = (e: PointerEvent) => {
      last = e;
      if (!this.isLaidOut()) return;
      drag?.move(
        snapTime(this.timeAt(e.clientX) - grabbedOff, secondsPerPixel(this.strip), scrubFrames(this.wb, e.shiftKey)),
      );
    };
    void import('../timeline/markers/marker-drag.ts').then(({ MarkerDrag: Made }) => {
      drag = new Made(this.wb, index, isEnd);
      if (last) move(last);
      if (isOver) drag.end();
    });
    followPointer(this.element, event, {
      move,
      over: (_, release) => {
        this.dragging = false;
        isOver = true;
        if (release) drag?.end();
        else {
          drag?.cancel();
          last = undefined;
        }
      },
    });
  }

  private timeOfMarker(index: number, isEnd: boolean): number {
    const { timeSeconds, endSeconds = timeSeconds } = this.markers[index];
    return isEnd ? endSeconds : timeSeconds;
  }

  private onPointerDown(event: PointerEvent): void {
    if (event.button > 1 || this.dragging || !this.isLaidOut()) return;
    event.preventDefault();
    this.element.focus({ preventScroll: true });
    const grabbed = this.timeAt(event.clientX);
    const marker = event.button === 0 ? this.markerAt(event) : undefined;
    if (marker) {
      this.dragMarker(event, marker, grabbed);
      return;
    }
    const handle = this.handleAt(event);
    this.dragging = true;
    if (handle !== 'pan') this.drag(handle, grabbed, event.shiftKey);
    followPointer(this.element, event, {
      move: (e) => {
        if (!this.isLaidOut()) return;
        if (handle === 'pan') this.look(panWindow(this.window, grabbed - this.timeAt(e.clientX)));
        else this.drag(handle, this.timeAt(e.clientX), e.shiftKey);
      },
      over: () => {
        this.dragging = false;
        if (this.wb.timeline.fitted === this.whole && handle !== 'time') this.fit();
      },
    });
  }

  private drag(handle: RangeEnd | 'time', at: number, shift: boolean): void {
    const time = snapTime(at, secondsPerPixel(this.strip), scrubFrames(this.wb, shift));
    this.wb.transport.update((p) => {
      if (handle === 'in') return { ...p, range: [Math.min(time, p.range[1]), p.range[1]] };
      if (handle === 'out') return { ...p, range: [p.range[0], Math.max(time, p.range[0])] };
      return p.timeSeconds === time && !p.playing ? p : { ...p, timeSeconds: time, playing: false };
    });
  }

  private onWheel(event: WheelEvent): void {
    event.preventDefault();
    if (!this.isLaidOut()) return;
    const turn = wheelTurn(event);
    if (turn.what === 'pan') this.look(panWindow(this.window, turn.pixels * secondsPerPixel(this.strip)));
    else this.look(zoomWindow(this.window, this.timeAt(event.clientX), turn.factor));
  }

  private onKey(event: KeyboardEvent): void {
    if (asksForMenu(event)) {
      event.preventDefault();
      event.stopPropagation();
      this.openMenuByKey();
      return;
    }
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const { transport } = this.wb;
    const { timeSeconds } = transport.get();
    switch (event.key) {
      case 'ArrowLeft':
      case 'ArrowDown':
        transport.update((p) => stepFrames(p, event.shiftKey ? -10 : -1));
        break;
      case 'ArrowRight':
      case 'ArrowUp':
        transport.update((p) => stepFrames(p, event.shiftKey ? 10 : 1));
        break;
      case 'PageUp':
        transport.update((p) => ({ ...p, timeSeconds: timeSeconds + 1, playing: false }));
        break;
      case 'PageDown':
        transport.update((p) => ({ ...p, timeSeconds: timeSeconds - 1, playing: false }));
        break;
      case '+':
      case '=':
        this.look(zoomWindow(this.window, timeSeconds, 1 / ZOOM_STEP));
        break;
      case '-':
        this.look(zoomWindow(this.window, timeSeconds, ZOOM_STEP));
        break;
      case 'f':
      case 'a':
        this.fit();
        break;
      default:
        return;
    }
    event.preventDefault();
  }
}

/** Which takes are shown, of which characters. */
function takesOf({ characters }: Document): string {
  return characters.map(({ id, shownTake }) => `${id} ${shownTake}`).join();
}

function readColours(target: Element): ScrubberColours {
  const style = getComputedStyle(target);
  const colour = (name: string) => style.getPropertyValue(name).trim();
  return {
    faint: colour('--text-faint'),
    line: colour('--line-strong'),
    range: colour('--range'),
    edge: colour('--range-edge'),
    key: colour('--key'),
    marker: colour('--warning'),
    markerText: colour('--text'),
    otherKey: colour('--key-other'),
    playhead: colour('--accent'),
    playheadText: colour('--on-accent'),
    font: `${colour('--font-small')} ${style.fontFamily}`,
  };
}
