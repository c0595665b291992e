import { expect, it } from 'vitest';
import { transferables } from '../../src/worker/transferables.ts';

it('finds every buffer of a message once, however deep', () => {
  const shared = new Float64Array(4);
  const message = {
    a: [{ values: shared }, { values: shared.subarray(1) }],
    b: { c: Uint32Array.of(1) },
    numbers: [1, 2, 3],
    nothing: undefined,
    none: null,
    text: 'x',
  };
  expect(new Set(transferables(message))).toEqual(new Set([shared.buffer, message.b.c.buffer]));
  expect(transferables(message)).toHaveLength(2);
});

it('passes empty arrays over: they may share one empty buffer', () => {
  expect(transferables({ none: new Float64Array(0) })).toEqual([]);
});
