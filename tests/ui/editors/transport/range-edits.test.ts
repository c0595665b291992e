import { expect, it } from 'vitest';
import { rangeText, typeRange } from '../../../../src/ui/editors/transport/range-edits.ts';
import { workbench } from '../../builders.ts';

it('refuses a reversed range, in the unit in which it was typed', () => {
  const { wb } = workbench();
  wb.transport.update((p) => ({ ...p, framesPerSecond: 24 }));
  const { range } = wb.transport.get();
  const said = () => wb.messages.list.get().at(-1)?.text;
  typeRange(wb, [2, 1 / 3]);
  expect(said()).toBe('A range that starts at 2 s can’t end at 0.333 s.');
  wb.settings.update((s) => ({ ...s, timeDisplay: 'frames' }));
  typeRange(wb, [2, 0.5]);
  expect(said()).toBe('A range that starts at frame 48 can’t end at frame 12.');
  expect(wb.transport.get().range).toBe(range);
});

it('tells the range that a key has changed with both its ends, in the unit of times', () => {
  const { wb } = workbench();
  wb.transport.update((p) => ({ ...p, framesPerSecond: 24, range: [0, 2.5] }));
  expect(rangeText(wb)).toBe('Range 0 s to 2.5 s');
  wb.settings.update((s) => ({ ...s, timeDisplay: 'frames' }));
  expect(rangeText(wb)).toBe('Range frame 0 to frame 60');
});
