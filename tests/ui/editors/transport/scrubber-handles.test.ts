import { expect, it } from 'vitest';
import { rangeHandleAt } from '../../../../src/ui/editors/transport/scrubber-handles.ts';
import { HANDLE_WIDTH, RULER_HEIGHT } from '../../../../src/ui/editors/transport/scrubber-picture.ts';

const range = [100, 300] as const;
const BELOW = RULER_HEIGHT + 10;

it('a press in the ruler seeks wherever it is, and so does one on the first and last pixel of the range', () => {
  for (let x = 80; x <= 320; x++) expect(rangeHandleAt(x, RULER_HEIGHT - 1, range), `${x}`).toBeUndefined();
  for (const x of [100, 101, 200, 299, 300]) expect(rangeHandleAt(x, BELOW, range), `${x}`).toBeUndefined();
});

it('the handles of the range are outside of it, below the ruler, also of one without length', () => {
  for (const [x, end] of [
    [99, 'in'],
    [100 - HANDLE_WIDTH, 'in'],
    [301, 'out'],
    [300 + HANDLE_WIDTH, 'out'],
  ] as const) {
    expect(rangeHandleAt(x, BELOW, range)).toBe(end);
  }
  expect([99 - HANDLE_WIDTH, 301 + HANDLE_WIDTH].map((x) => rangeHandleAt(x, BELOW, range))).toEqual([
    undefined,
    undefined,
  ]);
  expect([98, 100, 102].map((x) => rangeHandleAt(x, BELOW, [100, 100]))).toEqual(['in', undefined, 'out']);
});
