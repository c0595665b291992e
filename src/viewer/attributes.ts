/** What the attributes of an element say. They name what can't be, and do the rest. */
import { DISPLAY_WORDS, displayOfWords } from '../model/display-words.ts';
import type { Character } from '../model/document.ts';
import { DEFAULT_DISPLAY, type Display } from '../model/session.ts';
import type { CameraView } from '../view/camera/camera.ts';
import { numbersIn, viewOf } from '../view/camera/view-numbers.ts';

export const ATTRIBUTES = [
  'src',
  'take',
  'time',
  'loop',
  'controls',
  'speed',
  'show',
  'follow',
  'camera',
  'background',
  'poster',
  'alt',
] as const;
export type AttributeName = (typeof ATTRIBUTES)[number];

/** Takes what can't be: `speed="fast" (expected a number)`. */
export type Tell = (wrong: string) => void;

/** Addresses, with blanks between. */
export function addressesIn(text: string): readonly string[] {
  return text.split(/\s+/).filter((address) => address !== '');
}

/** A number; undefined if there is none. */
export function numberOf(name: AttributeName, text: string | null, tell: Tell): number | undefined {
  if (text === null) return undefined;
  const [value] = numbersIn(text, 1) ?? [];
  if (value === undefined) tell(`${name}="${text}" (expected a number)`);
  return value;
}

export function displayOf(text: string | null, tell: Tell): Display {
  if (text === null) return DEFAULT_DISPLAY;
  const patch = displayOfWords(text.trim().replaceAll(/[\s,]+/g, ','));
  if (!patch) tell(`show="${text}" (expected ${DISPLAY_WORDS.join(', ')})`);
  return { ...DEFAULT_DISPLAY, ...patch };
}

/** Undefined: all of it, from the front. */
export function cameraOf(text: string | null, tell: Tell): CameraView | undefined {
  if (text === null) return undefined;
  const view = viewOf(numbersIn(text, 6));
  if (!view) tell(`camera="${text}" (expected six numbers: the position, and another one that it looks at)`);
  return view;
}

/** The characters with the take of a name shown, those that have it. */
export function showingTake(characters: readonly Character[], name: string | null, tell: Tell): readonly Character[] {
  if (name === null) return characters;
  const indexIn = ({ takes }: Character) => takes.findIndex((take) => take.name === name);
  if (!characters.some((character) => indexIn(character) >= 0)) {
    const known = [...new Set(characters.flatMap(({ takes }) => takes.map((take) => take.name)))];
    tell(`take="${name}" (expected ${known.join(', ') || 'none, for there are no takes'})`);
  }
  return characters.map((character) => {
    const take = indexIn(character);
    return take < 0 ? character : { ...character, shownTake: take };
  });
}
