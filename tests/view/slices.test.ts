import { describe, expect, it } from 'vitest';
import { runToEnd, type Steps } from '../../src/evaluate/steps.ts';
import { runInSlices } from '../../src/view/slices.ts';

function* count(to: number, seen: number[] = []): Steps<number> {
  for (let i = 0; i < to; i++) {
    seen.push(i);
    yield i / to;
  }
  return to;
}

describe('work in slices', () => {
  it('work in slices comes to the same as at once', async () => {
    expect(runToEnd(count(1000))).toBe(1000);
    expect(await runInSlices(count(1000), new AbortController().signal)).toBe(1000);
  });

  it('stops when it is no longer wanted', async () => {
    const seen: number[] = [];
    const life = new AbortController();
    function* work(): Steps<number> {
      yield* count(3, seen);
      life.abort();
      yield* count(3, seen);
      return 1;
    }
    expect(await runInSlices(work(), life.signal)).toBeUndefined();
    expect(seen).toEqual([0, 1, 2, 0]);
  });
});
