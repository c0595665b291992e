/**
 * Turns a row's marked pixels into shapes: diamonds if there is room, bands if keys are too close to tell apart. Uses
 * callbacks rather than objects, since it runs for every row in every frame of a drag.
 */

/** Distance in pixels up to which keys merge into a band. */
const NEAR = 3;
/** Shorter runs are drawn as diamonds anyway: three keys in a row are three keys. */
const SHORTEST_BAND = 12;

/** Receiver of the shapes of a row, from left to right. */
export interface RunSink {
  /** @param pixel index of the mark */
  diamond(pixel: number, mark: number): void;
  /** Pixels first … last, all with the same mark except for gaps between them. */
  band(first: number, last: number, mark: number): void;
}

/** Gives the sink the shapes for a row of marks, one per pixel; 0 is no mark. */
export function runsOf(marks: Uint8Array, sink: RunSink): void {
  const count = marks.length;
  let pixel = 0;
  while (pixel < count) {
    if (marks[pixel] === 0) {
      pixel++;
      continue;
    }
    const last = runEnd(marks, pixel);
    if (last - pixel + 1 < SHORTEST_BAND) diamonds(marks, pixel, last, sink);
    else bands(marks, pixel, last, sink);
    pixel = last + 1;
  }
}

/** Last marked pixel of the run that begins at `first`. */
function runEnd(marks: Uint8Array, first: number): number {
  let last = first;
  for (let pixel = first + 1; pixel < marks.length && pixel - last <= NEAR; pixel++)
    if (marks[pixel] !== 0) last = pixel;
  return last;
}

function diamonds(marks: Uint8Array, first: number, last: number, sink: RunSink): void {
  for (let pixel = first; pixel <= last; pixel++) if (marks[pixel] !== 0) sink.diamond(pixel, marks[pixel]);
}

/** One band for each run of the same mark. */
function bands(marks: Uint8Array, first: number, last: number, sink: RunSink): void {
  let begin = first;
  let end = first;
  for (let pixel = first + 1; pixel <= last; pixel++) {
    if (marks[pixel] === 0) continue;
    if (marks[pixel] !== marks[begin]) {
      sink.band(begin, end, marks[begin]);
      begin = pixel;
    }
    end = pixel;
  }
  sink.band(begin, end, marks[begin]);
}
