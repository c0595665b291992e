/**
 * A row's marked pixels as what is drawn of them: diamonds where there is room for them, bands where keys stand nearer
 * than the eye can tell apart. Calls back instead of making objects: this runs for every row of every frame of a drag.
 */

/** Pixels from one key to the next, up to which they run into a band. */
const NEAR = 3;
/** Shorter runs are diamonds all the same: three keys in a row are three keys. */
const SHORTEST_BAND = 12;

export interface RunSink {
  /** @param pixel of the marks */
  diamond(pixel: number, mark: number): void;
  /** Pixels first … last, all with the same mark but for the gaps between them. */
  band(first: number, last: number, mark: number): void;
}

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

/** One band for each stretch of the same mark. */
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
