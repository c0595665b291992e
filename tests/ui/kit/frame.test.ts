import { describe, expect, it } from 'vitest';
import { isTimeAgain } from '../../../src/ui/kit/frame.ts';

describe('what is shown less often than there are frames', () => {
  it('what is shown less often than there are frames is shown at once, then after each interval, whatever the frame rate', () => {
    let time = 1000;
    const isDue = isTimeAgain(25, () => time);
    const frames = [0, 16, 17, 16, 1, 30].map((step) => {
      time += step;
      return isDue();
    });
    expect(frames).toEqual([true, false, true, false, false, true]);
  });
});
