/**
 * The transform box around the selected keys: its edges and corners scale them about the opposite edge, with Alt about
 * the centre.
 */

import { keysOf } from '../../../model/takes/take.ts';
import { button, element, setStyle, write } from '../../widgets/dom.ts';
import { followPointer } from '../../widgets/drag.ts';
import { waitOutDrag } from '../../widgets/focus/keyboard.ts';
import { oncePerFrame } from '../../widgets/frame.ts';
import { timeAt, timeX } from '../../widgets/time/time-window.ts';
import type { CurveScene } from './scene/scene.ts';
import { yOf } from './scene/space.ts';
import { scaler } from './tools/scale.ts';
import type { PlotAccess } from './tools/tool.ts';

/** What the transform box needs of the plot, beyond `PlotAccess`. */
export interface FramedPlot extends PlotAccess {
  readonly element: HTMLElement;
  /** Stops refitting and renormalising meanwhile. */
  freeze(frozen: boolean): void;
}

interface Edges {
  readonly left: number;
  readonly right: number;
  readonly top: number;
  readonly bottom: number;
}

/** −1 left or top, 0 in the middle, 1 right or bottom. */
const GRIPS: readonly (readonly [-1 | 0 | 1, -1 | 0 | 1, string])[] = [
  [-1, -1, 'nwse-resize'],
  [0, -1, 'ns-resize'],
  [1, -1, 'nesw-resize'],
  [-1, 0, 'ew-resize'],
  [1, 0, 'ew-resize'],
  [-1, 1, 'nesw-resize'],
  [0, 1, 'ns-resize'],
  [1, 1, 'nwse-resize'],
];
/** Gap between the keys and the box, so that keys can still be clicked. */
const MARGIN = 12;
/** A side shorter than this can't be scaled. */
const MIN_PIXELS = 2;

export class ScaleFrame {
  readonly element = element('div', { class: 'scale-frame', hidden: true });
  dragging = false;
  private edges: Edges | undefined;
  private readonly grips: readonly { readonly x: number; readonly y: number; readonly element: HTMLElement }[];

  constructor(private readonly plot: FramedPlot) {
    this.grips = GRIPS.map(([x, y, cursor]) => {
      const grip = button('Scale selected keys', { class: 'scale-grip', tabindex: -1 }, undefined, () => {});
      grip.style.left = `${50 + 50 * x}%`;
      grip.style.top = `${50 + 50 * y}%`;
      grip.style.cursor = cursor;
      grip.addEventListener('pointerdown', (event) => this.onPress(event, x, y));
      return { x, y, element: grip };
    });
    this.element.append(...this.grips.map((g) => g.element));
  }

  show(scene: CurveScene | undefined): void {
    const { wb } = this.plot;
    this.edges = scene && wb.timeline.view.get().scaleFrame ? edgesOf(scene) : undefined;
    const { edges, element: frame } = this;
    write(frame, 'hidden', edges === undefined);
    if (!edges) return;
    setStyle(frame, 'transform', `translate(${edges.left - MARGIN}px, ${edges.top - MARGIN}px)`);
    setStyle(frame, 'width', `${edges.right - edges.left + 2 * MARGIN}px`);
    setStyle(frame, 'height', `${edges.bottom - edges.top + 2 * MARGIN}px`);
    const wide = edges.right - edges.left >= MIN_PIXELS;
    const high = edges.bottom - edges.top >= MIN_PIXELS;
    for (const grip of this.grips) write(grip.element, 'hidden', (grip.x !== 0 && !wide) || (grip.y !== 0 && !high));
  }

  private onPress(event: PointerEvent, gripX: number, gripY: number): void {
    const { plot, edges } = this;
    const scale = scaler(plot);
    const first = plot.scene();
    if (this.dragging || event.button !== 0 || !edges || !scale || !first) return;
    event.preventDefault();
    event.stopPropagation();
    const grip = event.currentTarget;
    if (!(grip instanceof HTMLElement)) return;
    plot.element.focus({ preventScroll: true });
    this.dragging = true;
    plot.freeze(true);
    let last = event;
    const move = () => {
      const middle = last.altKey;
      const along = (grip: number, low: number, high: number, by: number) => {
        const pivot = middle ? (low + high) / 2 : grip < 0 ? high : low;
        const arm = (grip < 0 ? low : high) - pivot;
        return { pivot, factor: grip === 0 || arm === 0 ? 1 : (arm + by) / arm };
      };
      const x = along(gripX, edges.left, edges.right, last.clientX - event.clientX);
      const y = along(gripY, edges.top, edges.bottom, last.clientY - event.clientY);
      scale.to({
        pivotSeconds: timeAt(first.space, x.pivot),
        timeFactor: x.factor,
        pivotY: y.pivot,
        valueFactor: y.factor,
      });
    };
    const moveSoon = oncePerFrame(() => this.dragging && move());
    followPointer(grip, event, {
      move: (e) => {
        last = e;
        moveSoon();
      },
      key: waitOutDrag,
      over: (_, release) => {
        if (!release) scale.edit.cancel();
        else {
          if (last !== event) move();
          scale.edit.commit();
        }
        this.dragging = false;
        plot.freeze(false);
        plot.say('');
      },
    });
  }
}

/** Bounds of the selected keys in view; undefined if there is nothing to scale. */
function edgesOf(scene: CurveScene): Edges | undefined {
  const { space, take, offsetSeconds } = scene;
  let left = Number.POSITIVE_INFINITY;
  let right = Number.NEGATIVE_INFINITY;
  let top = Number.POSITIVE_INFINITY;
  let bottom = Number.NEGATIVE_INFINITY;
  let count = 0;
  const lines = new Map(scene.lines.map((l) => [l.channel, l]));
  for (const { channel, indices } of scene.selected) {
    const line = lines.get(channel);
    const keys = keysOf(take.channels[channel]);
    if (!line || !indices.length) continue;
    count += indices.length;
    left = Math.min(left, timeX(space, keys.times[indices[0]] - offsetSeconds));
    right = Math.max(right, timeX(space, keys.times[indices[indices.length - 1]] - offsetSeconds));
    let low = Number.POSITIVE_INFINITY;
    let high = Number.NEGATIVE_INFINITY;
    for (const index of indices) {
      low = Math.min(low, keys.values[index]);
      high = Math.max(high, keys.values[index]);
    }
    top = Math.min(top, yOf(space, line, high));
    bottom = Math.max(bottom, yOf(space, line, low));
  }
  if (count < 2 || bottom < -space.height) return undefined;
  return { left, right, top, bottom };
}
