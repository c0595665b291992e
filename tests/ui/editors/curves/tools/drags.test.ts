import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { shownTake } from '../../../../../src/model/document.ts';
import { keysOf } from '../../../../../src/model/takes/take.ts';
import { PlotScene } from '../../../../../src/ui/editors/curves/plot-scene.ts';
import { yOf } from '../../../../../src/ui/editors/curves/scene/space.ts';
import { keysDrag } from '../../../../../src/ui/editors/curves/tools/move-keys.ts';
import { scaleDrag } from '../../../../../src/ui/editors/curves/tools/scale.ts';
import { slopeDrag } from '../../../../../src/ui/editors/curves/tools/slope.ts';
import type { PlotAccess, PointerAt } from '../../../../../src/ui/editors/curves/tools/tool.ts';
import { selectedKeysInView, selectKeys } from '../../../../../src/ui/editors/timeline/current-take.ts';
import { deleteKeys, insertAtPlayhead } from '../../../../../src/ui/editors/timeline/key-edits.ts';
import type { Workbench } from '../../../../../src/ui/state/workbench.ts';
import { timeX } from '../../../../../src/ui/widgets/time/time-window.ts';
import { channel, character, documentOf, skeleton, take, workbench } from '../../../builders.ts';

let wb: Workbench;
let plot: PlotAccess;
const held = (index: number) => {
  const found = shownTake(wb.store.document.characters[0])?.channels[index];
  if (!found) throw new Error(`no channel ${index}`);
  return found;
};
const at = (x: number, y: number, more: Partial<PointerAt> = {}): PointerAt => ({
  x,
  y,
  shift: false,
  ctrl: false,
  alt: false,
  ...more,
});
/** Screen position of a key. */
const pointOf = (index: number, key: number, more: Partial<PointerAt> = {}): PointerAt => {
  const scene = plot.scene();
  const line = scene?.lines.find((l) => l.channel === index);
  if (!scene || !line) throw new Error('not drawn');
  const { times, values } = keysOf(held(index));
  return at(timeX(scene.space, times[key]), yOf(scene.space, line, values[key]), more);
};

beforeEach(() => {
  vi.stubGlobal('window', { addEventListener: () => {}, removeEventListener: () => {} });
  const walker = character({
    skeleton: skeleton(['hips', -1]),
    takes: [take([0, 2], channel(0, 1, 2), channel(0, 2), channel(0), channel(0.5, 1.5))],
  });
  ({ wb } = workbench(documentOf(walker), { range: [0, 2], framesPerSecond: 10 }));
  wb.timeline.change({ window: { from: 0, to: 2 }, snapsToFrames: false });
  const scene = new PlotScene(wb);
  scene.width = 200;
  scene.height = 200;
  wb.store.subscribe(() => scene.invalidate());
  wb.timeline.view.subscribe(() => scene.invalidate());
  plot = { wb, scene: () => scene.scene, look: () => {}, showBox: () => {}, say: () => {} };
});

afterEach(() => void vi.unstubAllGlobals());

/** Presses on a key and drags it. */
function drag(index: number, key: number, dx: number, dy: number, more: Partial<PointerAt> = {}) {
  const from = pointOf(index, key, more);
  const made = keysDrag(plot, { kind: 'key', channel: index, index: key }, from);
  const to = at(from.x + dx, from.y + dy, more);
  made.move(to);
  return { ...made, to };
}

