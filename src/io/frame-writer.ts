/** Frames of one size into one file. */
export interface FrameWriter {
  /** Writes what the canvas shows. Frames come in order; await each before the next. */
  add(): Promise<void>;
  /** After the last frame. */
  end(): Promise<Blob>;
  /** Instead of `end`. */
  cancel(): Promise<void>;
}

/** The canvas that frames are drawn on. */
export interface FrameCanvas {
  readonly canvas: OffscreenCanvas;
  readonly pen: OffscreenCanvasRenderingContext2D;
}
