/**
 * What a press of the left button starts.
 *
 *     a diamond        selects its keys; Shift adds or removes; dragging moves the selection
 *       with Ctrl      drags a copy
 *       with Alt       moves all later keys along (ripple); inverted if ripple is switched on
 *     the strip's bar  moves the selection, its ends scale it about the other end, with Alt about the playhead
 *     anything else    a box: Shift adds, Ctrl removes; a click deselects
 */
import { areSelected } from '../../../edit/keys/row-keys.ts';
import { toggleKeys, unionKeys, withoutKeys } from '../../../edit/keys/selection.ts';
import { selectedKeys, selectedKeysInView, selectKeys } from '../timeline/current-take.ts';
import type { DopeDrag, DopeHost, Pointer } from './gesture.ts';
import type { SheetHit } from './hit.ts';
import { MoveKeys, type MoveWay, ScaleKeys } from './key-drags.ts';
import { SelectBox } from './select-box.ts';

/** Undefined if the press does nothing more. */
export function gestureAt(host: DopeHost, hit: SheetHit, at: Pointer): DopeDrag | undefined {
  switch (hit.kind) {
    case 'keys':
      return pressKeys(host, hit, at);
    case 'strip':
      return hit.part === 'body' ? new MoveKeys(host, at, moveWay(host, at)) : new ScaleKeys(host, at, hit.part);
    case 'row':
      return new SelectBox(host, at, hit.row === 0);
    case 'nothing':
      return new SelectBox(host, at, false);
  }
}

/** A press on a diamond selects before anything is moved. */
function pressKeys(
  host: DopeHost,
  { keys, timeSeconds }: Extract<SheetHit, { kind: 'keys' }>,
  at: Pointer,
): DopeDrag | undefined {
  const { wb } = host;
  const before = selectedKeys(wb);
  const had = areSelected(keys, before);
  if (at.shift && had) {
    selectKeys(wb, withoutKeys(before, keys));
    return undefined;
  }
  if (!had) selectKeys(wb, at.shift ? unionKeys(before, keys) : keys);
  const drag = new MoveKeys(host, at, moveWay(host, at), timeSeconds);
  return {
    get readout() {
      return drag.readout;
    },
    move: (to) => drag.move(to),
    cancel: () => drag.cancel(),
    release(to, moved) {
      drag.release(to, moved);
      // A click selects this diamond only, even if it was part of a selection.
      if (!moved && !at.shift) selectKeys(wb, at.ctrl ? toggleKeys(before, keys) : keys);
    },
  };
}

function moveWay({ wb }: DopeHost, at: Pointer): MoveWay {
  if (at.ctrl) return 'copy';
  return at.alt === wb.timeline.view.get().ripples ? 'move' : 'ripple';
}

/** The cursor for a press. */
export function cursorFor({ wb }: DopeHost, hit: SheetHit, held: Pick<Pointer, 'ctrl' | 'shift'>): string {
  switch (hit.kind) {
    case 'strip':
      if (hit.part !== 'body') return 'ew-resize';
      return held.ctrl ? 'copy' : 'move';
    case 'keys':
      if (held.shift) return 'pointer';
      if (held.ctrl) return 'copy';
      return areSelected(hit.keys, selectedKeysInView(wb)) ? 'move' : 'pointer';
    default:
      return held.shift || held.ctrl ? 'crosshair' : 'default';
  }
}
