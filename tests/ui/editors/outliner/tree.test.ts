import { expect, it } from 'vitest';
import { rowTyped } from '../../../../src/ui/editors/outliner/tree.ts';

const rows = ['root', 'hips', 'leg_l', 'leg_r', 'spine', 'Head', ''].map((label) => ({ label }));

it('typed letters go to the next row whose name begins with them', () => {
  expect(rowTyped(rows, 0, 'l')).toBe(2);
  expect(rowTyped(rows, 0, 'h')).toBe(1);
  expect(rowTyped(rows, 1, 'hea')).toBe(5);
  expect(rowTyped(rows, 2, 'leg_')).toBe(2);
  expect(rowTyped(rows, 2, 'leg_r')).toBe(3);
});

it('the same letter again goes on to the next match, and round', () => {
  expect(rowTyped(rows, 2, 'll')).toBe(3);
  expect(rowTyped(rows, 3, 'lll')).toBe(2);
});

it('letters that no name begins with go nowhere', () => {
  expect(rowTyped(rows, 2, 'x')).toBe(-1);
  expect(rowTyped([], 0, 'x')).toBe(-1);
});
