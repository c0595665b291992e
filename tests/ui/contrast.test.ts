/** Text, and everything distinguished by colour alone, has a contrast of 4.5:1 in both themes (WCAG 2.2, 1.4.3). */
import { readFileSync } from 'node:fs';
import { describe, expect, it } from 'vitest';

const css = readFileSync(new URL('../../src/ui/styles/tokens.css', import.meta.url), 'utf8');

const states = readFileSync(new URL('../../src/ui/styles/states.css', import.meta.url), 'utf8');

function tokens(theme: 'dark' | 'light', from = css): Map<string, string> {
  const block = from.split(`[data-theme="${theme}"] {`)[1].split('}')[0];
  return new Map([...block.matchAll(/(--[\w-]+):\s*(#[0-9a-f]{6})\b/g)].map(([, name, value]) => [name, value]));
}

/** Relative luminance of `#rrggbb`. */
function luminance(colour: string): number {
  const [r, g, b] = [1, 3, 5].map((at) => {
    const c = Number.parseInt(colour.slice(at, at + 2), 16) / 255;
    return c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4;
  });
  return 0.2126 * r + 0.7152 * g + 0.0722 * b;
}

function contrast(a: string, b: string): number {
  const [low, high] = [luminance(a), luminance(b)].sort((x, y) => x - y);
  return (high + 0.05) / (low + 0.05);
}

const TEXTS = [
  'text',
  'text-faint',
  'accent',
  'selected',
  'axis-x',
  'axis-y',
  'axis-z',
  'move-x',
  'move-y',
  'move-z',
  'error',
  'warning',
  'info',
];
const GROUNDS = ['ground', 'surface', 'raised', 'field', 'plot'];
const PAIRS: readonly (readonly [string, string])[] = [
  ...TEXTS.flatMap((text) => GROUNDS.map((ground) => [text, ground] as const)),
  ['text', 'hover'],
  ['text-faint', 'hover'],
  ['on-accent', 'accent'],
  ['selected', 'selected-quiet'],
  ['text', 'accent-quiet'],
  ['text', 'range'],
  ['text-faint', 'range'],
  ['key', 'range'],
  ...['axis', 'move'].flatMap((kind) => ['x', 'y', 'z'].map((axis) => [`${kind}-${axis}`, 'outside'] as const)),
];

describe.each(['dark', 'light'] as const)('the %s theme', (theme) => {
  const colours = tokens(theme);

  it.each(PAIRS)('%s is readable on %s', (text, ground) => {
    const [above, below] = [text, ground].map((name) => colours.get(`--${name}`) ?? '');
    expect(contrast(above, below)).toBeGreaterThanOrEqual(4.5);
  });

  it.each(['surface', 'ground', 'raised'])(
    'shows the focus ring and the outline of a pressed toggle on %s',
    (ground) => {
      const ratio = contrast(colours.get('--accent') ?? '', colours.get(`--${ground}`) ?? '');
      expect(ratio).toBeGreaterThanOrEqual(3);
    },
  );

  it.each(GROUNDS)('has lines and text of more contrast on %s where the system asks for it', (ground) => {
    const more = tokens(theme, states);
    const on = (name: string) => contrast(more.get(`--${name}`) ?? '', colours.get(`--${ground}`) ?? '');
    expect(on('text')).toBeGreaterThanOrEqual(10);
    expect(on('text-faint')).toBeGreaterThanOrEqual(7);
    expect(on('line')).toBeGreaterThanOrEqual(3);
    expect(on('line-strong')).toBeGreaterThanOrEqual(4.5);
  });
});
