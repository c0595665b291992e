import { afterEach, beforeEach, expect, it, vi } from 'vitest';
import { setDofs } from '../../src/edit/commands/pose.ts';
import { startPlayer } from '../../src/ui/player.ts';
import { channel, character, clip, documentOf, skeleton, workbench } from './builders.ts';

let frames: ((now: number) => void)[] = [];

/** The browser's next frame, at this many milliseconds. */
function frame(now: number): void {
  const due = frames;
  frames = [];
  for (const callback of due) callback(now);
}

beforeEach(() => {
  frames = [];
  vi.stubGlobal('requestAnimationFrame', (callback: (now: number) => void) => frames.push(callback));
  vi.stubGlobal('cancelAnimationFrame', () => {
    frames = [];
  });
});
afterEach(() => void vi.unstubAllGlobals());

it('moves time on by what passed between frames', () => {
  const { wb, seeks } = workbench(undefined, { range: [0, 10], playing: true });
  startPlayer(wb, new AbortController().signal);
  for (const now of [5000, 5016, 5050]) frame(now);
  expect(wb.transport.get().timeSeconds).toBeCloseTo(0.05);
  expect(seeks).toEqual([0, 0.016, expect.closeTo(0.05)]);
});

it('asks for frames only while it plays', () => {
  const { wb } = workbench(undefined, { range: [0, 10] });
  startPlayer(wb, new AbortController().signal);
  expect(frames).toHaveLength(0);
  wb.transport.update((p) => ({ ...p, playing: true }));
  expect(frames).toHaveLength(1);
  frame(0);
  wb.transport.update((p) => ({ ...p, playing: false }));
  frame(16);
  expect(frames).toHaveLength(0);
});

it('does not jump over a pause, or over an hour in the background', () => {
  const { wb } = workbench(undefined, { range: [0, 100], playing: true });
  startPlayer(wb, new AbortController().signal);
  frame(0);
  frame(3_600_000);
  expect(wb.transport.get().timeSeconds).toBe(1);
  wb.transport.update((p) => ({ ...p, playing: false }));
  frame(3_600_016);
  wb.transport.update((p) => ({ ...p, playing: true }));
  frame(3_700_000);
  expect(wb.transport.get().timeSeconds).toBe(1);
});

it('drops values set by hand and not keyed when time moves, without an undo step', () => {
  const legs = skeleton(['hips', -1]);
  const driven = clip([0, 1], channel(0), channel(0), channel(0), channel(0));
  const { wb } = workbench(documentOf(character({ skeleton: legs, clips: [driven] })), { range: [0, 1] });
  startPlayer(wb, new AbortController().signal);
  wb.store.apply(setDofs, { characterId: 'c1', dofs: [{ index: 3, value: 1 }], timeSeconds: 0 });
  expect(wb.store.document.characters[0].unkeyed).toEqual({ timeSeconds: 0, dofs: [3], values: [1] });
  wb.transport.update((p) => ({ ...p, timeSeconds: 0.5 }));
  expect(wb.store.document.characters[0].unkeyed).toBeUndefined();
  expect(wb.store.undoLabel).toBe('Set rx of hips');
});

it('stops with the signal', () => {
  const { wb, seeks } = workbench(undefined, { range: [0, 10], playing: true });
  const stop = new AbortController();
  startPlayer(wb, stop.signal);
  stop.abort();
  frame(16);
  wb.transport.update((p) => ({ ...p, timeSeconds: 3 }));
  expect(seeks).toEqual([0]);
});
