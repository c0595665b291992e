/** Distinct names for files that are written together. */

/**
 * The names in order, duplicates numbered with the next free number: `walk.anim`, `walk2.anim`. Names that differ only
 * in case count as duplicates, as in many file systems.
 * @param taken names already in use
 */
export function distinctNames(names: readonly string[], taken: readonly string[] = []): readonly string[] {
  const used = new Set(taken.map((name) => name.toLowerCase()));
  // A unique name is never changed because of another's number.
  const given = new Set(names.map((name) => name.toLowerCase()));
  return names.map((name) => {
    const dot = name.lastIndexOf('.');
    let free = name;
    for (let n = 2; used.has(free.toLowerCase()); n++) {
      const next = `${name.slice(0, dot)}${n}${name.slice(dot)}`;
      if (!given.has(next.toLowerCase())) free = next;
    }
    used.add(free.toLowerCase());
    return free;
  });
}
