/** Tangents of keys: by kind, as a number, unified or broken. */

import { TANGENT_KINDS } from '../../model/takes/tangent-kinds.ts';
import { changeKeys, changeTangents } from '../channel-edits.ts';
import { command } from '../command.ts';
import { withStepsAfter } from '../keys/steps.ts';
import {
  setSlope,
  setTangentKind,
  type TangentSide,
  withTangentsBroken,
  withTangentsUnified,
} from '../keys/tangents.ts';
import { number } from '../schema/shape.ts';
import { KEYS, side, tangentChoice } from '../schema/shared-shapes.ts';
import { keysIn } from '../step-names.ts';

/**
 * `fixed` keeps the current slope as a number. `step`, on whichever side, makes keys hold up to the next one; any other
 * choice for the side after a key ends that. Among keys of other channels, those of a goal's `blend` and `bend` that are
 * steps stay so, as do all steps between a goal's spaces.
 */
export const setTangents = command({
  id: 'keys.setTangents',
  args: { ...KEYS, side, kind: tangentChoice },
  label: (document, { characterId, keys, side, kind }) =>
    `Set ${keysIn(document, characterId, keys)} to ${kind}${kind === 'step' ? '' : where(side)}`,
  run(document, { characterId, keys, side, kind }) {
    if (kind === 'step') return changeKeys(document, { characterId, keys }, withStepsAfter);
    const code = TANGENT_KINDS.indexOf(kind);
    return changeTangents(document, { characterId, keys }, side, (c, indices) =>
      setTangentKind(c, indices, side, code),
    );
  },
});

/** Value per second. */
export const setSlopes = command({
  id: 'keys.setSlopes',
  args: { ...KEYS, side, slope: number },
  label: (document, { characterId, keys, side }) => `Set slope of ${keysIn(document, characterId, keys)}${where(side)}`,
  run(document, { characterId, keys, side, slope }) {
    return changeTangents(document, { characterId, keys }, side, (c, indices) => setSlope(c, indices, side, slope));
  },
});

/** Gives both tangents of each key the mean of their slopes; keys whose slopes agree are kept. */
export const unifyTangents = command({
  id: 'keys.unify',
  args: KEYS,
  label: (document, { characterId, keys }) => `Unify tangents of ${keysIn(document, characterId, keys)}`,
  run: (document, { characterId, keys }) => changeTangents(document, { characterId, keys }, 'in', withTangentsUnified),
});

/** Breaks the tangents of keys, so that each can be changed alone; the curve stays. */
export const breakTangents = command({
  id: 'keys.break',
  args: KEYS,
  label: (document, { characterId, keys }) => `Break tangents of ${keysIn(document, characterId, keys)}`,
  run: (document, { characterId, keys }) => changeTangents(document, { characterId, keys }, 'in', withTangentsBroken),
});

function where(side: TangentSide): string {
  return side === 'both' ? '' : side === 'in' ? ' before' : ' after';
}
