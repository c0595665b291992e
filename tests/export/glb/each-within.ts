/** A test for each of many characters: that its GLB file shows it as it is at times that no fitting has looked at. */
import { it } from 'vitest';
import type { Glb } from '../../helpers/glb.ts';
import { expectWithin } from './at-unseen-times.ts';
import type { Named } from './many-characters.ts';

const STYLES = ['linear', 'cubic'] as const;

/** Whether vertices have more attachments than four: files of the others are the same when only four are asked for. */
function readsMoreThanFour({ json: { meshes = [] } }: Glb): boolean {
  return meshes.some(({ primitives }) => primitives.some(({ attributes }) => 'JOINTS_1' in attributes));
}

export function eachWithin(all: readonly Named[]): void {
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
