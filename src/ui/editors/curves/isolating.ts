/** Isolated channels after a click on names in the list. */

/** A click isolates these; a second one shows all again. Ctrl+click adds or removes them. */
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
