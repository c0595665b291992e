/** Names of files that are written together: never one name for two. */

/**
 * The names in their order, each that stands there before with the next number that none has: `walk.anim`, `walk2.anim`.
 * Names that differ in case alone are one, as to many file systems.
 * @param taken names of others
 */
export function distinctNames(names: readonly string[], taken: readonly string[] = []): readonly string[] {
  const used = new Set(taken.map((name) => name.toLowerCase()));
  // What nobody else is called keeps its name, whatever another one is given.
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
