/** Retargeted characters are marked as such, and their own keys aren't shown. */
import { expect, it } from 'vitest';
import { clearRetarget, setRetarget } from '../../../../src/edit/commands/retarget.ts';
import { Store } from '../../../../src/edit/store.ts';
import { shownKeys } from '../../../../src/evaluate/plot/shown-keys.ts';
import { findCharacter } from '../../../../src/model/document.ts';
import { jointDofCount } from '../../../../src/model/skeleton/dofs.ts';
import { outlineRows, sameOutline } from '../../../../src/ui/editors/outliner/outline-rows.ts';
import { takeRows } from '../../../../src/ui/editors/takes/rows.ts';
import { listedChannels } from '../../../../src/ui/editors/timeline/channels.ts';
import { keyedChannels } from '../../../../src/ui/editors/timeline/dope-rows.ts';
import { PARTS, person, takeOfRows } from '../../../evaluate/retarget/people.ts';
import { character, documentOf, morph, takeOfValues } from '../../../helpers/builders.ts';

const SOURCE = person();
const REST = new Array<number>(jointDofCount(SOURCE)).fill(0);
const OWN = person({ size: 0.6, motion: () => ({ kind: 'ball', order: 'xyz' }) });
const JOINT_DOFS = 3 + 3 * PARTS.length;
const LIST = { list: 'all', pinned: [], filter: '' } as const;

function moved(): Store {
  const source = character({ id: 's', name: 'dancer', skeleton: SOURCE, takes: [takeOfRows(SOURCE, [REST, REST])] });
  const target = character({
    id: 't',
    name: 'walker',
    skeleton: OWN,
    morphs: [morph('smile')],
    takes: [takeOfValues('own', new Array<number>(JOINT_DOFS + 1).fill(0.1))],
    shownTake: 0,
  });
  const store = new Store(documentOf({ ...source, shownTake: 0 }, target));
  store.apply(setRetarget, { characterId: 't', sourceId: 's' });
  return store;
}

it('a retargeted character is marked in the outliner and in the takes, where the retargeted take has a row of its own', () => {
  const store = moved();
  const rowOf = (id: string) => outlineRows(store.document, () => true).find((row) => row.key === id);
  const before = store.document;
  expect(rowOf('t')?.detail).toBe('follows take');
  expect(takeRows(before).map(({ name, note, isShown }) => ({ name, note, isShown }))).toEqual([
    { name: 'take', note: 'drives walker', isShown: true },
    { name: 'own', note: '', isShown: false },
    { name: 'take', note: 'retargeted to walker', isShown: true },
  ]);
  store.apply(clearRetarget, { characterId: 't' });
  expect(sameOutline(before, store.document)).toBe(false);
  expect(rowOf('t')?.detail).toBe('');
  expect(takeRows(store.document).map((row) => row.note)).toEqual(['', '']);
});

it('the timeline lists only morphs of a retargeted character', () => {
  const store = moved();
  const lists = () => {
    const walker = findCharacter(store.document, 't');
    if (!walker) throw new Error('no walker');
    return {
      curves: listedChannels(walker, { characterId: 't' }, LIST).map((c) => c.channel),
      dope: keyedChannels(walker, ''),
      scrubber: shownKeys(store.document, { characterId: 't' }).length,
    };
  };
  expect(lists()).toEqual({ curves: [JOINT_DOFS], dope: [JOINT_DOFS], scrubber: 1 });
  store.apply(clearRetarget, { characterId: 't' });
  expect(lists().scrubber).toBe(JOINT_DOFS + 1);
  expect(lists().curves).toHaveLength(JOINT_DOFS + 1);
});
