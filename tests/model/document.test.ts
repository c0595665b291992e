import { describe, expect, it } from 'vitest';
import { findCharacter } from '../../src/model/document.ts';
import { character, documentOf } from '../helpers/builders.ts';

const documentOfIds = (ids: readonly string[]) => documentOf(...ids.map((id) => character({ id })));
const ids = (count: number) => Array.from({ length: count }, (_, i) => `c${i}`);

describe('a character found by its id', () => {
  it.each([1, 32, 33, 500])('of %d characters is each, and none by another id', (count) => {
    const document = documentOfIds(ids(count));
    for (const own of document.characters) expect(findCharacter(document, own.id)).toBe(own);
    expect(findCharacter(document, `c${count}`)).toBeUndefined();
    expect(findCharacter(document, undefined)).toBeUndefined();
  });

  it('of many is found in the document after a change, and before it', () => {
    const before = documentOfIds(ids(500));
    const changed = { ...before.characters[7], name: 'other' };
    const after = { ...before, characters: before.characters.with(7, changed).slice(0, 400) };
    expect(findCharacter(after, 'c7')).toBe(changed);
    expect(findCharacter(before, 'c7')).toBe(before.characters[7]);
    expect(findCharacter(after, 'c450')).toBeUndefined();
  });

  it('of thousands is found without a look at all of them for each', () => {
    const document = documentOfIds(ids(2000));
    let looks = 0;
    for (const own of document.characters) {
      const { id } = own;
      const get = () => {
        looks++;
        return id;
      };
      Object.defineProperty(own, 'id', { get });
    }
    for (const id of ids(2000)) findCharacter(document, id);
    expect(looks).toBeLessThan(10 * 2000);
  });
});
