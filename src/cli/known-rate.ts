/** Takes of files that state no frame rate, at the one that the user knows. */
import { type Diagnostic, withoutPlace } from '../model/diagnostic.ts';
import type { ParsedFile } from '../model/files.ts';
import { rangeOfSamples } from '../model/takes/samples.ts';
import { hasControls, type Take } from '../model/takes/take.ts';
import type { Loaded } from './load.ts';

/** Codes of what readers say where they use a usual rate. */
const ASSUMED: ReadonlySet<string> = new Set(['rate-assumed', 'rate-expected']);

/** Whether it holds frames, whose rate it states, or its kind does, unless one was assumed. */
function hasFrames(file: ParsedFile): boolean {
  if (file.kind === 'character') return file.characters.some(({ takes }) => takes.some(({ samples }) => samples));
  return file.kind === 'bvh' || file.kind === 'amc' || file.kind === 'trc';
}

/**
 * The files with frames at this rate wherever one was assumed: the same frames at other times. Takes with layers, goals
 * or attachments stay, since these have times of their own.
 * @param framesPerSecond undefined: as they are
 */
export function atKnownRate(loaded: Loaded, framesPerSecond: number | undefined): Loaded {
  if (framesPerSecond === undefined) return loaded;
  const assumed = new Set(loaded.diagnostics.filter(({ code }) => ASSUMED.has(code)).map(({ file }) => file));
  const atRate = (take: Take): Take => {
    if (!take.samples || hasControls(take)) return take;
    const { frameSeconds, startSeconds } = take.samples;
    const start = startSeconds / (frameSeconds * framesPerSecond);
    const samples = { ...take.samples, frameSeconds: 1 / framesPerSecond, startSeconds: start };
    return { ...take, samples, range: rangeOfSamples(samples) };
  };
  const known = loaded.files
    .filter((file) => hasFrames(file) && !assumed.has(file.source.path))
    .map(({ source }) =>
      withoutPlace('info', 'rate-known', 'Its frame rate is known, so --rate changes nothing in it.', source.path),
    );
  const files = loaded.files.map((file): ParsedFile => {
    if (!assumed.has(file.source.path)) return file;
    if (file.kind === 'amc') return { ...file, take: atRate(file.take) };
    if (file.kind === 'trc' && file.capture.take)
      return { ...file, capture: { ...file.capture, take: atRate(file.capture.take) } };
    if (file.kind !== 'character') return file;
    return { ...file, characters: file.characters.map((each) => ({ ...each, takes: each.takes.map(atRate) })) };
  });
  const diagnostics = loaded.diagnostics.map(
    (one): Diagnostic =>
      ASSUMED.has(one.code) ? { ...one, assumed: `used ${framesPerSecond} frames per second, as --rate says` } : one,
  );
  return { ...loaded, files, diagnostics: [...diagnostics, ...known] };
}
