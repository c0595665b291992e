/** Highlights rows whose unkeyed changes were lost when the time changed. */
import { type Document, findCharacter } from '../../../model/document.ts';
import type { Uses } from '../../state/workbench.ts';

const LIT_MS = 900;

/** Call before the rows are updated. */
export function flashDropped(wb: Uses<'transport'>, panel: HTMLElement, now: Document, before: Document): void {
  if (now === before) return;
  const { timeSeconds } = wb.transport.get();
  const dropped = before.characters.some(
    ({ id, unkeyed }) => unkeyed && unkeyed.timeSeconds !== timeSeconds && findCharacter(now, id)?.unkeyed !== unkeyed,
  );
  if (!dropped) return;
  // With reduced motion: on, then off, without fading.
  const isStill = window.matchMedia('(prefers-reduced-motion: reduce)').matches;
  const lit = { backgroundColor: 'var(--selected-quiet)' };
  for (const row of panel.querySelectorAll('.dof[data-driver="unkeyed"]')) {
    row.animate([lit, isStill ? lit : { backgroundColor: 'transparent' }], { duration: LIT_MS, easing: 'ease-in' });
  }
}
