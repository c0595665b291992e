import { expect, it } from 'vitest';
import { makeTakesWhenIdle } from '../../src/app/idle-takes.ts';
import { renameTake } from '../../src/edit/commands/take.ts';
import { Store } from '../../src/edit/store.ts';
import { character, documentOf, takeOfValues, trackedTake } from '../helpers/builders.ts';

function waiting() {
  const store = new Store();
  const runs: (() => void)[] = [];
  makeTakesWhenIdle(store, (run) => runs.push(run));
  const idle = () => {
    for (const run of runs.splice(0)) run();
  };
  return { store, runs, idle };
}

it('channels are made one take at a time, each when the page is idle', () => {
  const made: string[] = [];
  const { store, runs, idle } = waiting();
  const take = (name: string) => trackedTake(name, () => made.push(name));
  store.replace(
    'Open',
    documentOf(character({ takes: [take('walk'), take('run'), takeOfValues('nod', [0])], shownTake: 2 })),
  );
  expect(made).toEqual([]);
  // Another change doesn't ask twice.
  store.apply(renameTake, { characterId: 'c1', take: 2, name: 'shake' });
  expect(runs).toHaveLength(1);
  idle();
  expect(made).toEqual(['walk']);
  idle();
  idle();
  expect(made).toEqual(['walk', 'run']);
  expect(runs).toHaveLength(0);
});

it('nothing waits for the page to be idle where all takes have channels', () => {
  const { store, runs } = waiting();
  store.replace('Open', documentOf(character({ takes: [takeOfValues('walk', [0])], shownTake: 0 })));
  expect(runs).toHaveLength(0);
});
