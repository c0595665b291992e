import { describe, expect, it } from 'vitest';
import { videoFrames } from '../../src/edit/video-frames.ts';

const framesOf = (more: Partial<Parameters<typeof videoFrames>[0]>) => {
  const { count, timeOf } = videoFrames({ range: [1, 2], rate: 1, loop: 'once', framesPerSecond: 4, ...more });
  return Array.from({ length: count }, (_, i) => timeOf(i));
};

describe('the frames of a video', () => {
  it('the frames of a video cover both ends of a range, or only the first of one that loops', () => {
    expect(framesOf({})).toEqual([1, 1.25, 1.5, 1.75, 2]);
    expect(framesOf({ loop: 'loop' })).toEqual([1, 1.25, 1.5, 1.75]);
    expect(framesOf({ range: [1, 1.9] })).toEqual([1, 1.25, 1.5, 1.75]);
    expect(framesOf({ range: [1, 1.9], loop: 'loop' })).toEqual([1, 1.25, 1.5, 1.75]);
  });

  it('the frames of a video follow speed and direction', () => {
    expect(framesOf({ rate: 2 })).toEqual([1, 1.5, 2]);
    expect(framesOf({ rate: -1, loop: 'loop' })).toEqual([2, 1.75, 1.5, 1.25]);
    expect(framesOf({ rate: 0.5, loop: 'loop' })).toHaveLength(8);
  });

  it('the frames of a video are not one too many where a range ends on a frame but for rounding', () => {
    expect(framesOf({ range: [0, 0.1 + 0.2], framesPerSecond: 10, loop: 'loop' })).toHaveLength(3);
    expect(framesOf({ range: [0, 0.7], framesPerSecond: 30, loop: 'pingpong' })).toHaveLength(22);
    expect(framesOf({ range: [3, 3] })).toEqual([3]);
    expect(framesOf({ range: [3, 3], loop: 'loop' })).toEqual([3]);
  });
});
