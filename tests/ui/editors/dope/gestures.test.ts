import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { spanOf } from '../../../../src/edit/keys/row-keys.ts';
import { shownTake } from '../../../../src/model/document.ts';
import type { ChannelKeys } from '../../../../src/model/session.ts';
import { keysOf, restChannel } from '../../../../src/model/takes/take.ts';
import type { DopeHost, Pointer } from '../../../../src/ui/editors/dope/gesture.ts';
import { gestureAt } from '../../../../src/ui/editors/dope/gestures.ts';
import { hitSheet, type SheetKeys } from '../../../../src/ui/editors/dope/hit.ts';
import { rowTop, type Sheet } from '../../../../src/ui/editors/dope/sheet.ts';
import { selectKeys } from '../../../../src/ui/editors/timeline/current-take.ts';
import { dopeRows } from '../../../../src/ui/editors/timeline/dope-rows.ts';
import { nudge } from '../../../../src/ui/editors/timeline/key-edits.ts';
import { channel, character, documentOf, skeleton, take, workbench } from '../../builders.ts';

beforeEach(() => {
  vi.stubGlobal('window', { addEventListener: () => {}, removeEventListener: () => {} });
});
afterEach(() => void vi.unstubAllGlobals());

/**
 * 100 pixels per second, ten frames per second: ten pixels per frame. The hips have keys at 1, 2 and 4 s, two of them
 * at 1 s.
 */
const SHEET: Sheet = {
  width: 1000,
  height: 200,
  window: { from: 0, to: 10 },
  rowHeight: 20,
  rowCount: 2,
  scrollTop: 0,
};
const HELD = { shift: false, ctrl: false, alt: false };

function stage() {
  const none = restChannel();
  const walking = take([0, 5], none, none, none, channel(1, 2, 4), channel(1), none);
  const wasp = character({ skeleton: skeleton(['hips', -1]), takes: [walking] });
  const { wb } = workbench(documentOf(wasp), { framesPerSecond: 10 });
  wb.timeline.change({ tab: 'dope' });
  const hero = () => wb.store.document.characters[0];
  const channels = () => shownTake(hero())?.channels ?? [];
  const keys = (): readonly ChannelKeys[] => wb.store.selection.keys ?? [];
  const rows = dopeRows(hero(), walking, { unfolded: [], all: false, filter: '' });
  const shown = (): SheetKeys => ({
    rows,
    channels: channels(),
    offsetSeconds: 0,
    selectedSpan: spanOf(channels(), keys()),
  });
  const host: DopeHost = { wb, sheet: () => SHEET, shown };
  const drag = (from: Pointer, to?: Pointer) => {
    const gesture = gestureAt(host, hitSheet(SHEET, shown(), from.x, from.y), from);
    if (to) gesture?.move(to);
    return gesture;
  };
  /** Drags from one point to another and releases. */
  const dragTo = (from: Pointer, to: Pointer) => drag(from, to)?.release(to, true);
  const click = (at: Pointer) => drag(at)?.release(at, false);
  const times = (c = 3) => [...keysOf(channels()[c]).times].map((t) => Number(t.toFixed(6)));
  return { wb, drag, dragTo, click, times, keys };
}

const onHips = (seconds: number, held = {}): Pointer => ({
  x: 100 * seconds,
  y: rowTop(SHEET, 1) + 10,
  ...HELD,
  ...held,
});
const onStrip = (seconds: number, held = {}): Pointer => ({ ...onHips(seconds, held), y: 4 });

const AT_ONE = [
  { channel: 3, indices: [0] },
  { channel: 4, indices: [0] },
];
const AT_TWO = [{ channel: 3, indices: [1] }];

describe('a click', () => {
  it('a click on a diamond selects exactly its keys', () => {
    const { click, keys } = stage();
    click(onHips(2));
    expect(keys()).toEqual(AT_TWO);
    click(onHips(1));
    expect(keys()).toEqual(AT_ONE);
  });

  it('Shift+click adds a diamond, and removes it again', () => {
    const { click, keys } = stage();
    click(onHips(1));
    click(onHips(2, { shift: true }));
    expect(keys()).toEqual([{ channel: 3, indices: [0, 1] }, AT_ONE[1]]);
    click(onHips(1, { shift: true }));
    expect(keys()).toEqual(AT_TWO);
  });

  it('a click on one of several selected diamonds selects that one only', () => {
    const { click, keys } = stage();
    click(onHips(1));
    click(onHips(2, { shift: true }));
    click(onHips(2));
    expect(keys()).toEqual(AT_TWO);
  });

  it('a click beside the keys deselects', () => {
    const { click, keys } = stage();
    click(onHips(1));
    click(onHips(3));
    expect(keys()).toEqual([]);
  });
});

