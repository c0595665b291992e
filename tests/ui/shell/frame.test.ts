/** What index.html repeats, to be visible before any script, matches what the script would show. */
import { readFileSync } from 'node:fs';
import { describe, expect, it } from 'vitest';
import { MENUS } from '../../../src/ui/state/menus.ts';

const read = (path: string) => readFileSync(new URL(`../../../${path}`, import.meta.url), 'utf8');
const html = read('index.html');
const css = read('src/ui/styles/tokens.css');

function colours(selector: string, line: RegExp): ReadonlyMap<string, string> {
  const block = css.split(`${selector} {`)[1].split('}')[0];
  return new Map([...block.matchAll(line)].map(([, name, colour]) => [name, colour]));
}

const THEMES = {
  dark: [colours(':root[data-theme="dark"]', /--([\w-]+): (#\w+);/g), /--([\w-]+): light-dark\(#\w+, (#\w+)\);/g],
  light: [colours(':root[data-theme="light"]', /--([\w-]+): (#\w+);/g), /--([\w-]+): light-dark\((#\w+), #\w+\);/g],
} as const;

describe('the frame of the page before its script', () => {
  it('the frame of the page before its script has the titles of the menus', () => {
    expect([...html.matchAll(/<button type="button">(\w+)<\/button>/g)].map(([, title]) => title)).toEqual([...MENUS]);
  });

  it.each(['dark', 'light'] as const)(
    'has the colours of the %s theme, the browser bar that of the menu bar',
    (theme) => {
      const [own, early] = THEMES[theme];
      const before = colours(':root:not([data-theme])', early);
      expect(before.size).toBeGreaterThan(3);
      for (const [name, colour] of before) expect(`${name} ${colour}`).toBe(`${name} ${own.get(name)}`);
      expect(html).toContain(`media="(prefers-color-scheme: ${theme})" content="${own.get('surface')}"`);
    },
  );
});
