/** Where the manual is, and links into it. Its pages are built from docs/ by `plugins/manual.ts`. */
import { element } from '../widgets/dom.ts';

/** An address below the manual: `guide/curves.html#clean-up`. A test looks each of them up. */
export type ManualPage = `${string}.html` | `${string}.html#${string}`;

/** What the page's texts speak of, and where the manual explains it. */
const EXPLAINED = {
  cycle: 'guide/curves.html#cycles-and-extrapolation',
  comparing: 'guide/check-your-program.html',
  flags: 'guide/capture-and-review.html#review',
} as const satisfies Record<string, ManualPage>;

export const EXPLAINED_PAGES: readonly ManualPage[] = Object.values(EXPLAINED);

/** The one window that the manual is shown in. */
const MANUAL_WINDOW = 'marrow-manual';

const addressOf = (page: ManualPage) => `./manual/${page}`;

/** A link that opens the manual beside the page. @param text a question, or the name of the concept */
export function manualLink(text: string, about: keyof typeof EXPLAINED): HTMLAnchorElement {
  return element('a', { class: 'link', href: addressOf(EXPLAINED[about]), target: MANUAL_WINDOW }, text);
}

/** Opens the manual beside the page. False if the browser doesn't allow it. */
export function showManual(page: ManualPage): boolean {
  return window.open(addressOf(page), MANUAL_WINDOW) !== null;
}
