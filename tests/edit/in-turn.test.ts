import { expect, it } from 'vitest';
import { CommandError } from '../../src/edit/command-error.ts';
import { clearLimit, setLimit } from '../../src/edit/commands/limits.ts';
import { inTurn } from '../../src/edit/in-turn.ts';
import { Store } from '../../src/edit/store.ts';
import { character, documentOf, skeleton } from '../ui/builders.ts';

const bones = skeleton(['hips', -1], ['left', 0], ['right', 0]);
const of = (dof: number, min: number, max: number) => ({ characterId: 'c1', dof, min, max });

it('a command for several joints is one step with a name of its own, keeps the selection, and undoes exactly', () => {
  const store = new Store(documentOf(character({ skeleton: bones })));
  const selection = { characterId: 'c1', joint: 2, others: [1] };
  store.select(selection);
  const before = store.document;
  store.apply(inTurn(setLimit, 'Set limits of 2 joints'), [of(6, -1, 1), of(9, -2, 2)]);
  expect(store.undoLabel).toBe('Set limits of 2 joints');
  expect(store.selection).toBe(selection);
  const limits = store.document.characters[0].skeleton?.joints.map((j) => j.limits[0]);
  expect(limits?.slice(1)).toEqual([
    { min: -1, max: 1 },
    { min: -2, max: 2 },
  ]);
  store.undo();
  expect(store.document).toEqual(before);
  expect(store.undoLabel).toBeUndefined();
});

it('a command for one of several is named after that one', () => {
  const document = documentOf(character({ skeleton: bones }));
  expect(inTurn(setLimit, 'Set limits of 1 joints').label(document, [of(6, -1, 1)])).toBe(
    setLimit.label(document, of(6, -1, 1)),
  );
});

it('if a command for several joints is refused for one, nothing changes; of none it changes nothing', () => {
  const store = new Store(documentOf(character({ skeleton: bones })));
  const before = store.document;
  const command = inTurn(setLimit, 'Set limits');
  expect(() => store.apply(command, [of(6, -1, 1), of(99, 0, 1)])).toThrow(CommandError);
  expect(store.document).toBe(before);
  store.apply(inTurn(clearLimit, 'Remove limits'), []);
  expect(store.document).toBe(before);
});
