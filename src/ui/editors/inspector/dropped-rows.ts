/** Values set by hand that were not keyed go when time moves: the rows that they stood in light up as they do. */
import { type Document, findCharacter } from '../../../model/document.ts';
import type { Uses } from '../../state/workbench.ts';

const LIT_MS = 900;

/** Called before the rows are brought up to date. */
export function flashDropped(wb: Uses<'transport'>, panel: HTMLElement, now: Document, before: Document): void {
  if (now === before) return;
  const { timeSeconds } = wb.transport.get();
  const dropped = before.characters.some(
    ({ id, unkeyed }) => unkeyed && unkeyed.timeSeconds !== timeSeconds && findCharacter(now, id)?.unkeyed !== unkeyed,
  );
  if (!dropped) return;
  // Who wants no motion sees them lit, and then not.
  const isStill = window.matchMedia('(prefers-reduced-motion: reduce)').matches;
  const lit = { backgroundColor: 'var(--selected-quiet)' };
  for (const row of panel.querySelectorAll('.dof[data-driver="unkeyed"]')) {
    row.animate([lit, isStill ? lit : { backgroundColor: 'transparent' }], { duration: LIT_MS, easing: 'ease-in' });
  }
}
