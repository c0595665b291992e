/** What the panel says about verdicts and flags. */
import { amountOfBadness, FLAG_KINDS, type Flag, type FlagKind } from '../../../review/flags.ts';
import type { ReviewView } from '../../state/review.ts';
import { plural, shown } from '../../widgets/numbers/number-text.ts';

export const FLAG_NAMES: Readonly<Record<FlagKind, string>> = {
  spike: 'Spike',
  jitter: 'Jitter',
  slide: 'Foot sliding',
  floor: 'Below the ground',
  frozen: 'Frozen',
  duplicate: 'Duplicate frames',
  limit: 'Beyond limit',
  turned: 'Turned foot or hand',
  bone: 'Bone length',
};

/** `2 spikes, jitter`: by kind, in a fixed order. */
export function flagsText(flags: readonly Flag[]): string {
  return FLAG_KINDS.flatMap((kind) => {
    const count = flags.filter((flag) => flag.kind === kind).length;
    if (count === 0) return [];
    const name = FLAG_NAMES[kind].toLowerCase();
    return [count === 1 ? name : `${name} ×${count}`];
  }).join(', ');
}

/** How much of it: `4.1 cm`, `12 frames`. */
export function amountText({ kind, amount }: Pick<Flag, 'kind' | 'amount'>): string {
  if (kind === 'frozen') return `${shown(amount, 2)} s`;
  if (kind === 'duplicate') return plural(amount, 'frame');
  if (kind === 'limit' || kind === 'turned') return `${shown((amount * 180) / Math.PI, 0)}°`;
  return amount < 1 ? `${shown(100 * amount, 1)} cm` : `${shown(amount, 2)} m`;
}

/** `20 cm or more`. */
export function atLeastText(kind: FlagKind, bad: number): string {
  return `${amountText({ kind, amount: amountOfBadness(kind, bad) })} or more`;
}

/** Of a list that the filters leave empty. */
export function noneLeft({ text, verdict, flag, tag, stars }: ReviewView): string {
  const isVerdictAlone = text === '' && flag === undefined && tag === undefined && stars === 0;
  if (verdict === '' && isVerdictAlone) return 'Every take has a verdict. Show only > All takes lists them again.';
  return 'No take matches the filter. Show only > All takes lists them all.';
}

/** `1.23 s`, or `2.1–2.65 s`. */
export function momentText({ from, to }: Flag): string {
  const [start, end] = [shown(from, 2), shown(to, 2)];
  return start === end ? `${start} s` : `${start}–${end} s`;
}

/** `Spike of LeftHand: 4.1 cm at 1.23 s`. */
export function worstText(flag: Flag): string {
  const whose = flag.joint ? ` of ${flag.joint}` : '';
  return `${FLAG_NAMES[flag.kind]}${whose}: ${amountText(flag)} at ${momentText(flag)}`;
}

export function starsText(stars: number): string {
  return '★'.repeat(stars);
}
