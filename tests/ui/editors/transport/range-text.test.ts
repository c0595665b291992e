import { expect, it } from 'vitest';
import { rangeText } from '../../../../src/ui/editors/transport/range-text.ts';
import { workbench } from '../../builders.ts';

it('tells the range that a key has changed with both its ends, in the unit of times', () => {
  const { wb } = workbench();
  wb.transport.update((p) => ({ ...p, framesPerSecond: 24, range: [0, 2.5] }));
  expect(rangeText(wb)).toBe('Range 0 s to 2.5 s');
  wb.settings.update((s) => ({ ...s, timeDisplay: 'frames' }));
  expect(rangeText(wb)).toBe('Range frame 0 to frame 60');
});
