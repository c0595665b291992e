import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { oncePerFrame } from '../../../src/ui/widgets/frame.ts';

let frames: ((now: number) => void)[] = [];
let log: string[] = [];

/** Runs the browser's next frame. */
function frame(now = 0): void {
  const due = frames;
  frames = [];
  for (const callback of due) callback(now);
}

const work = (name: string, phase?: 'advance' | 'show' | 'draw', then: () => void = () => {}) =>
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
});
