/**
 * Scales the selected keys. Dragging with S held scales times about the playhead, or values about the pressed height,
 * whichever way the drag starts; the transform box scales about the opposite edge.
 *
 *     t' = pivot + factor · (t − pivot)          v' = pivot + factor · (v − pivot)
 */

import { scaleKeys } from '../../../../edit/commands/keys.ts';
import { shown } from '../../../widgets/numbers/number-text.ts';
import { timeX } from '../../../widgets/time/time-window.ts';
import { editOfTakes, onAllInHand, selectedKeysInView } from '../../timeline/current-take.ts';
import { timelineTake } from '../../timeline/timeline-take.ts';
import { valueAt } from '../scene/space.ts';
import { isSideways } from './move-keys.ts';
import type { Drag, PlotAccess, PointerAt } from './tool.ts';

/** Closer to the pivot than this, a pixel would be an extreme factor. */
const MIN_PIXELS = 32;
/** Pixels upwards that scale values by a factor of e. */
const VALUE_PIXELS = 120;

export interface ScaleTool {
  /** Seconds of the transport. */
  readonly pivotSeconds: number;
  readonly timeFactor: number;
  /** Height of the values' pivot on screen. */
  readonly pivotY: number;
  readonly valueFactor: number;
}

/** Dragging with S held. */
export function scaleDrag(plot: PlotAccess, from: PointerAt): Drag {
  const { wb } = plot;
  const scale = scaler(plot);
  const pivotSeconds = wb.transport.get().timeSeconds;
  /** The initial direction is kept. */
  let sideways: boolean | undefined;
  const move = (at: PointerAt) => {
    const scene = plot.scene();
    if (!scene || !scale) return;
    sideways ??= isSideways(from, at);
    const arm = from.x - timeX(scene.space, pivotSeconds);
    const length = Math.max(MIN_PIXELS, Math.abs(arm));
    const factor = 1 + ((at.x - from.x) * (arm < 0 ? -1 : 1)) / length;
    scale.to({
      pivotSeconds,
      timeFactor: sideways ? factor : 1,
      pivotY: from.y,
      valueFactor: sideways ? 1 : Math.exp((from.y - at.y) / VALUE_PIXELS),
    });
  };
  return {
    cursor: () => (sideways === undefined ? 'nwse-resize' : sideways ? 'ew-resize' : 'ns-resize'),
    move,
    end(at, moved) {
      if (moved) move(at);
      scale?.edit.commit();
    },
    cancel: () => scale?.edit.cancel(),
    cancelled: () => scale?.edit.cancelled ?? false,
  };
}

/** Scales the current selection, as one edit. Undefined if none is in view. */
export function scaler(plot: PlotAccess) {
  const { wb } = plot;
  const current = timelineTake(wb);
  const first = plot.scene();
  if (!current || !first) return undefined;
  const drawn = new Map(first.lines.map((l) => [l.channel, l]));
  const keys = selectedKeysInView(wb);
  if (!keys.length) return undefined;
  const edit = editOfTakes(wb, current.parts);
  const command = onAllInHand(wb, scaleKeys);
  const to = ({ pivotSeconds, timeFactor, pivotY, valueFactor }: ScaleTool) => {
    const scene = plot.scene() ?? first;
    edit.preview(command, {
      characterId: current.character.id,
      keys,
      pivotSeconds: pivotSeconds + current.character.timeOffsetSeconds,
      timeFactor,
      valueFactor,
      pivotValues: keys.map(({ channel }) => {
        const line = drawn.get(channel);
        return line ? valueAt(scene.space, line, pivotY) : 0;
      }),
      onCollision: wb.timeline.view.get().onCollision,
    });
    if (edit.cancelled) return;
    const time = timeFactor === 1 ? '' : `time × ${shown(timeFactor)}`;
    const value = valueFactor === 1 ? '' : `values × ${shown(valueFactor)}`;
    plot.say([time, value].filter(Boolean).join('   '));
  };
  return { edit, to };
}
