/** A note about a joint's name while it can still be changed. */

import { type Character, isBvh } from '../../../model/document.ts';
import { oneToken, restOfLine } from '../../../model/names/written-names.ts';
import { savesAsAxisAngle } from '../../../model/skeleton/axis-angle.ts';

/** The name it gets in the file if that can't hold it as it is, and whether it is a duplicate; else empty. */
export function nameNote(character: Pick<Character, 'skeleton'>, joint: number): string {
  const { skeleton } = character;
  const name = skeleton?.joints[joint]?.name;
  if (!skeleton || !name) return '';
  const notes: string[] = [];
  if (savesAsAxisAngle(skeleton)) notes.push('The axis-angle form stores no names.');
  else {
    const written = isBvh(character) ? restOfLine(name) : oneToken(name);
    if (written !== name) notes.push(`Saved as “${written}”.`);
  }
  if (skeleton.joints.some((other, j) => j !== joint && other.name === name)) {
    notes.push('Another joint has the same name. Files tell them apart by index.');
  }
  return notes.join(' ');
}
