/** Real and random characters of all kinds, as GLB files show them at times that no fitting has looked at. */
import { describe, it } from 'vitest';
import { describeShared } from '../../helpers/shared.ts';
import { expectWithin } from './at-unseen-times.ts';
import { movedCharacters, type Named, randomCharacters, realCharacters } from './many-characters.ts';

const STYLES = ['linear', 'cubic'] as const;

function each(all: readonly Named[]): void {
  it.each(all.map((one) => [one.name, one] as const))(
    '%s',
    (_, one) => {
      for (const keys of STYLES) {
        expectWithin(one, { keys });
        if (one.character.skins.length) expectWithin(one, { keys, influences: 4 }, 100);
      }
    },
    120_000,
  );
}

describeShared('real files as GLB at unseen times', () => each(realCharacters()));

describeShared('real skeletons with random takes as GLB at unseen times', () =>
  each(movedCharacters((name) => /calm|wild/.test(name))),
);

describe('random skeletons as GLB at unseen times', () => each(randomCharacters(12)));