describe('dragging a diamond', () => {
  it('moves its keys to frames as one step', () => {
    const { wb, dragTo, times, keys } = stage();
    dragTo(onHips(1), onHips(1.54));
    expect([times(3), times(4)]).toEqual([[1.5, 2, 4], [1.5]]);
    expect(keys()).toEqual(AT_ONE);
    wb.store.undo();
    expect([times(3), times(4)]).toEqual([[1, 2, 4], [1]]);
    expect(wb.store.undoLabel).toBeUndefined();
  });

  it('dragging a diamond keeps the same keys when passing others', () => {
    const { dragTo, times, keys } = stage();
    dragTo(onHips(2), onHips(5));
    expect(times()).toEqual([1, 4, 5]);
    expect(keys()).toEqual([{ channel: 3, indices: [2] }]);
  });

  it('a key between frames that is dragged and brought back is where it was, to the last digit', () => {
    const { wb, drag } = stage();
    wb.transport.update((p) => ({ ...p, framesPerSecond: 7.3 }));
    const { document } = wb.store;
    const gesture = drag(onHips(2));
    gesture?.move(onHips(2.6));
    expect(wb.store.document).not.toBe(document);
    gesture?.move(onHips(2));
    gesture?.release(onHips(2), true);
    expect(wb.store.document).toBe(document);
    expect(wb.store.undoLabel).toBeUndefined();
  });

  it('Ctrl during the drag disables snapping', () => {
    const { dragTo, times } = stage();
    dragTo(onHips(2), onHips(2.34, { ctrl: true }));
    expect(times()).toEqual([1, 2.34, 4]);
  });

  it('Alt moves the later keys of its channels too', () => {
    const { dragTo, times } = stage();
    dragTo(onHips(2, { alt: true }), onHips(2.5, { alt: true }));
    expect([times(3), times(4)]).toEqual([[1, 2.5, 4.5], [1]]);
  });

  it('ripples without Alt if ripple is on, and not with Alt', () => {
    const { wb, dragTo, times } = stage();
    wb.timeline.change({ ripples: true });
    dragTo(onHips(2), onHips(2.5));
    expect(times()).toEqual([1, 2.5, 4.5]);
    dragTo(onHips(2.5, { alt: true }), onHips(3));
    expect(times()).toEqual([1, 3, 4.5]);
  });

  it('Ctrl from the press on moves copies, on frames', () => {
    const { wb, dragTo, times, keys } = stage();
    dragTo(onHips(1, { ctrl: true }), onHips(3.02, { ctrl: true }));
    expect([times(3), times(4)]).toEqual([
      [1, 2, 3, 4],
      [1, 3],
    ]);
    expect(keys()).toEqual([
      { channel: 3, indices: [2] },
      { channel: 4, indices: [1] },
    ]);
    wb.store.undo();
    expect(times(4)).toEqual([1]);
  });

  it('Escape cancels dragging a diamond, without a step', () => {
    const { wb, drag, times } = stage();
    drag(onHips(2), onHips(3))?.cancel();
    expect(times()).toEqual([1, 2, 4]);
    expect(wb.store.undoLabel).toBeUndefined();
  });

  it('shows the distance, and the number of keys', () => {
    const { drag } = stage();
    expect(drag(onHips(1), onHips(1.5))?.readout).toBe('+0.5 s · 2 keys');
  });
});

describe('the strip', () => {
  function withTwo() {
    const staged = stage();
    selectKeys(staged.wb, [{ channel: 3, indices: [1, 2] }]);
    return staged;
  }

  it('moves the selection by its middle', () => {
    const { dragTo, times } = withTwo();
    dragTo(onStrip(3), onStrip(3.5));
    expect(times()).toEqual([1, 2.5, 4.5]);
  });

  it('scales about the other end', () => {
    const { dragTo, times } = withTwo();
    dragTo(onStrip(4), onStrip(6));
    expect(times()).toEqual([1, 2, 6]);
  });

  it('scales about the playhead with Alt', () => {
    const { wb, dragTo, times } = withTwo();
    wb.transport.update((p) => ({ ...p, timeSeconds: 3 }));
    dragTo(onStrip(4), onStrip(4.5, { alt: true }));
    expect(times()).toEqual([1, 1.5, 4.5]);
  });

  it('the strip never scales past the fixed end', () => {
    const { dragTo, times } = withTwo();
    dragTo(onStrip(4), onStrip(0.5));
    expect(times()).toEqual([1, 2, 2.1]);
  });
});

describe('a box', () => {
  it('selects, adds with Shift and removes with Ctrl', () => {
    const { dragTo, keys } = stage();
    dragTo(onHips(1.8), onHips(2.2));
    expect(keys()).toEqual(AT_TWO);
    dragTo(onHips(3.8, { shift: true }), onHips(4.2));
    expect(keys()).toEqual([{ channel: 3, indices: [1, 2] }]);
    dragTo(onHips(1.8, { ctrl: true }), onHips(2.2));
    expect(keys()).toEqual([{ channel: 3, indices: [2] }]);
  });

  it('a box is no undo step, and Escape restores the selection', () => {
    const { wb, click, drag, keys } = stage();
    click(onHips(1));
    const box = drag(onHips(1.8), onHips(2.2));
    expect(keys()).toEqual(AT_TWO);
    box?.cancel();
    expect(keys()).toEqual(AT_ONE);
    expect(wb.store.undoLabel).toBeUndefined();
  });
});

describe('the arrow keys', () => {
  it('ripple later keys while ripple is on, as dragging does', () => {
    const { wb, click, times } = stage();
    click(onHips(2));
    nudge(wb, 1, 0);
    expect(times()).toEqual([1, 2.1, 4]);
    wb.timeline.change({ ripples: true });
    nudge(wb, 1, 0);
    expect(times()).toEqual([1, 2.2, 4.1]);
  });
});
