/**
 * What actions need, and what to do if it is missing: a key that does nothing and says nothing looks broken. Menus don't
 * show these reasons below each disabled entry (`Action.whyNot` is for those that nobody would guess); they are told
 * when a disabled action is asked for.
 */
type Test = (wb: never) => boolean;
type Reason = string | ((wb: never) => string);

const reasons = new WeakMap<Test, Reason>();

/** The test itself, for `Action.enabled`, with a sentence for when it fails. */
export function needs<W>(reason: string | ((wb: W) => string), test: (wb: W) => boolean): (wb: W) => boolean {
  const own = (wb: W) => test(wb);
  reasons.set(own, reason);
  return own;
}

/** The sentence of a test that was made by `needs`. */
export function reasonOf<W>(test: ((wb: W) => boolean) | undefined, wb: W): string | undefined {
  const reason = test && reasons.get(test);
  // Made for the same workbench as the test.
  return typeof reason === 'function' ? (reason as (wb: W) => string)(wb) : reason;
}

export const NO_CHARACTER = 'Open a character first.';
export const NO_SKELETON = 'Open a character with a skeleton first.';
