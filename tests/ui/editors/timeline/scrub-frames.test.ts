import { expect, it } from 'vitest';
import { scrubFrames } from '../../../../src/ui/editors/timeline/scrub-frames.ts';
import { snapTime } from '../../../../src/ui/widgets/time/time-window.ts';
import { workbench } from '../../builders.ts';

it('a scrubbed time snaps to whole frames as it is set for keys, however time is shown, and Shift inverts that', () => {
  const { wb } = workbench(undefined, { framesPerSecond: 30 });
  const frameOf = (shift: boolean) => 30 * snapTime(1.0031, 0.001, scrubFrames(wb, shift));
  for (const timeDisplay of ['seconds', 'frames'] as const) {
    wb.settings.update((s) => ({ ...s, timeDisplay }));
    wb.timeline.change({ snapsToFrames: true });
    expect([frameOf(false), frameOf(true)]).toEqual([30, expect.closeTo(30.09, 9)]);
    wb.timeline.change({ snapsToFrames: false });
    expect([frameOf(false), frameOf(true)]).toEqual([expect.closeTo(30.09, 9), 30]);
  }
});
