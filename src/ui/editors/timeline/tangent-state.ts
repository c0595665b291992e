/** Which kinds of tangents the selected keys have, for buttons and menus. */
import { type TangentSide, tangentKindsOf } from '../../../edit/keys/tangents.ts';
import { TANGENT_KINDS, type TangentKind } from '../../../model/takes/take.ts';
import type { Uses } from '../../state/workbench.ts';
import { currentTake, selectedKeysInView } from './current-take.ts';

/** Whether all selected keys have that kind on one or both sides; `mixed` if only some do, or only one side. */
export function hasTangents(wb: Uses<'store' | 'timeline'>, kind: TangentKind, side: TangentSide): boolean | 'mixed' {
  const take = currentTake(wb)?.take;
  const kinds = take ? tangentKindsOf(take.channels, selectedKeysInView(wb), side) : 0;
  const own = 1 << TANGENT_KINDS.indexOf(kind);
  return kinds === own || ((kinds & own) !== 0 && 'mixed');
}

/** The side on which all selected keys have that kind, if the other is mixed or has none. */
export function sideWithTangents(wb: Uses<'store' | 'timeline'>, kind: TangentKind): 'in' | 'out' | undefined {
  const [before, after] = (['in', 'out'] as const).map((side) => hasTangents(wb, kind, side) === true);
  if (before === after) return undefined;
  return before ? 'in' : 'out';
}
