/** Characters of FBX files. */

import { readFbx } from '../../../src/import/fbx/read.ts';
import { toCharacter } from '../../../src/import/to-character.ts';
import type { WholeCharacter } from '../../../src/model/files.ts';

export function characterOf(bytes: Uint8Array): WholeCharacter {
  const { value } = readFbx('file.fbx', new Uint8Array(bytes));
  const character = value && toCharacter(value);
  if (!character) throw new Error('not read');
  return character;
}
