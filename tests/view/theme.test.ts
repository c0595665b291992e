import { describe, expect, it } from 'vitest';
import { STAGE_THEMES, type StageTheme, type ThemeName } from '../../src/view/theme.ts';

/** WCAG 2.2, relative luminance. */
function luminance(css: string): number {
  const [r, g, b] = [1, 3, 5].map((i) => {
    const c = Number.parseInt(css.slice(i, i + 2), 16) / 255;
    return c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4;
  });
  return 0.2126 * r + 0.7152 * g + 0.0722 * b;
}

function contrast(a: string, b: string): number {
  const [low, high] = [luminance(a), luminance(b)].sort((x, y) => x - y);
  return (high + 0.05) / (low + 0.05);
}

const READ: readonly (keyof StageTheme)[] = [
  'axisX',
  'axisY',
  'axisZ',
  'moveX',
  'moveY',
  'moveZ',
  'label',
  'selectedLabel',
  'pin',
  'pinGap',
];
const NAMES: readonly ThemeName[] = ['light', 'dark'];
const CASES = NAMES.flatMap((name) => READ.map((part) => ({ name, part })));

describe('the colours of the viewport', () => {
  it.each(CASES)('$part reads on all of the $name background', ({ name, part }) => {
    const theme = STAGE_THEMES[name];
    for (const ground of [theme.backgroundTop, theme.horizon, theme.backgroundBottom, theme.labelHalo]) {
      expect(contrast(String(theme[part]), ground)).toBeGreaterThanOrEqual(4.5);
    }
  });
});
