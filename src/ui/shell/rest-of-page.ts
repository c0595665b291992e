/**
 * Menus, panels and keys: one script, loaded after the first frame, or on the first press or key if that is earlier.
 * Until then the frame of `index.html` is shown. Input meanwhile isn't lost: it is replayed once the page is built.
 */
import { sentenceOf } from '../../model/failure.ts';
import { element } from '../widgets/dom.ts';
import type { MountedPage } from './mount.ts';

type Rest = typeof import('./mount.ts');

export interface RestOfPage {
  /** Resolves when its panels have their content, or soon after the first picture if that takes longer. */
  readonly filled: Promise<unknown>;
  /** Undefined until it is mounted. */
  readonly page: MountedPage | undefined;
  /** Loads it now. Resolves when mounted; with undefined when loading has failed, which the page says. */
  fetch(): Promise<MountedPage | undefined>;
}

/** Maximum delay while a large file is read, and of a first picture that doesn't move yet. */
const PATIENCE_MS = 2000;

export interface RestParts {
  /** Fetches what else is needed to mount it. */
  beside(): Promise<unknown>;
  /** Builds the page. */
  mount(rest: Rest): MountedPage;
}

/** @param firstPicture resolves when the document has its initial content */
export function restOfPage(
  root: HTMLElement,
  firstPicture: Promise<unknown>,
  { beside, mount }: RestParts,
): RestOfPage {
  const waiting = new AbortController();
  const early: Event[] = [];
  let page: MountedPage | undefined;
  let fetching: Promise<MountedPage | undefined> | undefined;
  let fill = (_when: Promise<unknown>) => {};
  const filled = new Promise((resolve) => {
    fill = resolve;
  });
  const fetchAndMount = async () => {
    // Beside, and not one after the other. What becomes of it is seen to where it is used.
    import('../editors/inspector/inspector.ts').catch(() => {});
    try {
      const [rest] = await Promise.all([import('./mount.ts'), beside()]);
      page = mount(rest);
      fill(page.filled);
    } catch (error) {
      const why = sentenceOf(error);
      // There is no message line yet.
      root.querySelector('.outliner')?.append(element('p', { class: 'empty' }, `${FAILED} ${why}`));
    }
    waiting.abort();
    for (const event of early) repeat(event);
    return page;
  };
  const fetch = () => {
    fetching ??= fetchAndMount();
    return fetching;
  };
  for (const type of ['keydown', 'click']) {
    const keep = (event: Event) => {
      if (event instanceof KeyboardEvent && isBrowserCommand(event)) event.preventDefault();
      early.push(event);
      void fetch();
    };
    window.addEventListener(type, keep, { capture: true, signal: waiting.signal });
  }
  const drawn = firstPicture.then(nextFrame, nextFrame);
  void Promise.race([drawn, new Promise((resolve) => setTimeout(resolve, PATIENCE_MS))]).then(fetch);
  void drawn.then(() => setTimeout(fill, PATIENCE_MS));
  return {
    filled,
    get page() {
      return page;
    },
    fetch,
  };
}

const FAILED = 'Menus and panels could not be loaded. Reloading the page may help.';

/** Resolves after the current state was drawn. */
function nextFrame(): Promise<void> {
  return new Promise((resolve) => {
    requestAnimationFrame(() => setTimeout(resolve));
  });
}

/** Replays input on the element that replaced the frame's. */
function repeat(event: Event): void {
  if (event instanceof KeyboardEvent) {
    (document.activeElement ?? document.body).dispatchEvent(new KeyboardEvent(event.type, event));
    return;
  }
  if (!(event instanceof PointerEvent)) return;
  const target = document.elementFromPoint(event.clientX, event.clientY);
  if (!target) return;
  // A finger that was lifted can't be captured, and to try throws.
  for (const capture of CAPTURES) Object.defineProperty(target, capture, { value: () => {}, configurable: true });
  for (const type of ['pointerdown', 'pointerup', 'lostpointercapture', 'click']) {
    target.dispatchEvent(new PointerEvent(type, pressOf(event)));
  }
  for (const capture of CAPTURES) Reflect.deleteProperty(target, capture);
}

const CAPTURES = ['setPointerCapture', 'releasePointerCapture'];

/** A click says of no pointer that it is the primary one. */
function pressOf(event: PointerEvent): PointerEventInit {
  const { clientX, clientY, screenX, screenY, button, detail, pointerId, pointerType } = event;
  const { ctrlKey, shiftKey, altKey, metaKey } = event;
  return {
    bubbles: true,
    cancelable: true,
    composed: true,
    isPrimary: true,
    ...{ clientX, clientY, screenX, screenY, button, detail, pointerId, pointerType },
    ...{ ctrlKey, shiftKey, altKey, metaKey },
  };
}

/** Commands of the page that would otherwise open a dialog of the browser: open, save, find a command, duplicate. */
function isBrowserCommand({ key, ctrlKey, metaKey, altKey, shiftKey }: KeyboardEvent): boolean {
  // With Shift only saving is ours: others are the browser's, like its developer tools.
  return (ctrlKey || metaKey) && !altKey && (shiftKey ? /^s$/i : /^[oskd]$/i).test(key);
}
