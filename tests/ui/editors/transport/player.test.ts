import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { setDofs } from '../../../../src/edit/commands/pose.ts';
import { dofState } from '../../../../src/ui/editors/inspector/dof-mark.ts';
import { startPlayer } from '../../../../src/ui/editors/transport/player.ts';
import { oncePerFrame } from '../../../../src/ui/widgets/frame.ts';
import { channel, character, documentOf, skeleton, take, workbench } from '../../builders.ts';

let frames: ((now: number) => void)[] = [];
let stop: AbortController;

/** Runs the browser's next frame, at this many milliseconds. */
function frame(now: number): void {
  const due = frames;
  frames = [];
  for (const callback of due) callback(now);
}

beforeEach(() => {
  stop = new AbortController();
  vi.stubGlobal('requestAnimationFrame', (callback: (now: number) => void) => frames.push(callback));
});
afterEach(() => {
  stop.abort();
  // The frames of all tests are the same.
  while (frames.length) frame(0);
  vi.unstubAllGlobals();
});

it('advances time by the elapsed time between frames', () => {
  const { wb, seeks } = workbench(undefined, { range: [0, 10], playing: true });
  startPlayer(wb, stop.signal);
  for (const now of [5000, 5016, 5050]) frame(now);
  expect(wb.transport.get().timeSeconds).toBeCloseTo(0.05);
  expect(seeks).toEqual([0, 0.016, expect.closeTo(0.05)]);
});

it('time stands still until the page is ready, and then goes on without a jump', async () => {
  const { wb } = workbench(undefined, { range: [0, 10], playing: true });
  let isReady = () => {};
  const ready = new Promise<void>((resolve) => {
    isReady = resolve;
  });
  startPlayer(wb, stop.signal, ready);
  wb.transport.update((p) => ({ ...p, rate: 2 }));
  expect(frames).toHaveLength(0);
  isReady();
  await ready;
  for (const now of [5000, 5016]) frame(now);
  expect(wb.transport.get().timeSeconds).toBeCloseTo(0.032);
});

it('playback advances and is drawn in every frame', () => {
  const { wb } = workbench(undefined, { range: [0, 10], playing: true });
  const drawn: number[] = [];
  wb.transport.subscribe(oncePerFrame(() => drawn.push(wb.transport.get().timeSeconds), 'draw'));
  startPlayer(wb, stop.signal);
  for (let i = 0; i <= 10; i++) frame(16 * i);
  expect(drawn.map((seconds) => Math.round(1000 * seconds))).toEqual([16, 32, 48, 64, 80, 96, 112, 128, 144, 160]);
});

it('requests frames only while playing', () => {
  const { wb } = workbench(undefined, { range: [0, 10] });
  startPlayer(wb, stop.signal);
  expect(frames).toHaveLength(0);
  wb.transport.update((p) => ({ ...p, playing: true }));
  expect(frames).toHaveLength(1);
  frame(0);
  wb.transport.update((p) => ({ ...p, playing: false }));
  frame(16);
  expect(frames).toHaveLength(0);
});

it('does not jump after a pause, or after an hour in the background', () => {
  const { wb } = workbench(undefined, { range: [0, 100], playing: true });
  startPlayer(wb, stop.signal);
  frame(0);
  frame(3_600_000);
  expect(wb.transport.get().timeSeconds).toBe(1);
  wb.transport.update((p) => ({ ...p, playing: false }));
  frame(3_600_016);
  wb.transport.update((p) => ({ ...p, playing: true }));
  frame(3_700_000);
  expect(wb.transport.get().timeSeconds).toBe(1);
});

describe('values set by hand and not keyed', () => {
  const legs = skeleton(['hips', -1]);
  const driven = take([0, 1], channel(0), channel(0), channel(0), channel(0), channel(0));
  const unkeyed = { timeSeconds: 0, dofs: [3], values: [1] };
  const setAt = (timeSeconds = 0) => {
    const { wb } = workbench(documentOf(character({ skeleton: legs, takes: [driven] })), {
      range: [0, 1],
      timeSeconds,
    });
    startPlayer(wb, stop.signal);
    wb.store.apply(setDofs, { characterId: 'c1', dofs: [{ index: 3, value: 1 }], timeSeconds });
    const now = () => wb.store.document.characters[0].unkeyed;
    const seek = (to: number) => wb.transport.update((p) => ({ ...p, timeSeconds: to }));
    return { wb, now, seek };
  };

  it('unkeyed changes are discarded when the time changes, with a message', async () => {
    const { wb, now, seek } = setAt();
    expect(now()).toEqual(unkeyed);
    seek(0.5);
    expect(now()).toBeUndefined();
    await expect
      .poll(() => wb.messages.passing.get())
      .toBe('Unkeyed change discarded. Ctrl+Z restores it, press K before changing the time to keep them.');
    expect(wb.messages.offers[0]?.label).toBe('Undo');
    const step = wb.store.undoLabel;
    wb.messages.offers[0]?.run();
    expect([step, wb.store.redoLabel]).toEqual([expect.any(String), step]);
    wb.store.redo();
  });

  it('no message tells of discarded changes that were restored before it came', async () => {
    const { wb, now, seek } = setAt();
    seek(0.5);
    wb.store.undo();
    await vi.dynamicImportSettled();
    expect(now()).toEqual(unkeyed);
    expect(wb.messages.passing.get()).toBeUndefined();
  });

  it('unkeyed changes are restored by undo, with their time', () => {
    const { wb, now, seek } = setAt();
    seek(0.5);
    expect(wb.store.undoLabel).toBe('Discard 1 unkeyed change');
    wb.transport.update((p) => ({ ...p, playing: true }));
    wb.store.undo();
    expect(now()).toEqual(unkeyed);
    expect(wb.transport.get()).toMatchObject({ timeSeconds: 0, playing: false });
  });

  it('unkeyed changes stay, invisible, while something can be redone', () => {
    const { wb, now, seek } = setAt();
    wb.store.apply(setDofs, { characterId: 'c1', dofs: [{ index: 4, value: 2 }], timeSeconds: 0 });
    wb.store.undo();
    seek(0.5);
    expect(now()).toEqual(unkeyed);
    expect(dofState(wb, wb.store.document.characters[0], 3)).toBe('driven');
    expect(wb.store.redo()).toBe(true);
    expect(now()?.dofs).toEqual([3, 4]);
    expect(wb.transport.get().timeSeconds).toBe(0);
  });
});

it('stops when aborted', () => {
  const { wb, seeks } = workbench(undefined, { range: [0, 10], playing: true });
  const stop = new AbortController();
  startPlayer(wb, stop.signal);
  stop.abort();
  frame(16);
  wb.transport.update((p) => ({ ...p, timeSeconds: 3 }));
  expect(seeks).toEqual([0]);
});
