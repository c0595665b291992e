/** Files of points as they are opened, and made ones. */

import { compileSkeleton } from '../../src/evaluate/kinematics.ts';
import { isVisible } from '../../src/evaluate/visible-points.ts';
import { charactersIn } from '../../src/files/open/contents.ts';
import { formatOf } from '../../src/files/readers.ts';
import type { Diagnostic } from '../../src/model/diagnostic.ts';
import type { FileContent, WholeCharacter } from '../../src/model/files.ts';
import { eachWorld } from './lab.ts';

/** A file as it is opened. */
export interface ReadPointsFile {
  readonly value?: FileContent;
  readonly isOther?: boolean;
  readonly diagnostics: readonly Diagnostic[];
}

/** Reads a file as it is opened. */
export async function readPointsIn(name: string, content: Uint8Array | string): Promise<ReadPointsFile> {
  const bytes = typeof content === 'string' ? new TextEncoder().encode(content) : new Uint8Array(content);
  const read = await formatOf(name)?.imports?.({ fileName: name, bytes, beside: async () => undefined });
  if (!read) throw new Error(`${name} is not imported.`);
  return read;
}

/** The only character of a file without errors. */
export async function pointsIn(name: string, content: Uint8Array | string) {
  const { value, diagnostics } = await readPointsIn(name, content);
  const source = { name, path: name, bytes: 0 };
  const [character]: readonly WholeCharacter[] = value ? charactersIn({ ...value, source }) : [];
  if (!character) throw new Error(diagnostics.map(({ message }) => message).join(' '));
  return { character, take: character.takes[0], diagnostics };
}

/** Where the points are in each frame; null where one is missing. */
export function placesIn({ skeleton, takes: [take] }: Pick<WholeCharacter, 'skeleton' | 'takes'>) {
  const compiled = compileSkeleton(skeleton);
  const frames: (readonly number[] | null)[][] = [];
  eachWorld(skeleton, take, (world, dofs, frame) => {
    frames[frame] = skeleton.joints.map((_, p) =>
      isVisible(compiled, p, dofs) ? Array.from(world.subarray(16 * p + 12, 16 * p + 15)) : null,
    );
  });
  return frames;
}

/** The sentence of the only error of a file. */
export async function errorIn(name: string, content: Uint8Array | string): Promise<string> {
  const { value, diagnostics } = await readPointsIn(name, content);
  if (value) throw new Error(`${name} has no error.`);
  return diagnostics
    .filter(({ severity }) => severity === 'error')
    .map(({ message }) => message)
    .join(' ');
}
