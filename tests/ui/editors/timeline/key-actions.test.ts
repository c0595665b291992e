import { beforeEach, describe, expect, it } from 'vitest';
import { shownTake } from '../../../../src/model/document.ts';
import { keysOf, restChannel } from '../../../../src/model/takes/take.ts';
import { selectedKeysInView, selectKeys } from '../../../../src/ui/editors/timeline/current-take.ts';
import { selectedText } from '../../../../src/ui/editors/timeline/key-edits.ts';
import { runAction } from '../../../../src/ui/state/actions/action.ts';
import type { Workbench } from '../../../../src/ui/state/workbench.ts';
import { channel, character, documentOf, skeleton, take, workbench } from '../../builders.ts';

let wb: Workbench;
const channelOf = (index: number) => {
  const held = shownTake(wb.store.document.characters[0])?.channels[index];
  if (!held) throw new Error(`no channel ${index}`);
  return held;
};
const times = (index: number) => [...keysOf(channelOf(index)).times];
const run = (id: string) => runAction(wb, `timeline.${id}`);

beforeEach(() => {
  const walker = character({
    skeleton: skeleton(['hips', -1]),
    takes: [take([0, 2], channel(0, 1, 2), channel(0, 2), restChannel(), channel(0.5))],
    timeOffsetSeconds: 0,
  });
  ({ wb } = workbench(documentOf(walker), { range: [0, 2], timeSeconds: 1 }));
});

describe('selecting', () => {
  it('selects all keys in view, inverts, and deselects', () => {
    run('selectAll');
    expect(selectedKeysInView(wb).map((k) => [k.channel, ...k.indices])).toEqual([
      [0, 0, 1, 2],
      [1, 0, 1],
      [3, 0],
    ]);
    selectKeys(wb, [{ channel: 0, indices: [1] }]);
    run('invert');
    expect(selectedKeysInView(wb).map((k) => [k.channel, ...k.indices])).toEqual([
      [0, 0, 2],
      [1, 0, 1],
      [3, 0],
    ]);
    run('selectNone');
    expect(selectedKeysInView(wb)).toEqual([]);
  });

  it('selecting leaves hidden channels alone', () => {
    wb.timeline.change({ hidden: [0, 3] });
    run('selectAll');
    expect(selectedKeysInView(wb).map((k) => k.channel)).toEqual([1]);
  });

  it('uses the playhead, in the transport’s time', () => {
    run('selectHere');
    expect(selectedKeysInView(wb)).toEqual([{ channel: 0, indices: [1] }]);
    run('selectAfter');
    expect(selectedKeysInView(wb).map((k) => k.channel)).toEqual([0, 1]);
    run('selectBefore');
    expect(selectedKeysInView(wb).map((k) => k.channel)).toEqual([0, 1, 3]);
  });

  it('selecting is said in a sentence', () => {
    run('selectHere');
    expect(selectedText(wb)).toBe('1 key of hips tx, at 1 s');
    run('selectAll');
    expect(selectedText(wb)).toBe('6 keys of 3 channels, from 0 s to 2 s');
    run('selectNone');
    expect(selectedText(wb)).toBe('No key is selected.');
  });
});

describe('editing from the keyboard', () => {
  it('nudges by a frame, and undo restores keys and selection', () => {
    run('selectHere');
    run('later');
    expect(times(0)[1]).toBeCloseTo(1 + 1 / 30, 12);
    wb.store.undo();
    expect(times(0)).toEqual([0, 1, 2]);
    expect(selectedKeysInView(wb)).toEqual([{ channel: 0, indices: [1] }]);
  });

  it('nudges angles by a degree and lengths by a hundredth of the character', () => {
    selectKeys(wb, [
      { channel: 0, indices: [0] },
      { channel: 3, indices: [0] },
    ]);
    run('up');
    // The size of a lone joint is that of its box, 0.28.
    expect(keysOf(channelOf(0)).values[0]).toBeCloseTo(0.001, 12);
    expect(keysOf(channelOf(3)).values[0]).toBeCloseTo(Math.PI / 180, 12);
  });

  it('steps the playhead with the same arrows if nothing is selected', () => {
    run('later');
    expect(wb.transport.get().timeSeconds).toBeCloseTo(1 + 1 / 30, 12);
    expect(times(0)).toEqual([0, 1, 2]);
  });

  it('inserts on every curve in view, and does nothing if there is none', () => {
    wb.transport.update((p) => ({ ...p, timeSeconds: 1.5 }));
    run('insertKey');
    expect(times(0)).toEqual([0, 1, 1.5, 2]);
    expect(times(1)).toEqual([0, 1.5, 2]);
    expect(times(2)).toEqual([]);
  });

  it('cuts and pastes at the playhead, repeatedly', () => {
    run('selectHere');
    run('cut');
    expect(times(0)).toEqual([0, 2]);
    wb.transport.update((p) => ({ ...p, timeSeconds: 0.25 }));
    run('paste');
    wb.transport.update((p) => ({ ...p, timeSeconds: 0.75 }));
    run('paste');
    expect(times(0)).toEqual([0, 0.25, 0.75, 2]);
    expect(selectedKeysInView(wb)).toEqual([{ channel: 0, indices: [2] }]);
  });

  it('sets tangents and extrapolation of the selected keys', () => {
    run('selectHere');
    run('tangents.linear');
    expect(keysOf(channelOf(0)).tangentsIn.kinds[1]).toBe(1);
    run('extrapolation.out.cycle');
    expect([channelOf(0).extrapolateOut, channelOf(0).extrapolateIn, channelOf(1).extrapolateOut]).toEqual([
      'cycle',
      'constant',
      'constant',
    ]);
  });

  it('snaps to displayed frames, whatever the take’s offset', () => {
    const loose = character({
      skeleton: skeleton(['hips', -1]),
      takes: [take([0, 2], channel(0.01, 1.02))],
      timeOffsetSeconds: 0.05,
    });
    ({ wb } = workbench(documentOf(loose), { framesPerSecond: 10 }));
    run('selectAll');
    run('snapToFrames');
    expect(times(0).map((t) => Number((t - 0.05).toFixed(9)))).toEqual([0, 1]);
  });

  it('editing from the keyboard is disabled without selected keys', () => {
    expect(() => run('delete')).toThrow('is not available');
    expect(() => run('paste')).toThrow('is not available');
  });
});
