/** Tangents of keys: by kind, as a number, unified or broken. */
import { TANGENT_KINDS, type TangentKind } from '../../model/clip.ts';
import { finiteNumber, oneOf } from '../arguments.ts';
import { changeTangents, type OfKeys } from '../channel-edits.ts';
import {
  setSlope,
  setTangentKind,
  TANGENT_SIDES,
  type TangentSide,
  withTangentsBroken,
  withTangentsUnified,
} from '../keys/tangents.ts';
import { keysIn } from '../step-names.ts';
import type { Command, Edit } from '../store.ts';

interface OfSide extends OfKeys {
  readonly side: TangentSide;
}

/** `fixed` keeps the current slope as a number. */
export const setTangents: Command<OfSide & { readonly kind: TangentKind }, Edit> = {
  id: 'keys.setTangents',
  label: (document, { characterId, keys, side, kind }) =>
    `Set ${keysIn(document, characterId, keys)} to ${kind}${where(side)}`,
  run(document, { characterId, keys, side, kind }) {
    oneOf(side, TANGENT_SIDES, '"side"');
    const code = TANGENT_KINDS.indexOf(oneOf(kind, TANGENT_KINDS, '"kind"'));
    return changeTangents(document, { characterId, keys }, (c, indices) => setTangentKind(c, indices, side, code));
  },
};

/** Value per second. */
export const setSlopes: Command<OfSide & { readonly slope: number }, Edit> = {
  id: 'keys.setSlopes',
  label: (document, { characterId, keys, side }) => `Set slope of ${keysIn(document, characterId, keys)}${where(side)}`,
  run(document, { characterId, keys, side, slope }) {
    oneOf(side, TANGENT_SIDES, '"side"');
    finiteNumber(slope, '"slope"');
    return changeTangents(document, { characterId, keys }, (c, indices) => setSlope(c, indices, side, slope));
  },
};

export const unifyTangents: Command<OfKeys, Edit> = {
  id: 'keys.unify',
  label: (document, { characterId, keys }) => `Unify tangents of ${keysIn(document, characterId, keys)}`,
  run: (document, { characterId, keys }) => changeTangents(document, { characterId, keys }, withTangentsUnified),
};

export const breakTangents: Command<OfKeys, Edit> = {
  id: 'keys.break',
  label: (document, { characterId, keys }) => `Break tangents of ${keysIn(document, characterId, keys)}`,
  run: (document, { characterId, keys }) => changeTangents(document, { characterId, keys }, withTangentsBroken),
};

function where(side: TangentSide): string {
  return side === 'both' ? '' : side === 'in' ? ' before' : ' after';
}
