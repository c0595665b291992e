/**
 * Lazily loaded scripts: the page starts with what its first frame needs. Dialogs and writers are loaded on first use,
 * panels when the page is idle.
 *
 *     const module = await onDemand(wb.messages, 'The inspector', () => import('../editors/inspector/inspector.ts'));
 *     module?.fillInspector(wb, panel);
 *
 * The browser loads a module once; calling again costs nothing.
 */
import { sentenceOf } from '../../model/failure.ts';
import type { Messages } from './messages.ts';
import type { Uses } from './workbench.ts';

/**
 * The result of `load`; undefined, with a message, if it fails.
 *
 * @param what start of the message's sentence: `The dope sheet`
 */
export async function onDemand<T>(
  messages: Pick<Messages, 'note'>,
  what: string,
  load: () => Promise<T>,
): Promise<T | undefined> {
  try {
    return await load();
  } catch (error) {
    const why = sentenceOf(error);
    messages.note(`${what} could not be loaded. Reloading the page may help. ${why}`, 'error');
    return undefined;
  }
}

/** Maximum delay on a busy page. */
const PATIENCE_MS = 2000;

/** Runs it when the page is idle; files being loaded come first, including their first frame. */
export function whenIdle(wb: Uses<'loading'>, run: () => void): void {
  afterLoading(wb, run, (look) => {
    // Safari doesn't have it.
    if ('requestIdleCallback' in window) window.requestIdleCallback(look, { timeout: PATIENCE_MS });
    else setTimeout(look);
  });
}

/**
 * Runs it in a task of its own, with the next frame still to come: a page that plays is hardly ever idle, and without a
 * GPU a frame takes longer than a panel. Files being loaded come first.
 */
export function soon(wb: Uses<'loading'>, run: () => void): void {
  afterLoading(wb, run, (look) => setTimeout(look));
}

/** @param later calls what it is given when there is time for it */
function afterLoading({ loading }: Uses<'loading'>, run: () => void, later: (look: () => void) => void): void {
  const until = performance.now() + PATIENCE_MS;
  const wait = () => later(look);
  const look = () => {
    if (!loading.get() || performance.now() >= until) return run();
    const stop = loading.subscribe(() => {
      stop();
      clearTimeout(enough);
      wait();
    });
    const enough = setTimeout(() => {
      stop();
      run();
    }, until - performance.now());
  };
  wait();
}