describe('dragging keys', () => {
  it('drags the pressed key only', () => {
    selectKeys(wb, [{ channel: 1, indices: [0] }]);
    const { end, to } = drag(0, 1, 0, 0);
    end(to, false);
    expect(selectedKeysInView(wb)).toEqual([{ channel: 0, indices: [1] }]);
  });

  it('moves a key by what the pixels mean, as one undo step', () => {
    const { end, to } = drag(0, 1, 25, -50);
    end(to, true);
    // 100 pixels per second; 200 pixels for a length of 2.
    expect(keysOf(held(0)).times[1]).toBeCloseTo(1.25, 9);
    expect(keysOf(held(0)).values[1]).toBeCloseTo(0.5, 9);
    wb.store.undo();
    expect([...keysOf(held(0)).times]).toEqual([0, 1, 2]);
  });

  it('dragging keys does not drift, however often it is moved on the way', () => {
    const { move, end, to } = drag(0, 1, 25, 0);
    for (let i = 0; i < 50; i++) move(at(to.x + 100 * Math.sin(i), to.y));
    end(to, true);
    expect(keysOf(held(0)).times[1]).toBeCloseTo(1.25, 9);
  });

  it('constrains to the dominant direction while Shift is held', () => {
    const { end, to } = drag(0, 1, 25, -10, { shift: true });
    end(to, true);
    expect(keysOf(held(0)).times[1]).toBeCloseTo(1.25, 9);
    expect(keysOf(held(0)).values[1]).toBe(0);
  });

  it('snaps to frames if switched on, and with Ctrl if not', () => {
    wb.timeline.change({ snapsToFrames: true });
    const { move, end, to } = drag(0, 1, 23, 0);
    expect(keysOf(held(0)).times[1]).toBeCloseTo(1.2, 9);
    move({ ...to, ctrl: true });
    expect(keysOf(held(0)).times[1]).toBeCloseTo(1.23, 9);
    end({ ...to, ctrl: true }, true);
  });

  it('moves the selection equally on screen, each key on its own axis', () => {
    selectKeys(wb, [
      { channel: 0, indices: [1] },
      { channel: 3, indices: [0] },
    ]);
    const { end, to } = drag(0, 1, 10, -20);
    end(to, true);
    expect(keysOf(held(3)).times[0]).toBeCloseTo(0.6, 9);
    // 200 pixels are π of an angle and 2 of a length.
    expect(keysOf(held(0)).values[1]).toBeCloseTo(0.2, 9);
    expect(keysOf(held(3)).values[0]).toBeCloseTo((0.2 * Math.PI) / 2, 9);
  });

  it('leaves selected keys out of view alone', () => {
    selectKeys(wb, [
      { channel: 0, indices: [1] },
      { channel: 1, indices: [1] },
    ]);
    wb.timeline.change({ hidden: [1] });
    const { end, to } = drag(0, 1, 10, 0);
    end(to, true);
    expect(keysOf(held(1)).times[1]).toBe(2);
    // Still selected: they are editable again when the curve is shown.
    wb.timeline.change({ hidden: [] });
    expect(selectedKeysInView(wb)).toEqual([
      { channel: 0, indices: [1] },
      { channel: 1, indices: [1] },
    ]);
  });

  it('ends when the key is deleted meanwhile, and moves no other one', () => {
    selectKeys(wb, [{ channel: 0, indices: [1] }]);
    const { move, end, to } = drag(0, 1, 10, 0);
    deleteKeys(wb);
    move({ ...to, x: to.x + 30 });
    end({ ...to, x: to.x + 30 }, true);
    expect([...keysOf(held(0)).times]).toEqual([0, 2]);
  });

  it('ends when an inserted key is undone meanwhile', () => {
    insertAtPlayhead(wb, [3]);
    const { move, end, to, cancelled } = drag(3, 0, 10, 0);
    wb.store.undo();
    wb.store.undo();
    expect(cancelled?.()).toBe(true);
    move({ ...to, x: to.x + 30 });
    end({ ...to, x: to.x + 30 }, true);
    expect([...keysOf(held(3)).times]).toEqual([0.5, 1.5]);
    expect(wb.store.redoLabel).toBeDefined();
  });

  it('dragging keys does not start on another take than the pressed one', () => {
    const from = pointOf(0, 1);
    const made = keysDrag(plot, { kind: 'key', channel: 0, index: 1 }, from);
    const [walker] = wb.store.document.characters;
    const takes = [...walker.takes, take([0, 2], channel(0, 1, 2))];
    const document = { ...wb.store.document, characters: [{ ...walker, takes, shownTake: 1 }] };
    wb.store.replace('Another take', document);
    const put = wb.store.document;
    made.move(at(from.x + 50, from.y));
    made.end(at(from.x + 50, from.y), true);
    expect(wb.store.document).toBe(put);
    expect(wb.store.undoLabel).toBe('Another take');
  });

  it('restores everything when cancelled', () => {
    const before = wb.store.document;
    drag(0, 1, 40, 40).cancel();
    expect(wb.store.document).toBe(before);
    expect(wb.store.undoLabel).toBeUndefined();
  });
});

describe('dragging a handle', () => {
  it('sets the slope of both sides if they were equal, and keeps the selection', () => {
    const keys = [{ channel: 0, indices: [0, 1] }];
    selectKeys(wb, keys);
    const key = pointOf(0, 1);
    const made = slopeDrag(plot, { kind: 'handle', channel: 0, index: 1, side: 'out' });
    made.end(at(key.x + 40, key.y - 40), true);
    // A pixel sideways is 0.01 s, one upwards 0.01.
    expect(keysOf(held(0)).tangentsOut.slopes[1]).toBeCloseTo(1, 9);
    expect(keysOf(held(0)).tangentsIn.slopes[1]).toBeCloseTo(1, 9);
    expect(selectedKeysInView(wb)).toEqual(keys);
  });

  it('sets one side only with Alt', () => {
    selectKeys(wb, [{ channel: 0, indices: [1] }]);
    const key = pointOf(0, 1);
    slopeDrag(plot, { kind: 'handle', channel: 0, index: 1, side: 'out' }).end(
      at(key.x + 40, key.y - 40, { alt: true }),
      true,
    );
    expect(keysOf(held(0)).tangentsOut.slopes[1]).toBeCloseTo(1, 9);
    expect(keysOf(held(0)).tangentsIn.kinds[1]).toBe(0);
  });
});

describe('scaling with S', () => {
  it('leaves keys out of view alone, and selected', () => {
    const keys = [0, 1].map((c) => ({ channel: c, indices: [0, 1] }));
    selectKeys(wb, keys);
    wb.timeline.change({ hidden: [1] });
    scaleDrag(plot, at(100, 100)).end(at(150, 101), true);
    expect([...keysOf(held(1)).times]).toEqual([0, 2]);
    expect(wb.store.selection.keys).toEqual(keys);
  });

  it('scales about the playhead, in the initial direction', () => {
    selectKeys(wb, [{ channel: 0, indices: [0, 1, 2] }]);
    const made = scaleDrag(plot, at(100, 100));
    made.move(at(150, 101));
    made.end(at(150, 160), true);
    expect([...keysOf(held(0)).times].map((t) => Number(t.toFixed(9)))).toEqual([0, 1.5, 3]);
    expect([...keysOf(held(0)).values]).toEqual([0, 0, 0]);
  });
});
