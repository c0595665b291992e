/** What is behind the characters, and whether they are drawn for light or for dark. */
import type { ThemeName } from '../view/theme.ts';
import type { Tell } from './attributes.ts';

export interface Background {
  readonly theme: ThemeName;
  /** Of the workbench; otherwise `colour` is. */
  readonly isStage: boolean;
  /** CSS; empty: what the page has behind the element. */
  readonly colour: string;
}

/** @param text `light`, `dark`, `none`, or a colour; null: as the page is */
export function backgroundOf(text: string | null, host: HTMLElement, tell: Tell): Background {
  if (text === 'light' || text === 'dark') return { theme: text, isStage: true, colour: '' };
  const theme = themeOf(host);
  if (text === null) return { theme, isStage: true, colour: '' };
  if (text === 'none') return { theme, isStage: false, colour: '' };
  const light = lightnessOf(text);
  if (light === undefined) tell(`background="${text}" (expected light, dark, none, or a colour)`);
  return light === undefined
    ? { theme, isStage: true, colour: '' }
    : { theme: light > 0.5 ? 'light' : 'dark', isStage: false, colour: text };
}

/** Of a page that says it has both, the one that is wished for; a page that says nothing is light. */
function themeOf(host: HTMLElement): ThemeName {
  const { colorScheme } = getComputedStyle(host);
  if (!colorScheme.includes('dark')) return 'light';
  if (!colorScheme.includes('light')) return 'dark';
  return matchMedia('(prefers-color-scheme: dark)').matches ? 'dark' : 'light';
}

/** 0 to 1; undefined if it is no colour. */
function lightnessOf(colour: string): number | undefined {
  const canvas = document.createElement('canvas');
  canvas.width = canvas.height = 1;
  const pen = canvas.getContext('2d');
  if (!pen || !CSS.supports('color', colour)) return undefined;
  pen.fillStyle = colour;
  pen.fillRect(0, 0, 1, 1);
  const [red, green, blue] = pen.getImageData(0, 0, 1, 1).data;
  return (0.3 * red + 0.59 * green + 0.11 * blue) / 255;
}
