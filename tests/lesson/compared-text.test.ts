import { expect, it } from 'vitest';
import { beginText } from '../../src/lesson/compared-text.ts';

it('where nothing explains the numbers, the joint to begin with is named only if joints were compared', () => {
  expect(beginText({ own: [3] })).toBe('Begin with the first joint that is wrong by itself.');
  expect(beginText({ own: [] })).toBe('Begin with the first that differs.');
});
