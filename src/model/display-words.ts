/** A display in words, as links and the element of other pages say it: `skin,names`. */
import { DEFAULT_DISPLAY, type Display } from './session.ts';

/** Each word, and what it changes; of skins and boxes, the first is what `skin` and `boxes` mean. */
const WORDS: ReadonlyMap<string, Partial<Display>> = new Map<string, Partial<Display>>([
  ['nothing', {}],
  ['skin', { skin: 'textured' }],
  ...(['solid', 'wire', 'xray', 'heat', 'four'] as const).map((skin) => [skin, { skin }] as const),
  ['boxes', { boxes: 'solid' }],
  ['bare-boxes', { boxes: 'bare' }],
  ['wire-boxes', { boxes: 'wire' }],
  ['bones', { bones: true }],
  ['axes', { axes: true }],
  ['names', { names: true }],
  ['normals', { normals: true }],
  ['no-character-names', { characterNames: false }],
  ['no-grid', { grid: false }],
  ['no-shadow', { shadow: false }],
  ['floor-at-zero', { floorAtLowest: false }],
  ['orthographic', { orthographic: true }],
  ['path', { trail: true }],
  ['ghosts', { ghosts: true }],
  ['in-place', { inPlace: true }],
]);

/** The display with nothing of the character, and what any page has around it. */
const NOTHING: Partial<Display> = Object.fromEntries(
  [...new Set([...WORDS.values()].flatMap((patch) => Object.keys(patch)))].map((name) => [
    name,
    name === 'skin' || name === 'boxes' ? 'hidden' : DEFAULT_DISPLAY[name as keyof Display],
  ]),
);

/** The words for a display. */
export function wordsOf(display: Display): readonly string[] {
  const isSo = (patch: Partial<Display>) =>
    Object.entries(patch).every(([name, value]) => display[name as keyof Display] === value);
  const words = [...WORDS].filter(([word, patch]) => word !== 'nothing' && isSo(patch)).map(([word]) => word);
  return words.length > 0 ? words : ['nothing'];
}

/** All words. */
export const DISPLAY_WORDS: readonly string[] = [...WORDS.keys()];

/** The display of some words, with commas or `|` between; undefined if one is none of them. */
export function displayOfWords(text: string): Partial<Display> | undefined {
  const patches = text.split(/[,|]/).map((word) => WORDS.get(word.trim()));
  return patches.every((patch) => patch !== undefined) ? Object.assign({ ...NOTHING }, ...patches) : undefined;
}
