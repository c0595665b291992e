/** Values of DOFs as told during a drag or by keys: `rx 34.2°`, `limit 90°`. */
import type { Character } from '../../../model/document.ts';
import type { CharacterDof } from '../../../model/skeleton/dofs.ts';
import { isUnlimited } from '../../../model/skeleton/skeleton.ts';
import { aligned, shown } from '../../widgets/numbers/number-text.ts';
import type { Settings } from '../settings.ts';
import { shownPerUnit, unitText } from './angles.ts';
import { lengthUnit } from './length-unit.ts';

type Unit = Pick<CharacterDof, 'name' | 'unit'>;

export function dofValueText(dof: Unit, value: number, character: Character, angles: Settings['angles']): string {
  const decimals = dof.unit === 'angle' && angles === 'degrees' ? 1 : 3;
  const text = aligned(value * shownPerUnit(dof.unit, angles), decimals);
  return `${dof.name} ${text}${unitOf(dof, character, angles)}`;
}

/** @param holds whether the limit clamps the drag; else it is only reported as passed */
export function limitNote(
  dof: Unit,
  limit: number,
  holds: boolean,
  character: Character,
  angles: Settings['angles'],
): string {
  return `${holds ? 'limit' : 'past its limit'} ${limitValueText(dof, limit, character, angles)}`;
}

/** `90°`, `2 m`. */
export function limitValueText(dof: Unit, limit: number, character: Character, angles: Settings['angles']): string {
  return `${shown(limit * shownPerUnit(dof.unit, angles), 2)}${unitOf(dof, character, angles)}`;
}

/** `−97 … 80°`; empty without limits. */
export function limitRange(
  dof: Pick<CharacterDof, 'name' | 'unit' | 'limit'>,
  character: Character,
  angles: Settings['angles'],
): string {
  const { min, max } = dof.limit;
  if (min > max || isUnlimited(dof.limit)) return '';
  const low = shown(min * shownPerUnit(dof.unit, angles), 2);
  return `${low} … ${limitValueText(dof, max, character, angles)}`;
}

function unitOf({ unit }: Unit, character: Character, angles: Settings['angles']): string {
  return unit === 'length' ? ` ${lengthUnit(character)}` : unitText(unit, angles);
}
