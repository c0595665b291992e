import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { setDofs } from '../../../../src/edit/commands/pose.ts';
import { dofState } from '../../../../src/ui/editors/inspector/dof-mark.ts';
import { startPlayer } from '../../../../src/ui/editors/transport/player.ts';
import { channel, character, clip, documentOf, skeleton, workbench } from '../../builders.ts';

let frames: ((now: number) => void)[] = [];

/** Runs the browser's next frame, at this many milliseconds. */
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

it('advances time by the elapsed time between frames', () => {
  const { wb, seeks } = workbench(undefined, { range: [0, 10], playing: true });
  startPlayer(wb, new AbortController().signal);
  for (const now of [5000, 5016, 5050]) frame(now);
  expect(wb.transport.get().timeSeconds).toBeCloseTo(0.05);
  expect(seeks).toEqual([0, 0.016, expect.closeTo(0.05)]);
});

it('draws every frame: a tick’s request is drawn before the next tick', () => {
  const { wb, seeks } = workbench(undefined, { range: [0, 10], playing: true });
  // Like the viewport: several requests draw once, in the next frame.
  let asked = false;
  const drawn: number[] = [];
  wb.transport.subscribe(() => {
    if (asked) return;
    asked = true;
    requestAnimationFrame(() => {
      asked = false;
      drawn.push(seeks.length);
    });
  });
  startPlayer(wb, new AbortController().signal);
  for (let i = 0; i <= 10; i++) frame(16 * i);
  expect(drawn.length).toBeGreaterThanOrEqual(9);
});

it('requests frames only while playing', () => {
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

it('does not jump after a pause, or after an hour in the background', () => {
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

describe('values set by hand and not keyed', () => {
  const legs = skeleton(['hips', -1]);
  const driven = clip([0, 1], channel(0), channel(0), channel(0), channel(0), channel(0));
  const unkeyed = { timeSeconds: 0, dofs: [3], values: [1] };
  const setAt = (timeSeconds = 0) => {
    const { wb } = workbench(documentOf(character({ skeleton: legs, clips: [driven] })), {
      range: [0, 1],
      timeSeconds,
    });
    startPlayer(wb, new AbortController().signal);
    wb.store.apply(setDofs, { characterId: 'c1', dofs: [{ index: 3, value: 1 }], timeSeconds });
    const now = () => wb.store.document.characters[0].unkeyed;
    const seek = (to: number) => wb.transport.update((p) => ({ ...p, timeSeconds: to }));
    return { wb, now, seek };
  };

  it('unkeyed changes are discarded when the time changes, with a message', () => {
    const { wb, now, seek } = setAt();
    expect(now()).toEqual(unkeyed);
    seek(0.5);
    expect(now()).toBeUndefined();
    expect(wb.messages.passing.get()).toBe('Unkeyed change discarded. Ctrl+Z restores it, K keys such changes.');
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
