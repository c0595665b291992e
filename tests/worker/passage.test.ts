import { expect, it } from 'vitest';
import { passageOf } from '../../src/worker/passage.ts';

const LARGE = 1 << 16;

it('transfers every large buffer of a message once, however deep, and clones small ones', () => {
  const shared = new Float64Array(LARGE / 8);
  const message = {
    a: [{ values: shared }, { values: shared.subarray(1) }],
    b: { c: new Uint8Array(LARGE), small: new Uint8Array(LARGE - 1) },
    numbers: [1, 2, 3],
    nothing: undefined,
    none: null,
    text: 'x',
  };
  expect(new Set(passageOf(message).transfer)).toEqual(new Set([shared.buffer, message.b.c.buffer]));
  expect(passageOf(message).transfer).toHaveLength(2);
});

it('clones empty arrays: they may share one empty buffer', () => {
  expect(passageOf({ none: new Float64Array(0) }).transfer).toEqual([]);
});

it('weighs a message by its objects and by the bytes that are cloned', () => {
  const objects = Array.from({ length: 1000 }, () => ({}));
  expect(passageOf(objects).weight).toBe(1001);
  expect(passageOf({ large: new Uint8Array(LARGE) }).weight).toBe(2);
  expect(passageOf({ small: new Uint8Array(LARGE / 2) }).weight).toBe(2 + 32);
});
