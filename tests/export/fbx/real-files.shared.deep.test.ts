import { expect, it } from 'vitest';
import { describeShared } from '../../helpers/shared.ts';
import { movedCharacters, realCharacters } from '../glb/many-characters.ts';
import { expectSeen } from './each-within.ts';

describeShared('real characters as FBX', () => {
  it('real files with their own takes are read as they are here; captures in three.js, too', () => {
    const all = realCharacters();
    expect(all.length).toBeGreaterThan(10);
    for (const one of all) expectSeen(one);
  });

  it('real skeletons with takes by chance are read as they are here', () => {
    const isOff = (name: string) => /^(six|nine)/.test(name);
    // Their weights don't sum to 1, which changes vertices, and is said. Angles are as large as they get in wide takes,
    // and wild ones have all kinds of keys.
    for (const one of movedCharacters((name) => !isOff(name) && / wi(de|ld)$/.test(name))) expectSeen(one);
  });
});
