/** What is being typed: whether a field was changed since it got the focus, and whether a key belongs to a word. */
import { isTextField } from './focus.ts';

/** Marks a number field that gets the focus with a tool, unasked. */
export const OFFERED = 'data-offered';

let typedIn: EventTarget | null | undefined;

/** Characters typed within this time of each other belong together; milliseconds. */
const TYPING_MS = 1000;
/** When the last character was typed into a field or a list; milliseconds. */
let typedAt = Number.NEGATIVE_INFINITY;

/** Tracks typing in fields until aborted. */
export function watchTyping(signal: AbortSignal): void {
  const options = { capture: true, signal };
  window.addEventListener('focusin', () => (typedIn = undefined), options);
  // Of a shadow tree, the field in it.
  window.addEventListener('input', (event) => (typedIn = event.composedPath()[0]), options);
  window.addEventListener(
    'keydown',
    (event) => {
      // Enter, Escape and Tab end a word; a modifier alone doesn't.
      if (!isCharacter(event)) typedAt = MODIFIER.test(event.key) ? typedAt : Number.NEGATIVE_INFINITY;
      else if (event.target instanceof Element && isTextField(event.target) && !passes(event.target, event)) {
        noteTyped(event);
      }
    },
    options,
  );
  window.addEventListener('pointerdown', () => (typedAt = Number.NEGATIVE_INFINITY), options);
}
const MODIFIER = /^(Shift|AltGraph|Alt|Control|Meta|CapsLock|Dead)$/;

/** A list goes to its rows by what is typed: until a pause, characters are text. */
export function noteTyped({ timeStamp }: Pick<Event, 'timeStamp'>): void {
  typedAt = timeStamp;
}

/**
 * Whether a key types on what was begun in a field or a list. While that has the focus it uses the key itself; if it
 * has vanished meanwhile, the rest of a word would run commands.
 */
export function continuesTyping(event: TypedKey): boolean {
  const continues = isCharacter(event) && event.timeStamp - typedAt <= TYPING_MS;
  if (continues) noteTyped(event);
  return continues;
}

type TypedKey = Pick<KeyboardEvent, 'key' | 'ctrlKey' | 'metaKey' | 'altKey' | 'timeStamp'>;

/** Whether it types a character. */
export function isCharacter({ key, ctrlKey, metaKey, altKey }: TypedKey): boolean {
  // AltGr types characters, and browsers report it as Ctrl+Alt.
  return [...key].length === 1 && !metaKey && ctrlKey === altKey;
}

/**
 * Whether a key is the page's though a field has the focus: until a number is begun in a field that was offered, Space
 * plays, arrows step frames, and letters are shortcuts.
 */
export function passes(field: Element, { key, ctrlKey, metaKey }: Pick<KeyboardEvent, 'key' | 'ctrlKey' | 'metaKey'>) {
  if (!field.hasAttribute(OFFERED) || isTypedIn(field) || ctrlKey || metaKey) return false;
  return NO_NUMBER.test(key);
}
const NO_NUMBER = /^(?:\s|\p{L}|ArrowLeft|ArrowRight)$/u;

/** Whether something was typed in this field since it got the focus. */
export function isTypedIn(field: Element): boolean {
  return typedIn === field;
}
