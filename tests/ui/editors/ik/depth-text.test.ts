import { expect, it } from 'vitest';
import { depthText } from '../../../../src/ui/editors/ik/depth-text.ts';
import { character } from '../../builders.ts';

it('shows the depth of a drag in the unit of its character', () => {
  expect(depthText(character({}), 0.23)).toBe('depth +0.230 units');
  expect(depthText(character({}), -1.5)).toBe('depth −1.500 units');
  expect(depthText(character({}), -1e-9)).toBe('depth 0.000 units');
});
