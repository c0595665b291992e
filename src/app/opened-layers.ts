/**
 * What the page does once takes with layers were read: it gets their code, and asks what counts where the plain file of
 * one was edited since it was saved with them.
 */
import type { Store } from '../edit/store.ts';
import type { Keep } from '../files/open/layers.ts';
import type { Messages } from '../ui/state/messages.ts';
import type { ParseOutput } from '../worker/protocol.ts';

export { provideLeaders } from '../edit/follow/leaders.ts';
export { provideLayers } from '../evaluate/layers.ts';

/**
 * Asks nothing with `keep`, or if nothing was edited. The edit is open; the layers are another step, which can be
 * undone too.
 * @param open opens the same files again
 */
export function askWhatToKeep<Options extends { readonly keep?: Keep }>(
  { layers }: Pick<ParseOutput, 'layers'>,
  options: Options,
  { messages, store }: { readonly messages: Messages; readonly store: Store },
  open: (options: Options) => void,
): void {
  const { edited = [] } = layers ?? {};
  if (options.keep !== undefined || edited.length === 0) return;
  const names = edited.join(', ');
  const text =
    edited.length === 1
      ? `${names} was edited since it was saved with its layers. The edit is open, without layers.`
      : `${names} were edited since they were saved with their layers. The edits are open, without layers.`;
  const { document } = store;
  const keepLayers = () => {
    messages.withdraw(text);
    open({ ...options, keep: 'controls' });
  };
  messages.suggest(
    text,
    [
      { label: 'Keep the edit', run: () => messages.withdraw(text) },
      { label: 'Keep the layers', run: keepLayers },
    ],
    () => store.document !== document,
  );
}
