import { expect, it } from 'vitest';
import { driverSource, possibleSources } from '../../../../src/edit/follow/sources.ts';
import type { Character } from '../../../../src/model/document.ts';
import { possibleTargets } from '../../../../src/ui/editors/retarget/targets.ts';
import { character, documentOf, takeOfValues } from '../../../helpers/builders.ts';

const still = (id: string) => character({ id });
const moving = (id: string) => character({ id, takes: [takeOfValues('take', [0])], shownTake: 0 });
const bare = (id: string): Character => {
  const { skeleton: _none, ...rest } = still(id);
  return rest;
};
function driven(id: string): Character {
  const by = moving('by');
  const source = driverSource(by);
  if (!source) throw new Error('It shows a take.');
  // Who drives it is all that counts here.
  return { ...moving(id), driver: { sourceId: 'by', source } as unknown as NonNullable<Character['driver']> };
}

it.each([
  ['nothing', []],
  ['one that shows a take', [moving('a')]],
  ['one that shows a take, and others', [moving('a'), still('b'), bare('c')]],
  ['several that show takes', [still('a'), moving('b'), moving('c'), bare('d')]],
  ['a driven one and its source', [driven('a'), moving('by')]],
  ['a driven one alone', [driven('a'), still('b')]],
  ['none that shows a take', [still('a'), still('b')]],
])('targets of retargeting are those with a skeleton that have a source: of %s', (_of, characters) => {
  const document = documentOf(...characters);
  const expected = characters.filter((c) => c.skeleton && possibleSources(document, c).length > 0);
  expect(possibleTargets(document)).toEqual(expected);
});

it('targets among thousands are found without a look at all sources for each', () => {
  let looks = 0;
  const characters = Array.from({ length: 2000 }, (_, i) => {
    const { takes, ...rest } = moving(`c${i}`);
    const get = () => {
      looks++;
      return takes;
    };
    return Object.defineProperty({ ...rest, takes }, 'takes', { get });
  });
  expect(possibleTargets(documentOf(...characters))).toHaveLength(2000);
  expect(looks).toBeLessThan(10 * 2000);
});
