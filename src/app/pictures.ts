/**
 * Pictures and videos of the viewport. Loaded on first use. The characters are drawn at each frame's own time, however
 * long that takes, and afterwards as before; the document and the current time never change.
 */
import { type VideoFrames, videoFrames } from '../edit/video-frames.ts';
import type { FrameCanvas, FrameWriter } from '../io/frame-writer.ts';
import type { PictureOptions, Pictures, VideoFormat, VideoOptions } from '../ui/state/pictures.ts';
import type { Uses } from '../ui/state/workbench.ts';
import { beginShots, type ShotOptions, type Shots } from '../view/camera/shots.ts';
import { breathe } from '../view/slices.ts';

export function picturesOf(wb: Uses<'viewport' | 'transport'>, save: (name: string, content: Blob) => void): Pictures {
  const { viewport, transport } = wb;
  const formats = async (width: number, height: number): Promise<readonly VideoFormat[]> => {
    const { codecFor } = await import('../io/video-writer.ts');
    const found: VideoFormat[] = [];
    for (const container of ['mp4', 'webm'] as const) {
      if (await codecFor(container, width, height)) found.push(container);
    }
    return [...found, 'gif', 'png'];
  };
  const frames = (options: VideoOptions): VideoFrames => {
    const now = transport.get();
    const { range = now.range, framesPerSecond = now.framesPerSecond, speed = 1 } = options;
    return videoFrames({ range, framesPerSecond, loop: now.loop, rate: speed });
  };
  return {
    save,
    formats,
    async picture(options = {}) {
      const what = shotOptions(viewport.canvas, options);
      const to = frameCanvas(what);
      const shots = beginShots(viewport.shotParts, what);
      try {
        shots.draw(transport.get().timeSeconds);
        copy(shots, to);
      } finally {
        shots.end();
      }
      return to.canvas.convertToBlob({ type: 'image/png' });
    },
    async video(options = {}, progress, signal) {
      const { framesPerSecond = transport.get().framesPerSecond } = options;
      const asked = shotOptions(viewport.canvas, options);
      const even = { ...asked, width: evenSize(asked.width), height: evenSize(asked.height) };
      const [best] = options.format ? [options.format] : await formats(even.width, even.height);
      const isVideo = best === 'mp4' || best === 'webm';
      // Only PNGs can be transparent, and only videos have sizes in steps of two.
      const what = { ...(isVideo ? even : asked), hasBackground: best !== 'png' || asked.hasBackground };
      const { count, timeOf } = frames(options);
      const to = frameCanvas(what);
      const writer = await writerFor(best, to, framesPerSecond, options.name ?? 'marrow');
      const { playing } = transport.get();
      transport.update((now) => ({ ...now, playing: false }));
      let shots: Shots | undefined;
      try {
        shots = beginShots(viewport.shotParts, what);
        for (let frame = 0; frame < count; frame++) {
          signal?.throwIfAborted();
          shots.draw(timeOf(frame));
          copy(shots, to);
          await writer.add();
          progress?.(frame + 1, count);
          await breathe();
        }
        signal?.throwIfAborted();
        return await writer.end();
      } catch (error) {
        await writer.cancel();
        throw error;
      } finally {
        shots?.end();
        if (playing) transport.update((now) => ({ ...now, playing }));
      }
    },
  };
}

async function writerFor(
  format: VideoFormat,
  to: FrameCanvas,
  framesPerSecond: number,
  name: string,
): Promise<FrameWriter> {
  switch (format) {
    case 'mp4':
    case 'webm':
      return (await import('../io/video-writer.ts')).videoWriter(to, format, framesPerSecond);
    case 'gif':
      return (await import('../io/gif-writer.ts')).gifWriter(to, framesPerSecond);
    case 'png':
      return (await import('../io/png-writer.ts')).pngWriter(to, name);
  }
}

function shotOptions(screen: HTMLCanvasElement, options: PictureOptions): ShotOptions {
  const { width = screen.clientWidth, height = screen.clientHeight } = options;
  if (!(width >= 1 && height >= 1))
    throw new Error(`A picture’s width and height must be greater than 0, found ${width} × ${height}.`);
  const { hasBackground = true, hasGrid = true, hasTools = false } = options;
  return { width: Math.round(width), height: Math.round(height), hasBackground, hasGrid, hasTools };
}

/** Codecs halve the resolution of colours. */
function evenSize(pixels: number): number {
  return Math.max(2, pixels - (pixels % 2));
}

function frameCanvas({ width, height }: ShotOptions): FrameCanvas {
  const canvas = new OffscreenCanvas(width, height);
  const pen = canvas.getContext('2d', { willReadFrequently: true });
  if (!pen) throw new Error('This browser does not provide a 2D canvas.');
  return { canvas, pen };
}

/** Must be called in the task that drew them. */
function copy({ canvases }: Shots, { canvas, pen }: FrameCanvas): void {
  pen.clearRect(0, 0, canvas.width, canvas.height);
  for (const each of canvases) pen.drawImage(each, 0, 0, canvas.width, canvas.height);
}
