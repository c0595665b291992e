/** Frames as an animated GIF that loops, each with its own palette of 256 colours, by gifenc. Loaded on first use. */
import { applyPalette, GIFEncoder, quantize } from 'gifenc';
import type { FrameCanvas, FrameWriter } from './frame-writer.ts';

/** Milliseconds of the format's unit of time. */
const UNIT = 10;
/** Programs take shorter delays for mistakes, and play those frames slowly. */
const MAX_FPS = 50;

export function gifWriter({ canvas, pen }: FrameCanvas, framesPerSecond: number): FrameWriter {
  if (framesPerSecond > MAX_FPS) {
    throw new Error(
      `A GIF plays at most ${MAX_FPS} frames per second, found ${framesPerSecond}. Lower the frame rate.`,
    );
  }
  const { width, height } = canvas;
  const encoder = GIFEncoder();
  let frame = 0;
  return {
    async add() {
      const { data } = pen.getImageData(0, 0, width, height);
      const palette = quantize(data, 256);
      const delay = delayOf(frame++, framesPerSecond);
      encoder.writeFrame(applyPalette(data, palette), width, height, { palette, delay });
    },
    async end() {
      encoder.finish();
      return new Blob([encoder.bytes()], { type: 'image/gif' });
    },
    async cancel() {},
  };
}

/** Milliseconds until the next frame, in whole units: rounded so that all of them together are not off. */
export function delayOf(frame: number, framesPerSecond: number): number {
  const ends = (n: number) => Math.round((1000 * n) / framesPerSecond / UNIT);
  return UNIT * (ends(frame + 1) - ends(frame));
}
