import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { LARGE_BYTES } from '../../../src/app/autosave/encode.ts';
import type { StorableNumbers } from '../../../src/app/autosave/encoded.ts';
import { Origins } from '../../../src/app/autosave/origins.ts';
import { PIECE_BYTES, type PiecePlan, StoredPieces } from '../../../src/app/autosave/pieces.ts';
import { encodeAll } from './encode-all.ts';

const LARGE = LARGE_BYTES / 8;

/** A store of pieces only. */
class Shelf {
  readonly pieces = new StoredPieces();
  readonly stored = new Map<number, Uint8Array>();

  plan(arrays: readonly StorableNumbers[]): PiecePlan {
    return this.pieces.plan(encodeAll(arrays, new Origins()).needs.arrays);
  }

  put(plan: PiecePlan): void {
    for (const { id, bytes } of plan.puts) this.stored.set(id, bytes());
    for (const id of plan.gone) this.stored.delete(id);
    plan.done();
  }

  save(arrays: readonly StorableNumbers[]): PiecePlan {
    const plan = this.plan(arrays);
    this.put(plan);
    return plan;
  }

  get bytes(): number {
    return [...this.stored.values()].reduce((sum, piece) => sum + piece.byteLength, 0);
  }
}

const numbers = (length: number, first = 0) => Float64Array.from({ length }, (_, i) => first + i);
const sizes = (plan: PiecePlan) => plan.puts.map((put) => put.size);

describe('pieces', () => {
  it('writes an array once, and nothing if nothing has changed', () => {
    const shelf = new Shelf();
    const arrays = [numbers(2 * LARGE), numbers(LARGE)];
    expect(shelf.save(arrays).puts).toHaveLength(2);
    expect(shelf.save(arrays).puts).toEqual([]);
  });

  it('splits a large array into pieces, and leaves small ones in the tree', () => {
    const shelf = new Shelf();
    const plan = shelf.save([numbers(PIECE_BYTES / 8 + 1), numbers(LARGE - 1)]);
    expect(sizes(plan)).toEqual([PIECE_BYTES, 8]);
  });

  it('writes only what is new, and deletes what is no longer needed', () => {
    const shelf = new Shelf();
    const [a, b] = [numbers(LARGE), numbers(LARGE, 5)];
    shelf.save([a, b]);
    const before = [...shelf.stored.keys()];
    const plan = shelf.save([a, numbers(LARGE, 9)]);
    expect(plan.puts).toHaveLength(1);
    expect(plan.gone).toEqual([before[1]]);
  });

  it('writes again what a failed save did not write', () => {
    const shelf = new Shelf();
    const a = numbers(LARGE);
    shelf.plan([a]).failed();
    expect(shelf.save([a]).puts).toHaveLength(1);
  });

  it('relies on nothing that an earlier save has not finished, nor on anything it deletes', () => {
    const shelf = new Shelf();
    const [a, b] = [numbers(LARGE), numbers(LARGE, 5)];
    shelf.save([a]);
    const under = shelf.plan([b]);
    // `a` is doomed by the running save, and `b` isn't stored for certain.
    const hasty = shelf.plan([a, b]);
    expect(hasty.puts).toHaveLength(2);
    shelf.put(under);
    shelf.put(hasty);
    expect(shelf.save([a, b]).puts).toEqual([]);
    expect(shelf.bytes).toBe(2 * LARGE_BYTES);
  });

  it('the same if the earlier save fails', () => {
    const shelf = new Shelf();
    const [a, b] = [numbers(LARGE), numbers(LARGE, 5)];
    shelf.save([a]);
    const under = shelf.plan([b]);
    const hasty = shelf.plan([a, b]);
    under.failed();
    shelf.put(hasty);
    shelf.save([a, b]);
    expect(shelf.bytes).toBe(2 * LARGE_BYTES);
  });

  it('stores what is needed and no more, however often anything changes', () => {
    const change = fc.record({ index: fc.nat(9), length: fc.integer({ min: LARGE, max: 40_000 }) });
    fc.assert(
      fc.property(fc.array(fc.array(change, { maxLength: 4 }), { minLength: 1, maxLength: 20 }), (saves) => {
        const shelf = new Shelf();
        const arrays = Array.from({ length: 10 }, (_, i) => numbers(LARGE, i));
        for (const changes of saves) {
          for (const { index, length } of changes) arrays[index] = numbers(length, index);
          shelf.save(arrays);
          expect(shelf.bytes).toBe(arrays.reduce((sum, array) => sum + array.byteLength, 0));
        }
      }),
      { numRuns: 30 },
    );
  });
});
