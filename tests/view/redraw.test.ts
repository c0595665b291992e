import { beforeEach, expect, it } from 'vitest';
import { Redraw } from '../../src/view/redraw.ts';

let frames: number;
let drawn: number;
let failures: unknown[];
let broken: Error | undefined;
let frame: () => void;
let redraw: Redraw;
beforeEach(() => {
  frames = drawn = 0;
  failures = [];
  broken = undefined;
  redraw = new Redraw(
    (draw) => {
      frame = () => draw(0);
      return () => void frames++;
    },
    () => {
      if (broken) throw broken;
      drawn++;
    },
    (error) => failures.push(error),
  );
});

it('draws once in a frame, however often that was requested, and not in one that nobody asked for', () => {
  redraw.request();
  redraw.request();
  frame();
  frame();
  expect(drawn).toBe(1);
  redraw.request();
  frame();
  expect(drawn).toBe(2);
});

it('leaves the next frame nothing to draw if that was done at once', () => {
  redraw.request();
  redraw.tryNow(0);
  frame();
  expect(drawn).toBe(1);
});

it('tells once that a picture fails, and tries again when there is another one', () => {
  broken = new Error('no shader');
  for (let i = 0; i < 3; i++) {
    redraw.request();
    frame();
  }
  expect(failures).toEqual([broken]);
  broken = undefined;
  redraw.request();
  frame();
  expect(drawn).toBe(0);
  redraw.retry();
  redraw.request();
  frame();
  expect(drawn).toBe(1);
});

it('throws to whoever draws a picture of their own, also after a failure', () => {
  redraw.fail(new Error('no character'));
  redraw.now(0);
  expect(drawn).toBe(1);
  broken = new Error('no shader');
  expect(() => redraw.now(0)).toThrow('no shader');
  expect(failures).toHaveLength(1);
});

it('asks for no frame and draws none once it has ended', () => {
  redraw.request();
  redraw.end();
  frame();
  redraw.request();
  redraw.now(0);
  expect([frames, drawn]).toEqual([1, 0]);
});

it('draws what is requested while a frame is prepared with that frame', () => {
  redraw.request();
  redraw.include();
  frame();
  expect(drawn).toBe(0);
  redraw.request();
  frame();
  expect(drawn).toBe(1);
});
