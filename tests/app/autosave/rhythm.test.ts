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
  vi.advanceTimersByTime(500);
  rhythm.changed();
  vi.advanceTimersByTime(500);
  expect(due).not.toHaveBeenCalled();
  vi.advanceTimersByTime(500);
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
  expect(due.mock.calls.length).toBeGreaterThanOrEqual(10);
  expect(due.mock.calls.length).toBeLessThanOrEqual(15);
});

it('waits for the end of a drag', () => {
  const { due, rhythm } = counted();
  rhythm.setPointerDown(true);
  rhythm.changed();
  vi.advanceTimersByTime(10_000);
  expect(due).not.toHaveBeenCalled();
  rhythm.setPointerDown(false);
  vi.advanceTimersByTime(1);
  expect(due).toHaveBeenCalledTimes(1);
});

it('does not wait for a drag that never ends', () => {
  const { due, rhythm } = counted();
  rhythm.setPointerDown(true);
  rhythm.changed();
  vi.advanceTimersByTime(31_000);
  expect(due).toHaveBeenCalledTimes(1);
});
