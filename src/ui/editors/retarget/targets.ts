/** Possible targets of retargeting. */
import { isPossibleSource } from '../../../edit/drivers.ts';
import type { Character, Document } from '../../../model/document.ts';
import { currentCharacter } from '../../state/actions/action.ts';
import type { Uses } from '../../state/workbench.ts';

/** Characters with a skeleton, for which another one shows a take. */
export function possibleTargets({ characters }: Document): readonly Character[] {
  // Not the sources of each: of thousands that would be millions.
  const [first, second] = characters.filter(isPossibleSource);
  return first ? characters.filter((c) => c.skeleton && (second !== undefined || c !== first)) : [];
}

/**
 * The default target: the current character if it is retargeted already or has a skin, else the first one with a skin.
 */
export function firstTarget(wb: Uses<'store'>): Character | undefined {
  const { document } = wb.store;
  const targets = possibleTargets(document);
  const current = currentCharacter(wb);
  if (current?.driver && targets.includes(current)) return current;
  const skinned = targets.filter((c) => c.skins.length > 0);
  if (current && targets.includes(current) && (current.skins.length > 0 || skinned.length === 0)) return current;
  return skinned[0] ?? targets[0];
}
