/** Dragging on empty ground: box selection. A click there deselects all keys; one on a curve selects its keys. */
import { allKeys, countKeys, unionKeys, withoutKeys } from '../../../../edit/keys/selection.ts';
import type { ChannelKeys } from '../../../../model/session.ts';
import { plural } from '../../../widgets/numbers/number-text.ts';
import type { SelectionBox } from '../../timeline/box.ts';
import { selectedKeys, selectKeys } from '../../timeline/current-take.ts';
import { timelineTake } from '../../timeline/timeline-take.ts';
import { keysInBox } from '../scene/hit.ts';
import type { Drag, PlotAccess, PointerAt } from './tool.ts';

/** @param curve the channel of the curve that was pressed, if any */
export function boxDrag(plot: PlotAccess, from: PointerAt, curve?: number): Drag {
  const { wb } = plot;
  const before = selectedKeys(wb);
  const boxTo = (at: PointerAt): SelectionBox => ({ x0: from.x, y0: from.y, x1: at.x, y1: at.y });
  const select = (found: readonly ChannelKeys[], at: PointerAt) => {
    if (at.ctrl || from.ctrl) selectKeys(wb, withoutKeys(before, found));
    else selectKeys(wb, at.shift || from.shift ? unionKeys(before, found) : found);
  };
  return {
    cursor: () => 'crosshair',
    move(at) {
      const scene = plot.scene();
      plot.showBox(boxTo(at));
      if (!scene) return;
      const count = countKeys(scene.take.channels, keysInBox(scene, boxTo(at)));
      plot.say(plural(count, 'key'));
    },
    end(at, moved) {
      const scene = plot.scene();
      plot.showBox(undefined);
      if (moved && scene) return select(keysInBox(scene, boxTo(at)), at);
      const current = timelineTake(wb);
      if (curve !== undefined && current) select(allKeys(current.take, [curve]), at);
      else if (!from.shift && !from.ctrl) selectKeys(wb, []);
    },
    cancel: () => plot.showBox(undefined),
  };
}
