import { expect, it } from 'vitest';
import { beginText } from '../../src/teaching/compare/compared-text.ts';

it('where nothing explains the numbers, the joint to begin with is named only if joints were compared', () => {
  expect(beginText({ own: [3] })).toBe('Start with the first joint with an error of its own.');
  expect(beginText({ own: [] })).toBe('Start with the first one that differs.');
});
