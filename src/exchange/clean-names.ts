/** Names of other programs as text files can hold them. */

/** Blanks and braces, which end a name in a text file, as `_`. */
export function cleanName(name: string): string {
  return name.trim().replace(/[\s{}]/g, '_');
}

/** The same without what file systems don't take or give a meaning to. */
export function cleanFileName(name: string): string {
  return cleanName(name)
    .replace(/[/\\:*?"<>|\p{Cc}]/gu, '_')
    .replace(/^\.+/, '_')
    .slice(0, 120);
}

/** Names that are given once each; others get a number, before the extension if they have one. */
export class DistinctNames {
  private readonly taken = new Set<string>();

  add(name: string): string {
    const dot = name.lastIndexOf('.');
    const [stem, extension] = dot > 0 ? [name.slice(0, dot), name.slice(dot)] : [name, ''];
    let distinct = name;
    // File systems may ignore case.
    for (let n = 2; this.taken.has(distinct.toLowerCase()); n++) distinct = `${stem}_${n}${extension}`;
    this.taken.add(distinct.toLowerCase());
    return distinct;
  }
}
