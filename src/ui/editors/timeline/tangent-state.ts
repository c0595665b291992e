/** Which kinds of tangents the selected keys have, for buttons and menus. */
import { type TangentSide, tangentKindsOf } from '../../../edit/keys/tangents.ts';
import { TANGENT_CHOICES, type TangentChoice } from '../../../model/takes/tangent-kinds.ts';
import type { Uses } from '../../state/workbench.ts';
import { selectedKeysInView } from './current-take.ts';
import { timelineTake } from './timeline-take.ts';

/**
 * Whether all selected keys have that kind on one or both sides, a step after them; `mixed` if only some do, or only
 * one side.
 */
export function hasTangents(wb: Uses<'store' | 'timeline'>, kind: TangentChoice, side: TangentSide): boolean | 'mixed' {
  const take = timelineTake(wb)?.take;
  const kinds = take ? tangentKindsOf(take.channels, selectedKeysInView(wb), kind === 'step' ? 'out' : side) : 0;
  const own = 1 << TANGENT_CHOICES.findIndex(({ name }) => name === kind);
  return kinds === own || ((kinds & own) !== 0 && 'mixed');
}

/** The side on which all selected keys have that kind, if the other is mixed or has none. */
export function sideWithTangents(wb: Uses<'store' | 'timeline'>, kind: TangentChoice): 'in' | 'out' | undefined {
  if (kind === 'step') return undefined;
  const [before, after] = (['in', 'out'] as const).map((side) => hasTangents(wb, kind, side) === true);
  if (before === after) return undefined;
  return before ? 'in' : 'out';
}
