/**
 * Frames as MP4 or WebM: encoded by the browser (WebCodecs), put into a file by mediabunny. Loaded on first use.
 *
 * H.264 is missing in Firefox and in Chromium without its vendor's codecs, all of WebCodecs in older browsers: ask
 * first.
 */
import {
  BufferTarget,
  CanvasSource,
  getFirstEncodableVideoCodec,
  Mp4OutputFormat,
  Output,
  QUALITY_HIGH,
  type VideoCodec,
  WebMOutputFormat,
} from 'mediabunny';
import type { FrameCanvas, FrameWriter } from './frame-writer.ts';

/** The best first. */
const CODECS = { mp4: ['avc'], webm: ['vp9', 'vp8'] } as const satisfies Record<string, readonly VideoCodec[]>;

export type Container = keyof typeof CODECS;

/** Undefined if the browser can't encode any codec of that container at that size. */
export async function codecFor(container: Container, width: number, height: number): Promise<VideoCodec | undefined> {
  if (typeof VideoEncoder === 'undefined') return undefined;
  const options = { width, height, quality: QUALITY_HIGH };
  return (await getFirstEncodableVideoCodec([...CODECS[container]], options)) ?? undefined;
}

export async function videoWriter(
  { canvas }: FrameCanvas,
  container: Container,
  framesPerSecond: number,
): Promise<FrameWriter> {
  const codec = await codecFor(container, canvas.width, canvas.height);
  if (!codec) {
    throw new Error(
      `This browser can’t write ${container} at ${canvas.width} × ${canvas.height}. Choose another format.`,
    );
  }
  const isMp4 = container === 'mp4';
  const target = new BufferTarget();
  const output = new Output({
    format: isMp4 ? new Mp4OutputFormat({ fastStart: 'in-memory' }) : new WebMOutputFormat(),
    target,
  });
  const source = new CanvasSource(canvas, { codec, quality: QUALITY_HIGH });
  output.addVideoTrack(source, { frameRate: framesPerSecond });
  await output.start();
  let frame = 0;
  return {
    add: () => source.add(frame++ / framesPerSecond, 1 / framesPerSecond),
    async end() {
      await output.finalize();
      return new Blob([target.buffer ?? new ArrayBuffer(0)], { type: `video/${container}` });
    },
    cancel: () => output.cancel(),
  };
}
