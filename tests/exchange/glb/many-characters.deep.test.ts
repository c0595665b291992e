/** Real and random characters of all kinds, as GLB files show them at times that no fitting has looked at. */
import { describe, it } from 'vitest';
import type { Glb } from '../../helpers/glb.ts';
import { describeShared } from '../../helpers/shared.ts';
import { expectWithin } from './at-unseen-times.ts';
import { movedCharacters, type Named, randomCharacters, realCharacters } from './many-characters.ts';

const STYLES = ['linear', 'cubic'] as const;

/** Whether vertices have more attachments than four: files of the others are the same when only four are asked for. */
function readsMoreThanFour({ json: { meshes = [] } }: Glb): boolean {
  return meshes.some(({ primitives }) => primitives.some(({ attributes }) => 'JOINTS_1' in attributes));
}

function each(all: readonly Named[]): void {
  it.each(all.map((one) => [one.name, one] as const))(
    '%s',
    (_, one) => {
      for (const keys of STYLES) {
        const made = expectWithin(one, { keys });
        if (readsMoreThanFour(made)) expectWithin(one, { keys, influences: 4 }, 100);
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
