import { expect, it } from 'vitest';
import { noCauseText } from '../../../../src/ui/editors/compare/causes.ts';

it('where nothing explains the numbers, the joint to begin with is named only if joints were compared', () => {
  const nothing = 'No known mistake, nor two together, explains these numbers.';
  expect(noCauseText({ own: [3] })).toBe(`${nothing} Begin with the first joint that is wrong by itself.`);
  expect(noCauseText({ own: [] })).toBe(`${nothing} Begin with the first that differs.`);
});
