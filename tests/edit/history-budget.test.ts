import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import type { Command } from '../../src/edit/command.ts';
import { stepsToForget } from '../../src/edit/history-budget.ts';
import { Store } from '../../src/edit/store.ts';
import type { Document } from '../../src/model/document.ts';
import type { Samples } from '../../src/model/takes/samples.ts';
import { character, documentOf, takeOfValues, trackedTake } from '../helpers/builders.ts';

const MEGABYTE = 1e6;

const set: Command<Document> = { id: 'test.set', label: () => 'Set', run: (_, document) => document };
const EMPTY = documentOf();

function take(megabytes: number, values = new Float64Array((megabytes * MEGABYTE) / 8)): Document {
  const samples: Samples = {
    frameCount: values.length,
    frameSeconds: 1 / 60,
    startSeconds: 0,
    scales: Float64Array.of(1),
    values,
    firstChannel: 0,
    interpolation: 'nearest',
  };
  return documentOf(character({ takes: [{ ...takeOfValues('take', [0]), samples }], shownTake: 0 }));
}

function limited(store: Store, megabytes: number): number {
  const count = stepsToForget(store.stored, store.document, megabytes * MEGABYTE);
  store.forgetOldest(count);
  return count;
}

function undone(store: Store): number {
  let count = 0;
  while (store.undo()) count++;
  return count;
}

describe('memory of undo', () => {
  it('weighs what the channels of a take will be made of, without making them', () => {
    let made = 0;
    const store = new Store(EMPTY);
    store.apply(set, documentOf(character({ takes: [trackedTake('walk', () => made++)] })));
    store.undo();
    expect(limited(store, 1e-6)).toBe(0);
    expect(made).toBe(0);
  });

  it('takes that are opened and removed one after another leave no more than the budget behind', () => {
    const store = new Store(EMPTY);
    for (let i = 0; i < 6; i++) {
      store.apply(set, take(1));
      store.apply(set, EMPTY);
      limited(store, 2.5);
    }
    // Two takes, each with its removal and its opening.
    expect(undone(store)).toBe(4);
    for (let i = 0; i < 3; i++) store.redo();
    expect(store.document.characters[0].takes[0].samples?.values.length).toBe(125_000);
  });

  it('the newest step is kept whatever it keeps, and forgetting again forgets nothing', () => {
    const store = new Store(take(3));
    store.apply(set, EMPTY);
    expect(limited(store, 1)).toBe(0);
    expect(store.undo()).toBe(true);
    expect(store.redo()).toBe(true);
    expect(limited(store, 1)).toBe(0);
  });

  it('what the document or a newer step has too costs nothing', () => {
    const values = new Float64Array((4 * MEGABYTE) / 8);
    const store = new Store(take(4, values));
    for (let i = 1; i < 20; i++) store.apply(set, take(4, values.subarray(i)));
    expect(limited(store, 1)).toBe(0);
    store.apply(set, EMPTY);
    expect(limited(store, 5)).toBe(0);
    expect(undone(store)).toBe(20);
  });

  it('steps that redo would repeat are never forgotten', () => {
    const store = new Store(EMPTY);
    for (let i = 0; i < 3; i++) store.apply(set, take(1));
    for (let i = 0; i < 3; i++) store.undo();
    limited(store, 0.1);
    expect(store.redo() && store.redo() && store.redo()).toBe(true);
  });

  it('the steps that are left lead back through the same states', () => {
    fc.assert(
      fc.property(
        fc.array(fc.nat(4), { minLength: 1, maxLength: 12 }),
        fc.double({ min: 0, max: 3 }),
        (sizes, most) => {
          const store = new Store(EMPTY);
          const states = [store.document];
          for (const size of sizes) {
            store.apply(set, size === 0 ? EMPTY : take(size / 4));
            if (store.document !== states.at(-1)) states.push(store.document);
          }
          const forgotten = limited(store, most);
          expect(limited(store, most)).toBe(0);
          for (const state of states.slice(forgotten, -1).reverse()) {
            expect(store.undo()).toBe(true);
            expect(store.document).toEqual(state);
          }
          expect(store.undo()).toBe(false);
        },
      ),
      { numRuns: 20 },
    );
  });
});
