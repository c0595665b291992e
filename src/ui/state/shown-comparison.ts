/** How panels and views follow what is compared at the time shown, without its scripts before there is any. */
import type { ComparedResult, DumpComparison, ShownComparison } from './dump-comparison.ts';
import type { Uses } from './workbench.ts';

/**
 * Calls back at once, and whenever what is compared at the time shown changes, with undefined if nothing is. Returns an
 * unsubscribe function.
 */
export function onShown(
  { comparing }: Uses<'comparing'>,
  listener: (shown: ShownComparison | undefined, comparing: DumpComparison | undefined) => void,
): () => void {
  let stop: (() => void) | undefined;
  const follow = (now: DumpComparison | undefined) => {
    stop?.();
    stop = now?.shown.subscribe((shown) => listener(shown, now));
    listener(now?.shown.get(), now);
  };
  const stopFollowing = comparing.subscribe(follow);
  follow(comparing.get());
  return () => {
    stopFollowing();
    stop?.();
  };
}

/** Ends it, and forgets the dumps. */
export function endComparison({ comparing }: Uses<'comparing'>): void {
  comparing.get()?.end();
  comparing.set(undefined);
}

/** Calls back whenever what was found changes, with undefined if there is nothing. Returns an unsubscribe function. */
export function onResult(
  { comparing }: Uses<'comparing'>,
  listener: (result: ComparedResult | undefined) => void,
): () => void {
  let last = comparing.get()?.state.get().result;
  const tell = (result: ComparedResult | undefined) => {
    if (result === last) return;
    last = result;
    listener(result);
  };
  let stop: (() => void) | undefined;
  const follow = (now: DumpComparison | undefined) => {
    stop?.();
    stop = now?.state.subscribe(({ result }) => tell(result));
    tell(now?.state.get().result);
  };
  const stopFollowing = comparing.subscribe(follow);
  follow(comparing.get());
  return () => {
    stopFollowing();
    stop?.();
  };
}
