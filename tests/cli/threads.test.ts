import { setImmediate as nextTurn } from 'node:timers/promises';
import { expect, it } from 'vitest';
import { shareWork } from '../../src/cli/threads.ts';

it('work that is done without threads gives way between its pieces, so that memory is let go of and signals are heard', async () => {
  const order: string[] = [];
  const work = shareWork(
    {
      name: 'test',
      work: () => (piece: string) => {
        order.push(piece);
        // What waits for a turn of the loop, as the end of a file's memory does.
        void nextTurn().then(() => order.push(`after ${piece}`));
      },
      shared: undefined,
      pieces: ['a', 'b', 'c'],
      few: 0,
      done: () => undefined,
      lost: () => undefined,
    },
    undefined,
  );
  await work;
  expect(order).toEqual(['a', 'after a', 'b', 'after b', 'c', 'after c']);
});
