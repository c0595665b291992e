/** Names of other programs as text files can hold them. */

/** Blanks and braces, which end a name in a text file, as `_`. */
export function cleanName(name: string): string {
  return name.trim().replace(/[\s{}]/g, '_');
}

/** A name without what file systems don't take or give a meaning to. */
export function cleanFileName(name: string): string {
  return cleanName(name)
    .replace(/[/\\:*?"<>|\p{Cc}]/gu, '_')
    .replace(/^\.+/, '_')
    .slice(0, 120);
}
