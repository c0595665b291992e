/**
 * Requirements of actions, with a sentence for when they aren't met: a shortcut that silently does nothing looks
 * broken. Menus don't show these below each disabled entry (`Action.whyNot` is for the surprising ones); they are shown
 * when a disabled action is run.
 */
type Test = (wb: never) => boolean;
type Reason = string | ((wb: never) => string);

const reasons = new WeakMap<Test, Reason>();

/** The test for `Action.enabled`, with the sentence for when it fails. */
export function needs<W>(reason: string | ((wb: W) => string), test: (wb: W) => boolean): (wb: W) => boolean {
  const own = (wb: W) => test(wb);
  reasons.set(own, reason);
  return own;
}

/** The sentence of a test created by `needs`. */
export function reasonOf<W>(test: ((wb: W) => boolean) | undefined, wb: W): string | undefined {
  const reason = test && reasons.get(test);
  // Created for the same workbench as the test.
  return typeof reason === 'function' ? (reason as (wb: W) => string)(wb) : reason;
}

export const NO_CHARACTER = 'Open a character first.';
export const NO_JOINT = 'Select a joint first.';
export const NO_SKELETON = 'Open a character with a skeleton first.';
