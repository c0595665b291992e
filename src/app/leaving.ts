/** What the browser shows of unsaved work: a mark in the title, and its question before the page is left. */
import type { FileActions } from '../ui/state/workbench.ts';

/** `• wasp_walk.anim – Marrow`; `• 3 files – Marrow`. */
export function titleFor(name: string, unsaved: readonly { readonly name: string }[]): string {
  const [first] = unsaved;
  if (!first) return name;
  return `• ${unsaved.length === 1 ? first.name : `${unsaved.length} files`} – ${name}`;
}

/** Keeps the title, and asks before leaving for as long as something is unsaved: no longer, for asking has a price. */
export function markUnsaved({ unsaved }: Pick<FileActions, 'unsaved'>, page: Window): void {
  const name = page.document.title;
  const ask = (event: BeforeUnloadEvent) => event.preventDefault();
  const show = () => {
    const parts = unsaved.get();
    page.document.title = titleFor(name, parts);
    if (parts.length) page.addEventListener('beforeunload', ask);
    else page.removeEventListener('beforeunload', ask);
  };
  unsaved.subscribe(show);
  show();
}
