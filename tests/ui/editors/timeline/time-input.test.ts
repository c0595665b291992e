import { afterEach, expect, it, vi } from 'vitest';
import { DEFAULT_PLAYBACK } from '../../../../src/edit/playback.ts';
import { TimeInput } from '../../../../src/ui/editors/timeline/time-input.ts';
import { observable } from '../../../../src/ui/kit/observable.ts';
import { Timeline } from '../../../../src/ui/state/timeline.ts';

afterEach(() => vi.unstubAllGlobals());

/** A chart of that width, with what is asked of its workbench. */
function chartOf(width: number) {
  const transport = observable(DEFAULT_PLAYBACK);
  const timeline = new Timeline();
  timeline.change({ window: { from: 0, to: 10 } });
  const element = Object.assign(new EventTarget(), { getBoundingClientRect: () => ({ left: 0, top: 0 }) });
  const { range, framesPerSecond } = DEFAULT_PLAYBACK;
  new TimeInput(
    { transport, timeline },
    {
      // Of an element, only what is used of it here.
      element: element as unknown as HTMLElement,
      timeView: () => ({ window: timeline.view.get().window, width, range, framesPerSecond, inFrames: false }),
      scrubbedTime: (x) => x / width,
      fitAll: () => {},
      hoverAt: () => {},
    },
  );
  const send = (type: string, more: object) => element.dispatchEvent(Object.assign(new Event(type), more));
  return { transport, timeline, send };
}

it('a press or a wheel before the chart has its width changes neither time nor window', () => {
  const { transport, timeline, send } = chartOf(0);
  const before = [transport.get(), timeline.view.get()];
  send('pointerdown', { button: 0, clientX: 0, clientY: 0, pointerType: 'mouse', pointerId: 1 });
  send('wheel', { clientX: 0, clientY: 0, deltaX: 0, deltaY: 100, deltaMode: 0 });
  expect([transport.get(), timeline.view.get()]).toEqual(before);
});

it('a wheel zooms about the time below it', () => {
  const { timeline, send } = chartOf(500);
  vi.stubGlobal('WheelEvent', { DOM_DELTA_LINE: 1 });
  send('wheel', { clientX: 100, clientY: 0, deltaX: 0, deltaY: 100, deltaMode: 0 });
  const { from, to } = timeline.view.get().window;
  expect(to - from).toBeCloseTo(12, 9);
  expect(from + (to - from) / 5).toBeCloseTo(2, 9);
});
