import { afterEach, expect, it, vi } from 'vitest';
import { DEFAULT_PLAYBACK } from '../../../../src/edit/playback.ts';
import { SheetPointer, type SheetPointerHost } from '../../../../src/ui/editors/dope/pointer.ts';
import { TimeInput } from '../../../../src/ui/editors/timeline/time-input.ts';
import { Timeline } from '../../../../src/ui/state/timeline.ts';
import { observable } from '../../../../src/ui/widgets/observable.ts';

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
  send('wheel', { clientX: 100, clientY: 0, deltaX: 0, deltaY: 60, deltaMode: 0 });
  const { from, to } = timeline.view.get().window;
  expect(to - from).toBeCloseTo(11.5, 9);
  expect(from + (to - from) / 5).toBeCloseTo(2, 9);
});

it('a wheel with and without Ctrl, Shift and Alt looks at the same times in charts and in the dope sheet', () => {
  const window = { from: 0, to: 10 };
  const target = Object.assign(new EventTarget(), { getBoundingClientRect: () => ({ left: 0, top: 0 }) });
  let seen = window;
  let scrolled = 0;
  const host = {
    sheet: () => ({ window: seen, width: 500, height: 200, rowHeight: 20, rowCount: 3, scrollTop: 0 }),
    look(next: typeof window) {
      seen = next;
    },
    scrollBy(pixels: number) {
      scrolled += pixels;
    },
  };
  // Of an element and of the sheet, only what a wheel uses.
  new SheetPointer(target as unknown as HTMLElement, host as unknown as SheetPointerHost);
  const chart = chartOf(500);
  const wheel = { clientX: 100, clientY: 50, deltaX: 0, deltaY: 60, deltaMode: 0 };
  for (const held of [{}, { ctrlKey: true }, { shiftKey: true }, { deltaX: 90 }]) {
    chart.send('wheel', { ...wheel, ...held });
    target.dispatchEvent(Object.assign(new Event('wheel'), wheel, held));
    expect(seen).toEqual(chart.timeline.view.get().window);
  }
  expect([seen.to - seen.from > 12, scrolled]).toEqual([true, 0]);
  target.dispatchEvent(Object.assign(new Event('wheel'), wheel, { altKey: true }));
  expect([seen, scrolled]).toEqual([chart.timeline.view.get().window, 60]);
});
