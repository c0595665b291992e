/**
 * Scripts that are not there from the start: the page begins with what its first picture takes. What is opened now and
 * then (dialogs, what writes files) is fetched when it is asked for, panels when the page has nothing else to do.
 *
 *     const module = await onDemand(wb.messages, 'The inspector', () => import('../editors/inspector/inspector.ts'));
 *     module?.fillInspector(wb, panel);
 *
 * The browser fetches a module once; asking again costs nothing.
 */
import type { Messages } from './messages.ts';
import type { Uses } from './workbench.ts';

/**
 * What `load` gives; undefined where that fails, which is said.
 * @param what as a sentence begins: `The dope sheet`
 */
export async function onDemand<T>(
  messages: Pick<Messages, 'note'>,
  what: string,
  load: () => Promise<T>,
): Promise<T | undefined> {
  try {
    return await load();
  } catch (error) {
    const why = error instanceof Error ? error.message : String(error);
    messages.note(`${what} could not be loaded. Reloading the page may help. ${why}`, 'error');
    return undefined;
  }
}

/** Longest that a busy page makes it wait. */
const PATIENCE_MS = 2000;

/** Runs it when the page has nothing else to do; files that are on their way in come first, their picture with them. */
export function whenIdle({ loading }: Uses<'loading'>, run: () => void): void {
  const until = performance.now() + PATIENCE_MS;
  const wait = () => {
    // Safari has no such callback.
    if ('requestIdleCallback' in window) window.requestIdleCallback(look, { timeout: PATIENCE_MS });
    else setTimeout(look);
  };
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
