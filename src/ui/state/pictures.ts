/** Pictures and videos of the viewport. `app/pictures.ts` makes them; their dialogs and the console ask for them. */
import type { ShotOptions } from '../../view/camera/shots.ts';

/** Default: all that the viewport shows but its tools, at its size on screen. */
export type PictureOptions = Partial<ShotOptions>;

/** `mp4` has H.264, `webm` VP9 or VP8; `png` is one picture a frame, in a zip. */
export const VIDEO_FORMATS = ['mp4', 'webm', 'gif', 'png'] as const;
export type VideoFormat = (typeof VIDEO_FORMATS)[number];

export interface VideoOptions extends PictureOptions {
  /** Default: the first of `formats`. */
  readonly format?: VideoFormat;
  /** Default: that of the transport. */
  readonly framesPerSecond?: number;
  /** Default 1; negative: from the end of the range to its start. */
  readonly speed?: number;
  /** Name of the PNGs and of their folder in the zip; default `marrow`. */
  readonly name?: string;
  /** In seconds of the transport; default: the playback range. */
  readonly range?: readonly [number, number];
}

export interface Pictures {
  /** A PNG. */
  picture(options?: PictureOptions): Promise<Blob>;
  /** What this browser can write at a size, the best first. */
  formats(width: number, height: number): Promise<readonly VideoFormat[]>;
  /**
   * The playback range, frame by frame: however long one takes to draw, it is drawn at its own time.
   *
   * @param progress frames done, and all
   * @throws DOMException `AbortError` after `signal`
   */
  video(options?: VideoOptions, progress?: (done: number, of: number) => void, signal?: AbortSignal): Promise<Blob>;
  /** By the browser's download. */
  save(name: string, content: Blob): void;
}
