/**
 * How a page comes by its autosave: a script of its own, fetched when the first picture is there, or with the first
 * change if that is earlier. Until then is taken down what it has to know of the time before.
 */
import { onDemand, whenIdle } from '../../ui/state/on-demand.ts';
import type { OpenedFiles } from '../opening.ts';
import type { AutosaveParts } from './autosave.ts';

/**
 * @param opening what the page begins with: it comes by itself, and will again, so it need not be kept
 */
export async function beginAutosave(
  parts: Omit<AutosaveParts, 'sessions' | 'locks'>,
  opening: Promise<unknown>,
): Promise<void> {
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
