/** Names that are given once each; others get a number, before the extension if they have one. */
export class DistinctNames {
  /** In lower case, since file systems may ignore case; with the last number that was tried for it. */
  private readonly taken = new Map<string, number>();

  constructor(taken: Iterable<string> = []) {
    for (const name of taken) this.taken.set(name.toLowerCase(), 1);
  }

  /** Whether the name is taken, upper and lower case alike. */
  has(name: string): boolean {
    return this.taken.has(name.toLowerCase());
  }

  /**
   * Takes the name, or `name_1`, `name_2` … if it is taken, with the number before the extension; returns what was
   * taken.
   */
  add(name: string): string {
    const dot = name.lastIndexOf('.');
    const [stem, extension] = dot > 0 ? [name.slice(0, dot), name.slice(dot)] : [name, ''];
    let distinct = name;
    let number = this.taken.get(name.toLowerCase()) ?? 0;
    while (this.has(distinct)) distinct = `${stem}_${++number}${extension}`;
    this.taken.set(name.toLowerCase(), Math.max(1, number));
    this.taken.set(distinct.toLowerCase(), 1);
    return distinct;
  }
}
