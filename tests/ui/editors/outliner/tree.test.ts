import { expect, it } from 'vitest';
import { indentOf } from '../../../../src/ui/editors/outliner/tree.ts';

it('a row of the tree is indented more than its parent, and never leaves the panel', () => {
  for (let depth = 1; depth <= 30; depth++) expect(indentOf(depth)).toBeGreaterThan(indentOf(depth - 1));
  expect(indentOf(0)).toBe(0);
  expect(indentOf(10)).toBeLessThan(90);
  expect(indentOf(5000)).toBeLessThan(140);
});
