import { readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { describe, expect, it } from 'vitest';
import { HEADERS, POLICY } from '../../plugins/policy.ts';

const HOSTING = readFileSync(fileURLToPath(new URL('../../docs/hosting.md', import.meta.url)), 'utf8');
const CONFIGURED = /^(?:add_header |Header always set | {2})([A-Z][\w-]+):? "?(.*?)"?(?: always;)?$/gm;

describe('the page’s policy', () => {
  it('allows no script or style that is text, and no address but those of files', () => {
    expect(POLICY).not.toMatch(/unsafe-inline|'unsafe-eval'|\*|data:/);
    expect(POLICY).toMatch(/^default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self';/);
  });

  it('the headers in docs/hosting.md are those that the tests’ server sends', () => {
    const blocks = [...HOSTING.matchAll(/```\w*\n(.*?)```/gs)].map(([, block]) => block);
    const found = blocks.map((block) =>
      Object.fromEntries([...block.matchAll(CONFIGURED)].map(([, name, value]) => [name, value])),
    );
    const told = found.filter((headers) => Object.keys(headers).length > 0);
    expect(told).toEqual([HEADERS, HEADERS, HEADERS]);
  });
});
