/**
 * Menus, panels and keys: one script, fetched when the first picture is there, or at the first press or key if that is
 * earlier. Until then the frame of `index.html` is in their place. Nothing that is pressed meanwhile is lost: it happens
 * again as soon as there is something to answer it.
 */
import { element } from '../kit/dom.ts';

type Rest = typeof import('./mount.ts');

export interface RestOfPage {
  readonly isHere: boolean;
  /** Fetches it now. Resolves when it is mounted, or could not be fetched. */
  fetch(): Promise<void>;
}

/** Longest that a file which takes long to read makes it wait. */
const PATIENCE_MS = 2000;

/**
 * @param firstPicture resolves when the document has what the page begins with
 * @param mount builds it
 */
export function restOfPage(root: HTMLElement, firstPicture: Promise<unknown>, mount: (rest: Rest) => void): RestOfPage {
  const waiting = new AbortController();
  const early: Event[] = [];
  let isHere = false;
  let fetching: Promise<void> | undefined;
  const fetchAndMount = async () => {
    try {
      mount(await import('./mount.ts'));
      isHere = true;
    } catch (error) {
      const why = error instanceof Error ? error.message : String(error);
      // There is no line for messages as yet.
      root.querySelector('.outliner')?.append(element('p', { class: 'empty' }, `${FAILED} ${why}`));
    }
    waiting.abort();
    for (const event of early) repeat(event);
  };
  const fetch = () => {
    fetching ??= fetchAndMount();
    return fetching;
  };
  for (const type of ['keydown', 'click']) {
    const keep = (event: Event) => {
      early.push(event);
      void fetch();
    };
    window.addEventListener(type, keep, { capture: true, signal: waiting.signal });
  }
  const drawn = firstPicture.then(nextFrame, nextFrame);
  void Promise.race([drawn, new Promise((resolve) => setTimeout(resolve, PATIENCE_MS))]).then(fetch);
  return {
    get isHere() {
      return isHere;
    },
    fetch,
  };
}

const FAILED = 'Menus and panels could not be loaded; a reload of the page may help.';

/** When what is there now has been drawn. */
function nextFrame(): Promise<void> {
  return new Promise((resolve) => {
    requestAnimationFrame(() => setTimeout(resolve));
  });
}

/** What was pressed on the frame is pressed on what is in its place now. */
function repeat(event: Event): void {
  if (event instanceof KeyboardEvent) {
    (document.activeElement ?? document.body).dispatchEvent(new KeyboardEvent(event.type, event));
    return;
  }
  if (!(event instanceof PointerEvent)) return;
  const target = document.elementFromPoint(event.clientX, event.clientY);
  for (const type of ['pointerdown', 'pointerup', 'click']) target?.dispatchEvent(new PointerEvent(type, event));
}
