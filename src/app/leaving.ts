/** How the browser shows unsaved work: a mark in the title, and a question before leaving the page. */
import { cutMessage } from '../model/names/cut-text.ts';
import type { FileActions } from '../ui/state/workbench.ts';

/** `• wasp_walk.anim – Marrow`; `• 3 files – Marrow`. */
export function titleFor(name: string, unsaved: readonly { readonly name: string }[]): string {
  const [first] = unsaved;
  if (!first) return name;
  return `• ${unsaved.length === 1 ? first.name : `${unsaved.length} files`} – ${name}`;
}

/**
 * Keeps the title up to date, and asks before leaving only while something is unsaved: a `beforeunload` listener has a
 * price.
 */
export function markUnsaved({ unsaved }: Pick<FileActions, 'unsaved'>, page: Window): void {
  const name = page.document.title;
  const ask = (event: BeforeUnloadEvent) => event.preventDefault();
  const show = () => {
    const parts = unsaved.get();
    page.document.title = cutMessage(titleFor(name, parts));
    if (parts.length) page.addEventListener('beforeunload', ask);
    else page.removeEventListener('beforeunload', ask);
  };
  unsaved.subscribe(show);
  show();
}
