import { afterEach, beforeEach, expect, it, vi } from 'vitest';
import { Rhythm } from '../../../src/app/autosave/rhythm.ts';

beforeEach(() => void vi.useFakeTimers());
afterEach(() => void vi.useRealTimers());

function counted() {
  const due = vi.fn();
  return { due, rhythm: new Rhythm(due) };
}

it('saves once, shortly after the last change', () => {
  const { due, rhythm } = counted();
  rhythm.changed();
  vi.advanceTimersByTime(300);
  rhythm.changed();
  vi.advanceTimersByTime(300);
  expect(due).not.toHaveBeenCalled();
  vi.advanceTimersByTime(300);
  expect(due).toHaveBeenCalledTimes(1);
  vi.advanceTimersByTime(60_000);
  expect(due).toHaveBeenCalledTimes(1);
});

it('saves during continuous changes, so that never more than two seconds are lost, and not at each', () => {
  const { due, rhythm } = counted();
  for (let i = 0; i < 200; i++) {
    rhythm.changed();
    vi.advanceTimersByTime(100);
  }
  // In 20 seconds.
  expect(due.mock.calls.length).toBeGreaterThanOrEqual(16);
  expect(due.mock.calls.length).toBeLessThanOrEqual(20);
});

/** When saves are due in a drag of a minute that changes something every 50 ms, in ms since its beginning. */
function duringDrag(busyMs: number): readonly number[] {
  const saves: number[] = [];
  const begun = performance.now();
  const rhythm = new Rhythm(() => {
    saves.push(performance.now() - begun);
    rhythm.saveTook(busyMs);
  });
  rhythm.saveTook(busyMs);
  rhythm.setPointerDown(true);
  for (let i = 0; i < 1200; i++) {
    rhythm.changed();
    vi.advanceTimersByTime(50);
  }
  return saves;
}

/** The most that is lost by a crash just before a save. */
const longestMs = (saves: readonly number[]) => Math.max(...saves.map((at, i) => at - (saves[i - 1] ?? 0)));

it('saves during a long drag too, so that never more than two seconds are lost, if saving is quick', () => {
  const saves = duringDrag(200);
  expect(longestMs(saves)).toBeLessThan(1100);
  expect(saves.length).toBeLessThanOrEqual(60);
});

it('leaves a drag most of its time if saving is slow, and postpones no save by more than three seconds', () => {
  expect(duringDrag(500).length).toBeLessThanOrEqual(24);
  expect(longestMs(duringDrag(5000))).toBeLessThan(3100);
});

it('saves at once at the end of a drag that postponed it', () => {
  const { due, rhythm } = counted();
  rhythm.saveTook(1000);
  rhythm.setPointerDown(true);
  rhythm.changed();
  vi.advanceTimersByTime(2500);
  expect(due).not.toHaveBeenCalled();
  rhythm.setPointerDown(false);
  vi.advanceTimersByTime(1);
  expect(due).toHaveBeenCalledTimes(1);
});
