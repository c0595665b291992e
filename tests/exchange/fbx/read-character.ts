/** Characters of FBX files. */
import { fbxReader } from '../../../src/exchange/fbx/read.ts';
import { toCharacter } from '../../../src/exchange/to-character.ts';
import { readWhole } from '../../../src/formats/reader.ts';
import type { WholeCharacter } from '../../../src/model/files.ts';

export function characterOf(bytes: Uint8Array): WholeCharacter {
  const { value } = readWhole(fbxReader('file.fbx'), bytes);
  const character = value && toCharacter(value);
  if (!character) throw new Error('not read');
  return character;
}
