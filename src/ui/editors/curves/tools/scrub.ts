/**
 * Dragging in the ruler moves the playhead: to whole frames if *Snap to frames* is on, or with Shift if it is off.
 */
import { snapTime } from '../../../widgets/time/time-window.ts';
import { scrubFrames } from '../../timeline/scrub-frames.ts';
import { pixelsPerSecond, timeAt } from '../scene/space.ts';
import { type Drag, NOTHING_TO_UNDO, type PlotAccess, type PointerAt } from './tool.ts';

export function scrubDrag(plot: PlotAccess): Drag {
  const move = (at: PointerAt) => {
    const space = plot.scene()?.space;
    if (!space) return;
    const timeSeconds = snapTime(timeAt(space, at.x), 1 / pixelsPerSecond(space), scrubFrames(plot.wb, at.shift));
    plot.wb.transport.update((p) =>
      p.timeSeconds === timeSeconds && !p.playing ? p : { ...p, timeSeconds, playing: false },
    );
  };
  return { cursor: () => 'col-resize', move, end: move, cancel: NOTHING_TO_UNDO };
}
