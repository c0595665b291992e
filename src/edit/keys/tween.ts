/**
 * Tween, relax and ease of selected keys. Each run of neighbouring keys lies between the key before it, p, and the one
 * after it, n; a run without both is left alone.
 *
 *     x          (t − t_p) / (t_n − t_p)
 *     tween      v_p + u · (v_n − v_p)
 *     relax      v + a · (L − v)        L on the line from p to n; a < 0 pushes away from it
 *     ease       v_p + x^(1 + 4a) · (v_n − v_p), for a < 0 from the other end
 */
import type { ChannelKeys } from '../../model/session.ts';
import type { Channel, KeyedChannel } from '../../model/takes/take.ts';
import { withValues } from './move.ts';
import { wholeSteps } from './steps.ts';

/** A change of the keys of a run. */
export type KeyTween =
  | { readonly kind: 'tween'; readonly u: number }
  | { readonly kind: 'relax'; readonly amount: number }
  | { readonly kind: 'ease'; readonly amount: number };

/**
 * The channel with the keys of each run at new values; the same object if nothing changes.
 * @param indices ascending, unique
 */
export function withKeysTweened(channel: KeyedChannel, indices: readonly number[], tween: KeyTween): KeyedChannel {
  const { times, values } = channel;
  const next = new Map<number, number>();
  for (const [p, n] of runsWithin(channel, indices)) {
    for (let k = p + 1; k < n; k++) {
      const share = (times[k] - times[p]) / (times[n] - times[p]);
      next.set(k, valueIn(tween, values[k], share, values[p], values[n]));
    }
  }
  return withValues(channel, [...next.keys()], (value, k) => next.get(k) ?? value);
}

/** The keys that a tween changes: those of runs between two keys. @param channels of the take */
export function keysWithin(channels: readonly Channel[], keys: readonly ChannelKeys[]): readonly ChannelKeys[] {
  return keys.flatMap(({ channel, indices }) => {
    const own = channels[channel];
    const runs = own?.kind === 'keys' ? runsWithin(own, indices) : [];
    const within = runs.flatMap(([p, n]) => Array.from({ length: n - p - 1 }, (_, i) => p + 1 + i));
    return within.length > 0 ? [{ channel, indices: within }] : [];
  });
}

/** The keys before and after each run that has both. */
function runsWithin(channel: KeyedChannel, indices: readonly number[]): (readonly [p: number, n: number])[] {
  const whole = wholeSteps(channel, indices);
  const { times } = channel;
  const runs: (readonly [number, number])[] = [];
  for (let from = 0; from < whole.length; ) {
    let to = from;
    while (whole[to + 1] === whole[to] + 1) to++;
    const [p, n] = [whole[from] - 1, whole[to] + 1];
    if (p >= 0 && n < times.length && times[n] > times[p]) runs.push([p, n]);
    from = to + 1;
  }
  return runs;
}

function valueIn(tween: KeyTween, value: number, share: number, before: number, after: number): number {
  switch (tween.kind) {
    case 'tween':
      return before + tween.u * (after - before);
    case 'relax':
      return value + tween.amount * (before + share * (after - before) - value);
    case 'ease':
      return before + eased(share, tween.amount) * (after - before);
  }
}

function eased(share: number, amount: number): number {
  const power = 1 + 4 * Math.abs(amount);
  return amount < 0 ? 1 - (1 - share) ** power : share ** power;
}
