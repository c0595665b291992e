/** Which channels are isolated after a click on names in the list. */

/**
 * A click shows these alone; a second one on what already stands alone shows all again. With Ctrl they join those that
 * are isolated, or leave them.
 */
export function isolatedAfter(
  before: readonly number[] | undefined,
  clicked: readonly number[],
  ctrl: boolean,
): readonly number[] | undefined {
  const now = new Set(before);
  if (!ctrl) {
    const same = now.size === clicked.length && clicked.every((c) => now.has(c));
    return same || !clicked.length ? undefined : clicked;
  }
  const leaves = clicked.every((c) => now.has(c));
  for (const channel of clicked) {
    if (leaves) now.delete(channel);
    else now.add(channel);
  }
  return now.size ? [...now].sort((a, b) => a - b) : undefined;
}
