/**
 * A sampled channel as it is drawn:
 *
 *     · · · ╭─╮╭──────╮╭╮ · · ·       dotted before the first frame and after the last one, whose values hold
 *           │ ╰╯      ╰╯╰             between them the way through the frames
 *
 * Where a pixel holds many frames, columns of pixels from the smallest to the largest sample in each; where frames can
 * be told apart, the frames in view are set up as spans of cubics and drawn like those between keys: a line, a step or
 * a smooth way, as the samples are played.
 */
import type { Samples } from '../../model/samples.ts';
import { columnSlope } from '../sampling.ts';
import { sampleExtremes } from './sample-extremes.ts';
import type { TracedColumns } from './trace-columns.ts';
import { heightOf, SpanTracer, type TracedPath, type TraceMap } from './trace-path.ts';

/** Frames in view as keys; kept and filled again. */
const frames = { times: new Float64Array(64), cubics: new Float64Array(256) };
const tracer = new SpanTracer();

/** The frames from one time to another, within the samples, as columns of pixels. */
export function traceSampleColumns(
  samples: Samples,
  column: number,
  map: TraceMap,
  from: number,
  to: number,
  columnsPerPixel: number,
  out: TracedColumns,
): void {
  const { startSeconds, frameSeconds, frameCount } = samples;
  const scale = samples.scales[column];
  const extremes = sampleExtremes(samples);
  // Edges of columns go to the nearest frame: with a few frames to a column nobody sees half of one, and each column
  // takes the frame that the next one begins with, so that none of them is torn from its neighbours.
  const frameAt = (time: number) =>
    Math.min(frameCount - 1, Math.max(0, Math.round((time - startSeconds) / frameSeconds)));
  const range = out.solid(map, from, to, columnsPerPixel);
  if (!range) return;
  const [begin, end] = range;
  const perSecond = map.perSecond * columnsPerPixel;
  let first = frameAt(Math.max(from, map.left + begin / perSecond));
  for (let i = begin; i < end; i++) {
    const last = Math.max(first, frameAt(Math.min(to, map.left + (i + 1) / perSecond)));
    extremes.over(column, first, last);
    const a = heightOf(map, extremes.low * scale);
    const b = heightOf(map, extremes.high * scale);
    out.include(i, Math.min(a, b), Math.max(a, b));
    first = last;
  }
}

/** The way through the frames from one time to another, within the samples, as a path. */
export function traceSamplePath(
  samples: Samples,
  column: number,
  map: TraceMap,
  from: number,
  to: number,
  path: TracedPath,
): void {
  const count = setUpFrames(samples, column, from, to);
  if (count < 2) return;
  tracer.open(frames, map, path);
  tracer.keys(0, count - 1, from, to, (from - map.left) * map.perSecond, 0, false);
}

/** The frames around a stretch of time as cubics. @returns how many */
function setUpFrames(samples: Samples, column: number, from: number, to: number): number {
  const { startSeconds, frameSeconds, frameCount, values, interpolation } = samples;
  const width = samples.scales.length;
  const scale = samples.scales[column];
  const first = Math.max(0, Math.floor((from - startSeconds) / frameSeconds));
  const last = Math.min(frameCount - 1, Math.ceil((to - startSeconds) / frameSeconds));
  const perFrame = interpolation === 'nearest' ? 3 : 1;
  const room = perFrame * (last - first + 1);
  if (room > frames.times.length) {
    frames.times = new Float64Array(2 * room);
    frames.cubics = new Float64Array(8 * room);
  }
  let count = 0;
  const put = (time: number, a: number, b = 0, c = 0, d = 0) => {
    frames.times[count] = time;
    frames.cubics.set([a, b, c, d], 4 * count++);
  };
  for (let f = first; f <= last; f++) {
    // The ends are taken as they are asked for: first + n · step may miss them by a rounding.
    const time = f === first ? Math.min(from, startSeconds + f * frameSeconds) : startSeconds + f * frameSeconds;
    const at = f === last ? Math.max(to, time) : time;
    const here = values[f * width + column] * scale;
    if (f === last) put(at, here);
    else {
      const next = values[(f + 1) * width + column] * scale;
      if (interpolation === 'nearest') {
        put(at, here);
        put(at + frameSeconds / 2, here);
        put(at + frameSeconds / 2, next);
      } else if (interpolation === 'linear') put(at, here, (next - here) / frameSeconds);
      else {
        // A cubic through both frames with the slopes that the sampler has there.
        const m0 = columnSlope(samples, column, time, 'out');
        const m1 = columnSlope(samples, column, startSeconds + (f + 1) * frameSeconds, 'in');
        const rise = (next - here) / frameSeconds;
        const c = (3 * rise - 2 * m0 - m1) / frameSeconds;
        put(at, here, m0, c, (m0 + m1 - 2 * rise) / (frameSeconds * frameSeconds));
      }
    }
  }
  return count;
}
