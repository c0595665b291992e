/**
 * A sampled channel as it is drawn:
 *
 *     · · · ╭─╮╭──────╮╭╮ · · ·       dotted before the first frame and after the last one, whose values hold
 *           │ ╰╯      ╰╯╰             between them interpolated between frames
 *
 * If a pixel covers many frames, as columns of pixels from the smallest to the largest sample. If frames can be told
 * apart, the visible ones become spans of cubics, drawn like those between keys: a line, a step or a smooth curve, as
 * the samples are played.
 */
import type { Samples } from '../../model/takes/samples.ts';
import { columnSlope } from '../samples/sampling.ts';
import { sampleExtremes } from './sample-extremes.ts';
import type { TracedColumns } from './trace-columns.ts';
import { heightOf, SpanTracer, type TracedPath, type TraceMap } from './trace-path.ts';

/** Visible frames as keys; reused. */
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
  // Column edges snap to the nearest frame: with several frames per column, parts of frames are not visible, and each
  // column includes the first frame of the next, so that they connect.
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

/** The curve through the frames from one time to another, within the samples, as a path. */
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

/** The frames around a time range as cubics. @returns their number */
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
    // The ends are exactly as requested: first + n · step may miss them by rounding.
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
        // A cubic through both frames with the sampler's slopes.
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
