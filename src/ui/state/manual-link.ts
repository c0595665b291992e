/** Where the manual is, and links into it. Its pages are built from docs/ by `plugins/manual.ts`. */
import { element } from '../widgets/dom.ts';

/** An address below the manual: `guide/curves.html#clean-up`. A test looks each of them up. */
export type ManualPage = `${string}.html` | `${string}.html#${string}`;

/** A new one with each request, so that one for the page that was left is one too. */
export interface AskedManual {
  readonly page: ManualPage;
}

/** What the page's texts speak of, and where the manual explains it. */
const EXPLAINED = {
  cycle: 'guide/curves.html#cycles-and-extrapolation',
  comparing: 'guide/check-your-program.html',
  flags: 'guide/capture-and-review.html#review',
  layers: 'guide/layers.html',
} as const satisfies Record<string, ManualPage>;

export const EXPLAINED_PAGES: readonly ManualPage[] = Object.values(EXPLAINED);

/** Problems of files by their codes, and where the manual explains what is wrong with them. */
const PROBLEMS: readonly { readonly text: string; readonly page: ManualPage; readonly codes: RegExp }[] = [
  { text: 'About weights', page: 'guide/rigging.html#bind-a-skin', codes: /^(skin)?weights?-|^influences-|^binding/ },
  { text: 'About cycles and extrapolation', page: EXPLAINED.cycle, codes: /^extrapol/ },
  {
    text: 'About keys and tangents',
    page: 'guide/curves.html#curve-editor',
    codes: /^keys?-|^tangents?-|^curves?-|^bad-curve/,
  },
  {
    text: 'About captures',
    page: 'guide/capture-and-review.html#open',
    codes: /^frames?-|^rate-|^motion-|^channels?-/,
  },
  {
    text: 'About numbers of other programs',
    page: 'guide/check-your-program.html#what-can-be-compared',
    codes: /^dump-|^ply-/,
  },
  {
    text: 'About files of other programs',
    page: 'guide/other-programs.html#in',
    codes: /^(fbx|gltf|accessor|buffer|extension|import|scene|nodes|compressed)-|-in-blender$/,
  },
  { text: 'About units and axes', page: 'reference/files.html', codes: /^bad-(unit|axes)$/ },
  { text: 'About limits', page: 'guide/posing.html#fk', codes: /^limits-|^couple-/ },
  {
    text: 'About the format',
    page: 'reference/files.html',
    codes:
      /^(brace|keyword|number|name|count|index|offset|joint|parent|triangles|vertex|row|rows|range|pose|matrix|list)-/,
  },
];

export const PROBLEM_PAGES: readonly ManualPage[] = PROBLEMS.map(({ page }) => page);

/** A link to what the manual says about a problem with this code; undefined if it says nothing. */
export function problemLink(code: string): HTMLAnchorElement | undefined {
  const found = problemPage(code);
  return found && manualAnchor(found.text, found.page);
}

/** The first that fits. */
export function problemPage(code: string): { readonly text: string; readonly page: ManualPage } | undefined {
  return PROBLEMS.find(({ codes }) => codes.test(code));
}

/** The one window that the manual is shown in, if it isn't in the page: by a link opened so, or before a dialog. */
export const MANUAL_WINDOW = 'marrow-manual';

export const addressOf = (page: ManualPage): string => `./manual/${page}`;

/** A link into the manual. @param text a question, or the name of the concept */
export function manualLink(text: string, about: keyof typeof EXPLAINED): HTMLAnchorElement {
  return manualAnchor(text, EXPLAINED[about]);
}

/** A link to a page of the manual, which `followManualLinks` opens in the inspector's place. */
export function manualAnchor(text: string, page: ManualPage): HTMLAnchorElement {
  return element('a', { class: 'link', href: addressOf(page), target: MANUAL_WINDOW }, text);
}

/** Opens the manual in its window. False if the browser doesn't allow it. */
export function showManual(page: ManualPage): boolean {
  return window.open(addressOf(page), MANUAL_WINDOW) !== null;
}
