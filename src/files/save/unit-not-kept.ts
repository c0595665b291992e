/** Losses of saving as text of characters whose file states a unit. */
import { unitText, upText } from '../../evaluate/space/space.ts';
import type { Character } from '../../model/document.ts';

/**
 * A sentence for all files of a character: text states no unit, so that what is read again may have another size.
 * Undefined if the character's file stated none either.
 */
export function unitNotKept({ space }: Pick<Character, 'space'>): string | undefined {
  if (space?.known !== 'stated') return undefined;
  const axis = space.up === 'y' ? '' : ` It has ${upText(space)}, as its file has.`;
  return `The unit, ${unitText(space)}, is not kept: text files don’t state one, and numbers are written as they are.${axis} A .glb or .fbx keeps the size; in the page, set the unit of an opened character in the inspector.`;
}
