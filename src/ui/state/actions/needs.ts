/**
 * Requirements of actions, each with the sentence for when it isn't met: a shortcut that silently does nothing looks
 * broken.
 */
import { selectedJoints } from '../joints/selected-joint.ts';
import type { Uses } from '../workbench.ts';
import { currentCharacter } from './action.ts';

/** `Action.refuses`: the reason, unless the test passes. @param reason a sentence */
export function needs<W>(
  reason: string | ((wb: W) => string),
  test: (wb: W) => boolean,
): (wb: W) => string | undefined {
  return (wb) => {
    if (test(wb)) return undefined;
    return typeof reason === 'string' ? reason : reason(wb);
  };
}

export const NO_CHARACTER = 'Open a character first.';
export const NO_JOINT = 'Select a joint first.';
export const NO_SKELETON = 'Open a character with a skeleton first.';

export const needsCharacter = needs(NO_CHARACTER, (wb: Uses<'store'>) => currentCharacter(wb) !== undefined);
export const needsSkeleton = needs(NO_SKELETON, (wb: Uses<'store'>) => currentCharacter(wb)?.skeleton !== undefined);
/** One or more. */
export const needsJoint = needs(NO_JOINT, (wb: Uses<'store'>) => selectedJoints(wb) !== undefined);
