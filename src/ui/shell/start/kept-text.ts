/** Texts about sessions left by an earlier page. */

import type { KeptWork } from '../../state/kept-offer.ts';
import { plural } from '../../widgets/numbers/number-text.ts';

/** `14:32`, `yesterday, 14:32`, `3 March, 14:32`; in the browser's locale, since it is a clock time. */
export function whenText(atMs: number, now = new Date()): string {
  const at = new Date(atMs);
  const time = at.toLocaleTimeString([], { hour: '2-digit', minute: '2-digit' });
  if (at.toDateString() === now.toDateString()) return time;
  const dayBefore = new Date(now.getFullYear(), now.getMonth(), now.getDate() - 1);
  if (at.toDateString() === dayBefore.toDateString()) return `yesterday, ${time}`;
  return `${at.toLocaleDateString('en-GB', { day: 'numeric', month: 'long' })}, ${time}`;
}

/** `wasp, 31 joints, 2 takes`; for several characters their names. */
export function contentText(characters: KeptWork['characters']): string {
  const [first] = characters;
  if (!first) return 'files without a character';
  if (characters.length > 1) {
    const others = characters.length - 2;
    const names = `${first.name}, ${characters[1].name}`;
    return others > 0 ? `${names} and ${plural(others, 'more character')}` : names.replace(', ', ' and ');
  }
  const parts = [first.name || 'unnamed character'];
  if (first.joints > 0) parts.push(plural(first.joints, 'joint'));
  if (first.takes > 0) parts.push(plural(first.takes, 'take'));
  return parts.join(', ');
}
