/** A typed box must have its lower corner below its upper one, as for limits. */
import type { Vec3 } from '../../../math/vec3.ts';
import type { Box } from '../../../model/skeleton/skeleton.ts';
import { shown } from '../../widgets/numbers/number-text.ts';

/**
 * Why a corner is invalid; undefined if valid. Files may have the corners swapped: along such an axis anything may be
 * typed.
 */
export function whyNoCorner(box: Box, side: keyof Box, corner: Vec3): string | undefined {
  const next = { ...box, [side]: corner };
  for (const axis of [0, 1, 2] as const) {
    if (!(next.min[axis] > next.max[axis]) || box.min[axis] > box.max[axis]) continue;
    const letter = 'xyz'[axis];
    const [from, to] = [next.min[axis], next.max[axis]].map((value) => shown(value));
    return `The box would go from ${from} to ${to} along ${letter}, but “from” must be below “to”.`;
  }
  return undefined;
}
