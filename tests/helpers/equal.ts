import { isDeepStrictEqual } from 'node:util';
import { expect } from 'vitest';

/** As `expect(found, what).toEqual(meant)`, which takes many times as long for large values that are the same. */
export function expectEqual(found: unknown, meant: unknown, what?: string): void {
  if (!isDeepStrictEqual(found, meant)) expect(found, what).toEqual(meant);
}
