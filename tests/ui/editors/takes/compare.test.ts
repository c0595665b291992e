import { expect, it } from 'vitest';
import { partText } from '../../../../src/ui/editors/takes/compare.ts';

it('one joint is compared, several are, and the same for those without a counterpart', () => {
  expect(partText(1, 52)).toBe(
    '1 joint is compared; 52 have no counterpart and are left out. To compare all, retarget one take onto the other character first.',
  );
  expect(partText(20, 1)).toBe('20 joints are compared; 1 has no counterpart and is left out.');
});
