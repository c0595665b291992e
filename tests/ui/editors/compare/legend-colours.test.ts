import { readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { expect, it } from 'vitest';
import { COMPARE_COLOURS } from '../../../../src/view/compare/compare-colours.ts';
import { STAGE_THEMES } from '../../../../src/view/theme.ts';

const CSS = readFileSync(
  fileURLToPath(new URL('../../../../src/ui/styles/compare/compare-legend.css', import.meta.url)),
  'utf8',
);

it('the legend of a comparison has the colours that are drawn, in both themes', () => {
  for (const [name, colour] of [
    ...(['agrees', 'own', 'inherited', 'stripe'] as const).map(
      (key) => [key, (theme: 'light' | 'dark') => COMPARE_COLOURS[theme][key]] as const,
    ),
    ['theirs', (theme: 'light' | 'dark') => STAGE_THEMES[theme].comparedFirst] as const,
  ]) {
    expect(CSS).toContain(`--compare-${name}: light-dark(${colour('light')}, ${colour('dark')});`);
  }
});
