/** Guesses what a mistyped name was meant to be. */

/** The name that takes the fewest changes of letters; undefined if all are more than a third different. */
export function nearestName(mistyped: string, names: readonly string[]): string | undefined {
  let nearest: string | undefined;
  let fewest = Infinity;
  for (const name of names) {
    const most = Math.max(1, Math.floor(name.length / 3));
    // Each letter more or less is a change.
    if (Math.abs(name.length - mistyped.length) > most) continue;
    const changes = changesBetween(mistyped, name);
    if (changes > most || changes >= fewest) continue;
    nearest = name;
    fewest = changes;
  }
  return nearest;
}

/** How many letters are inserted, left out, replaced, or swapped with the next (optimal string alignment). */
function changesBetween(a: string, b: string): number {
  let before: readonly number[] = [];
  let above: readonly number[] = Array.from({ length: b.length + 1 }, (_, j) => j);
  for (let i = 1; i <= a.length; i++) {
    const row = [i];
    for (let j = 1; j <= b.length; j++) {
      const replaced = above[j - 1] + (a[i - 1] === b[j - 1] ? 0 : 1);
      const isSwap = i > 1 && j > 1 && a[i - 1] === b[j - 2] && a[i - 2] === b[j - 1];
      row.push(Math.min(replaced, above[j] + 1, row[j - 1] + 1, isSwap ? before[j - 2] + 1 : Infinity));
    }
    before = above;
    above = row;
  }
  return above[b.length];
}
