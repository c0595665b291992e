/** Characters of FBX files. */

import { readWhole } from '../../../src/formats/reader.ts';
import { fbxReader } from '../../../src/import/fbx/read.ts';
import { toCharacter } from '../../../src/import/to-character.ts';
import type { WholeCharacter } from '../../../src/model/files.ts';

export function characterOf(bytes: Uint8Array): WholeCharacter {
  const { value } = readWhole(fbxReader('file.fbx'), bytes);
  const character = value && toCharacter(value);
  if (!character) throw new Error('not read');
  return character;
}
