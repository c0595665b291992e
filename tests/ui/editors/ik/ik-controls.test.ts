import { expect, it } from 'vitest';
import { ikHintText } from '../../../../src/ui/editors/ik/ik-controls.ts';

/** Characters that fit beside the mode switch, in a window of 1440. */
const ROOM = 52;

it.each([0, 1, 6])('shows a hint in one line (%i pins)', (pins) => {
  const hint = ikHintText(pins);
  expect(hint).toContain(pins === 0 ? 'Click a hand, foot or joint to pin it' : 'Click a pin to remove it');
  expect(hint.length).toBeLessThanOrEqual(ROOM);
});
