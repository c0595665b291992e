/** What we use of lil-gui's folders beyond its methods: its elements, and whether one is open. */
import type { GUI } from 'lil-gui';

/** Contains the rows. */
export function contentOf(section: GUI): HTMLElement {
  return section.$children;
}

/** The button that opens and closes it. */
export function titleOf(section: GUI): HTMLElement {
  return section.$title;
}

export function isOpen(section: GUI): boolean {
  return !section._closed;
}
