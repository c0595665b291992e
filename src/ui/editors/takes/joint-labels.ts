/** Texts about the joints of a comparison: which are compared, why, when they are farthest apart, and which are not. */
import { whyLeftOut } from '../../../evaluate/compare/compared-joints.ts';
import type { Distances } from '../../../evaluate/compare/distance.ts';
import type { Character } from '../../../model/document.ts';
import { playedName } from '../../state/takes.ts';
import type { Uses } from '../../state/workbench.ts';
import type { MenuEntry } from '../../widgets/menu.ts';
import { shown } from '../../widgets/numbers/number-text.ts';
import type { JointLabel } from './distance-list.ts';
import type { Measured } from './measuring.ts';

/** One for each pair. */
export function jointLabels(measured: Measured, distances: Distances): readonly JointLabel[] {
  const { first, second, match } = measured;
  return match.first.map((joint, pair) => {
    const name = nameOf(first, joint);
    const other = nameOf(second, match.second[pair]);
    const worst = `${shown(worstSeconds(distances, pair), 2)} s`;
    return {
      name,
      partner: other === name ? '' : other,
      tooltip: other === name ? name : `${name} and ${other}: ${match.reasons[pair]}`,
      worst: `At ${worst}. Click to go there`,
    };
  });
}

/** Time of the transport at which a pair is farthest apart. */
export function worstSeconds({ startSeconds, frameSeconds, jointMostAt }: Distances, pair: number): number {
  return startSeconds + jointMostAt[pair] * frameSeconds;
}

/** The pair with the largest distance of all. */
export function farthestPair({ jointMost }: Distances): number {
  let farthest = 0;
  for (let k = 1; k < jointMost.length; k++) if (jointMost[k] > jointMost[farthest]) farthest = k;
  return farthest;
}

/** The joints that are not compared, with reasons, below their takes; chosen, one is selected. */
export function leftOutEntries(wb: Uses<'store'>, { first, second, match }: Measured): readonly MenuEntry[] {
  const sides = [
    { own: first, other: second, left: match.onlyFirst },
    { own: second, other: first, left: match.onlySecond },
  ];
  return sides.flatMap(({ own, other, left }, side): MenuEntry[] => {
    if (left.length === 0) return [];
    const items = left.map(
      (joint): MenuEntry => ({
        kind: 'item',
        label: nameOf(own, joint) || 'unnamed',
        detail: whyLeftOut(own, other, joint, match, side === 0),
        enabled: true,
        run: () => wb.store.select({ characterId: own.id, joint }),
      }),
    );
    return [{ kind: 'note', text: `Not compared of ${playedName(own)}` }, ...items];
  });
}

const nameOf = ({ skeleton }: Character, joint: number) => skeleton?.joints[joint]?.name ?? '';
