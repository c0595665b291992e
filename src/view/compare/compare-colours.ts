/**
 * Colours of what is compared with another program's numbers. What differs is told without its hue too: wrong joints
 * are thicker, and those that are wrong only because a parent is are hatched, light and dark.
 */
import { STAGE_THEMES, type StageTheme, type ThemeName } from '../theme.ts';

export interface CompareColours {
  /** Joints that agree, lit. */
  readonly agrees: string;
  /** Joints whose own matrix is wrong, and the worst vertex. */
  readonly own: string;
  /** Stripes of joints that are wrong because a parent is. */
  readonly inherited: string;
  readonly stripe: string;
}

export const COMPARE_COLOURS: Readonly<Record<ThemeName, CompareColours>> = {
  dark: { agrees: '#8b939b', own: '#ff5a4f', inherited: '#ffbe6b', stripe: '#6e3508' },
  light: { agrees: '#8a949f', own: '#c8201a', inherited: '#ffd096', stripe: '#b84a00' },
};

export function compareColours(theme: StageTheme): CompareColours {
  return COMPARE_COLOURS[theme === STAGE_THEMES.light ? 'light' : 'dark'];
}
