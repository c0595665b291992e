import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { type FramePhase, oncePerFrame } from '../../../src/ui/widgets/frame.ts';

let frames: ((now: number) => void)[] = [];
let log: string[] = [];

/** Runs the browser's next frame. */
function frame(now = 0): void {
  const due = frames;
  frames = [];
  for (const callback of due) callback(now);
}

const work = (name: string, phase?: FramePhase, then: () => void = () => {}) =>
  oncePerFrame(() => {
    log.push(name);
    then();
  }, phase);

beforeEach(() => {
  frames = [];
  log = [];
  vi.stubGlobal('requestAnimationFrame', (callback: (now: number) => void) => frames.push(callback));
});
afterEach(() => void vi.unstubAllGlobals());

describe('a frame of the page', () => {
  it('a frame of the page advances, shows and draws, whatever the order of the requests, with one of the browser’s', () => {
    const draw = work('draw', 'draw');
    const show = work('show');
    const advance = work('advance', 'advance');
    for (const request of [draw, show, draw, advance, show]) request();
    expect(frames).toHaveLength(1);
    frame();
    expect(log).toEqual(['advance', 'show', 'draw']);
    expect(frames).toHaveLength(0);
  });

  it('a frame of the page runs what is requested for a later phase, and the next one what is for the same or an earlier', () => {
    const draw = work('draw', 'draw');
    const advance = work('advance', 'advance', () => {
      if (log.length > 1) return;
      draw();
      show();
    });
    const show = work('show', 'show', () => {
      if (log.length > 2) return;
      advance();
      show();
    });
    advance();
    frame();
    expect(log).toEqual(['advance', 'show', 'draw']);
    expect(frames).toHaveLength(1);
    frame();
    expect(log.slice(3)).toEqual(['advance', 'show']);
    expect(frames).toHaveLength(0);
  });

  it('a frame of the page takes the time of the browser’s frame', () => {
    const times: number[] = [];
    const request = oncePerFrame((now) => times.push(now));
    for (const now of [16, 33]) {
      request();
      frame(now);
    }
    expect(times).toEqual([16, 33]);
  });

  it('a frame of the page in which something throws runs the rest in the next', () => {
    const failing = work('failing', 'show', () => {
      throw new Error('no');
    });
    const show = work('show');
    const draw = work('draw', 'draw');
    for (const request of [draw, failing, show]) request();
    expect(() => frame()).toThrow('no');
    frame();
    expect(log).toEqual(['failing', 'show', 'draw']);
    expect(frames).toHaveLength(0);
  });

  it('a frame of the page shows numbers in one of ten, ten times a second at most, each second if frames are slow, all in the same one', () => {
    const first = work('first', 'number');
    const second = work('second', 'number');
    const at: string[] = [];
    // Of browsers that draw 60, 240 and 5 times a second, one after the other.
    let now = 1e6;
    for (const step of [1000 / 60, 1000 / 240, 200]) {
      for (let i = 0; i < 100; i++) {
        first();
        if (i % 3 === 0) second();
        log = [];
        now += step;
        frame(now);
        if (log.length > 0) at.push(`${Math.round(step)} ${i}`);
        expect(['', 'first', 'first,second', 'second,first']).toContain(log.join());
      }
    }
    const frames60 = at.filter((text) => text.startsWith('17 '));
    expect(frames60).toEqual(['17 0', '17 10', '17 20', '17 30', '17 40', '17 50', '17 60', '17 70', '17 80', '17 90']);
    // 24 frames of 240 are 100 ms.
    expect(at.filter((text) => text.startsWith('4 '))).toHaveLength(4);
    // Of 20 seconds.
    expect(at.filter((text) => text.startsWith('200 '))).toHaveLength(20);
    // What was asked for last is shown, though nothing asks any more.
    while (frames.length > 0) {
      log = [];
      now += 16;
      frame(now);
    }
    expect(log).toContain('first');
  });
});
