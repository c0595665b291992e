import { describe, expect, it, vi } from 'vitest';
import { timesOnPath } from '../../../src/evaluate/ik/path-dofs.ts';
import { Trail } from '../../../src/view/motion/trail.ts';
import { channelOf } from '../../edit/keys/channels.ts';
import { swing, swinging } from '../../edit/samples/made.ts';
import { character, skeleton, takeOfValues } from '../../helpers/builders.ts';

/** The second joint, half a second late on the timeline, has keys at three times; the root at a fourth. */
const moving = character({
  skeleton: skeleton(2),
  timeOffsetSeconds: 0.5,
  takes: [
    {
      ...takeOfValues('walk', []),
      range: [0, 2],
      framesPerSecond: 10,
      channels: Array.from({ length: 9 }, (_, d) =>
        channelOf(
          d < 3
            ? [[0.7, 1]]
            : d === 6
              ? [
                  [0, 0],
                  [1, 1],
                  [1.25, 0],
                ]
              : [[0, 0]],
        ),
      ),
    },
  ],
  shownTake: 0,
});

describe('marks on a motion path', () => {
  it('are at whole frames in the range, and at the keys of the limb', () => {
    const { frames, keys, isSampled } = timesOnPath(moving, 1, [0, 1], 100);
    expect(isSampled).toBe(false);
    expect(frames).toEqual([0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1].map((t) => expect.closeTo(t, 12)));
    expect(keys).toEqual([0.5, 0.75]);
  });

  it('of the root are at the keys of its translation', () => {
    expect(timesOnPath(moving, 0, [0, 1], 100).keys).toEqual([expect.closeTo(0.2, 12)]);
  });

  it('of a capture are frames, which can be dragged', () => {
    const captured = swinging();
    const trail = new Trail();
    trail.show(captured, 2, [0.25, 0.75], false);
    expect(trail.held?.times).toHaveLength(31);
    expect(trail.held?.places).toHaveLength(93);
    expect(timesOnPath(captured, 2, swing.range, 100)).toEqual({ frames: [], keys: [], isSampled: true });
  });

  it('there are none on the path of what follows another character, or is empty', () => {
    const { takes } = moving;
    const driver = { source: { take: takes[0] } } as never;
    expect(timesOnPath({ ...moving, driver }, 1, [0, 1], 100).keys).toEqual([]);
    expect(timesOnPath({ ...moving, takes: [], shownTake: -1 }, 1, [0, 1], 100).frames).toEqual([]);
  });

  it('one lights up and goes out again, and a new path has none lit that it lacks', () => {
    const redraw = vi.fn();
    const trail = new Trail(redraw);
    trail.show(moving, 1, [0, 1], false);
    expect(trail.held?.times).toEqual([0.5, 0.75]);
    trail.light(1);
    trail.light(1);
    expect(redraw).toHaveBeenCalledTimes(1);
    trail.show(moving, 1, [0, 0.6], false);
    trail.light(undefined);
    expect(redraw).toHaveBeenCalledTimes(1);
    trail.show(undefined, undefined, undefined, false);
    expect(trail.held).toBeUndefined();
    trail.dispose();
  });
});
