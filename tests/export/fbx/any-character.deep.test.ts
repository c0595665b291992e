import fc from 'fast-check';
import { describe, it } from 'vitest';
import { anyone } from '../any-character.ts';
import { randomCharacters } from '../glb/many-characters.ts';
import { expectSeen } from './each-within.ts';

describe('any character as FBX', () => {
  it('any joints with any curves, limits and extrapolation are read as they are here, with skins and morphs', () => {
    fc.assert(
      fc.property(anyone, (character) => expectSeen({ name: 'any', character })),
      { numRuns: 30 },
    );
  });

  it('skeletons of joints of all types are read as they are here, with vertices of up to seven attachments', () => {
    for (const { name, character } of randomCharacters(30)) {
      const joints = (character.skeleton?.joints ?? []).map((joint, j) => ({ ...joint, name: `j${j}` }));
      expectSeen({ name, character: { ...character, skeleton: { name: 'x', joints } } });
    }
  });
});
