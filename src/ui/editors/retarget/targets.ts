/** Who can be moved by whom. */
import { possibleSources } from '../../../edit/drivers.ts';
import type { Character, Document } from '../../../model/document.ts';
import { currentCharacter } from '../../state/action.ts';
import type { Uses } from '../../state/workbench.ts';

/** Characters that could be moved: with a skeleton, and another one that shows a take. */
export function possibleTargets(document: Document): readonly Character[] {
  return document.characters.filter((c) => c.skeleton && possibleSources(document, c).length > 0);
}

/** The character that is meant: the current one, unless it is a take that another one waits for, not moved itself. */
export function firstTarget(wb: Uses<'store'>): Character | undefined {
  const { document } = wb.store;
  const targets = possibleTargets(document);
  const current = currentCharacter(wb);
  if (current?.driver && targets.includes(current)) return current;
  const skinned = targets.filter((c) => c.skins.length > 0);
  if (current && targets.includes(current) && (current.skins.length > 0 || skinned.length === 0)) return current;
  return skinned[0] ?? targets[0];
}
