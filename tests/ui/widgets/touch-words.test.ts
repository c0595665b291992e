import { expect, it } from 'vitest';
import { tapping } from '../../../src/ui/widgets/touch-words.ts';

it('instructions for a touch screen have taps and the key button, and no keys', () => {
  expect(tapping('Click a point to pin it.')).toBe('Tap a point to pin it.');
  expect(tapping('Press K to key it')).toBe('Tap ◆ to key it');
  expect(tapping('Rotate a joint and press K to key it or Shift+K to key the whole pose, or drop a file.')).toBe(
    'Rotate a joint and tap ◆ to key it, or drop a file.',
  );
});
