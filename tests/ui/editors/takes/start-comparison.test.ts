import { expect, it } from 'vitest';
import { partText } from '../../../../src/ui/editors/takes/start-comparison.ts';

it('one joint is compared, several are, and the same for those without a counterpart', () => {
  expect(partText(1, 52)).toBe('1 joint is compared, matched by name and body part; 52 have no matching joint.');
  expect(partText(20, 1)).toBe('20 joints are compared, matched by name and body part; 1 has no matching joint.');
  expect(partText(20, 0)).toBe('20 joints are compared, matched by name and body part.');
});
