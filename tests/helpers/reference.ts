/** Models read from the reference files; a file with errors fails the test with its diagnostics. */
import { readAnim } from '../../src/formats/anim/read.ts';
import { readMorph } from '../../src/formats/morph/read.ts';
import { readSkel } from '../../src/formats/skel/read.ts';
import { readSkin } from '../../src/formats/skin/read.ts';
import type { Diagnostic } from '../../src/model/diagnostic.ts';
import type { Morph } from '../../src/model/morph.ts';
import type { Skeleton } from '../../src/model/skeleton/skeleton.ts';
import type { Skin } from '../../src/model/skin.ts';
import type { Take } from '../../src/model/takes/take.ts';
import { sharedBytes } from './shared.ts';

type Read<T> = (bytes: Uint8Array, name: string) => { readonly value?: T; readonly diagnostics: readonly Diagnostic[] };

function read<T>(path: string, reader: Read<T>): T {
  const { value, diagnostics } = reader(sharedBytes(path), path.slice(path.lastIndexOf('/') + 1));
  if (value === undefined) throw new Error(`${path} did not load: ${diagnostics.map((d) => d.message).join(' ')}`);
  return value;
}

/** Paths are relative to `shared/`: `data/cse169/wasp.skel`. */
export const referenceSkeleton = (path: string): Skeleton => read(path, readSkel)[0];
export const referenceSkin = (path: string): Skin => read(path, readSkin);
export const referenceMorph = (path: string): Morph => read(path, readMorph);
export const referenceTake = (path: string): Take => read(path, readAnim);
