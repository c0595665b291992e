/** Sentences about changes of the extrapolation by a tool for whole curves, which might go unnoticed. */
import { EXTRAPOLATION_NAMES } from '../../../../edit/commands/extrapolation.ts';
import { period } from '../../../../edit/keys/cycle.ts';
import { type Extrapolation, repeats, type Take } from '../../../../model/takes/take.ts';
import { plural, shown } from '../../../widgets/numbers/number-text.ts';

const SIDES = [
  ['Before the keys', 'extrapolateIn'],
  ['After the keys', 'extrapolateOut'],
] as const;

/** `After the keys, 2 curves will be constant instead of cycle.` Empty if nothing changes. */
export function changesBeyond(before: Take, after: Take, channels: readonly number[]): string[] {
  const sentences: string[] = [];
  for (const [where, side] of SIDES) {
    const kinds = new Map<string, number>();
    const spans: (readonly [number, number])[] = [];
    for (const index of channels) {
      const was = before.channels[index];
      const now = after.channels[index];
      if (was?.kind !== 'keys' || now?.kind !== 'keys' || was === now) continue;
      if (now[side] !== was[side]) {
        const what = `${nameOf(now[side])} instead of ${nameOf(was[side])}`;
        kinds.set(what, (kinds.get(what) ?? 0) + 1);
      } else if (repeats(now[side]) && isOther(period(was), period(now))) spans.push([period(was), period(now)]);
    }
    for (const [what, number] of kinds) sentences.push(`${where}, ${plural(number, 'curve')} will be ${what}.`);
    if (spans.length) sentences.push(`${where}, ${spansText(spans)}`);
  }
  return sentences;
}

/** Cycles repeat over all keys. */
function spansText(spans: readonly (readonly [number, number])[]): string {
  const [[was, now]] = spans;
  const what = `${plural(spans.length, 'curve')} will repeat all keys, including the new ones:`;
  const alike = spans.every(([w, n]) => !isOther(w, was) && !isOther(n, now));
  if (!alike) return `${what} at different intervals than before.`;
  return `${what} every ${shown(now)} s instead of every ${shown(was)} s.`;
}

function nameOf(extrapolation: Extrapolation): string {
  return EXTRAPOLATION_NAMES[extrapolation].toLowerCase();
}

/** Differs by more than rounding. */
function isOther(a: number, b: number): boolean {
  return Math.abs(a - b) > 1e-9 * Math.max(1, Math.abs(a), Math.abs(b));
}
