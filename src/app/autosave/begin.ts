/**
 * Starts autosave: a script of its own, loaded after the first frame or on the first change, whichever is earlier.
 * Until then, what happens is recorded.
 */
import { onDemand, whenIdle } from '../../ui/state/on-demand.ts';
import type { OpenedFiles } from '../opening.ts';
import type { FollowedParts } from './start.ts';

/** @param opening opens the page's initial document, which isn't kept since it is opened again on each start */
export async function beginAutosave(parts: FollowedParts, opening: Promise<unknown>): Promise<void> {
  const { store, opener, loading, messages } = parts;
  const opened: OpenedFiles[] = [];
  const stop = opener.subscribe((files) => opened.push(files));
  await opening;
  const own = store.document;
  await new Promise<void>((resolve) => {
    const enough = () => {
      unsubscribe();
      resolve();
    };
    const unsubscribe = store.subscribe((now) => now.document !== own && enough());
    whenIdle({ loading }, enough);
  });
  const module = await onDemand(messages, 'Crash recovery', () => import('./start.ts'));
  stop();
  module?.startAutosave(parts, { own, opened });
}
