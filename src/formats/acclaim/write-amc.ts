/**
 * Writes `.amc`: for each frame its number, and for each bone with DOFs its values, as the `.asf` of the same skeleton
 * has them (`write-asf.ts`). Values of a sampled channel are written as stored. In pieces, as `.bvh` is.
 */
import { RADIANS_PER_DEGREE } from '../../math/degrees.ts';
import type { Diagnostic } from '../../model/diagnostic.ts';
import type { Capture } from '../../model/files.ts';
import { firstDofs } from '../../model/skeleton/dofs.ts';
import { dofsOf } from '../../model/skeleton/joint-types.ts';
import { columnOf } from '../../model/takes/samples.ts';
import type { WrittenPieces } from '../reader.ts';
import { LONGEST_DECIMAL, putDecimal } from '../write-decimal.ts';
import { Text } from '../write-text.ts';
import { boneNames } from './names.ts';
import { SAMPLES_PER_SECOND } from './read-amc.ts';
import { degreesOf } from './write-asf.ts';

/** Bytes per piece of frames. */
const PIECE = 1 << 16;
/** Digits of a frame rate, of which files state the inverse. */
const RATE_DIGITS = 12;

/**
 * Writes the motion of a skeleton of Acclaim bones. Channels must be sampled or at rest.
 * @param fileName appears in diagnostics
 * @throws Error for keyed channels
 */
export function writeAmc(take: Capture, fileName = ''): WrittenPieces {
  const text = new Text(fileName);
  const { samples } = take.take ?? {};
  const isRadians = take.skeleton.acclaim?.angle === 'rad';
  text.line(0, ':FULLY-SPECIFIED');
  const rate = samples ? Number((1 / samples.frameSeconds).toPrecision(RATE_DIGITS)) : SAMPLES_PER_SECOND;
  if (rate !== SAMPLES_PER_SECOND) text.line(0, `:SAMPLES-PER-SECOND ${text.number(rate)}`);
  text.line(0, isRadians ? ':RADIANS' : ':DEGREES');
  const bones = bonesOf(take, isRadians);
  let diagnostics: readonly Diagnostic[] = [];
  function* pieces() {
    yield UTF8.encode(text.takeText());
    yield* frames(text, bones, samples?.frameCount ?? 1);
    diagnostics = text.result().diagnostics;
  }
  return { pieces: pieces(), diagnostics: () => diagnostics };
}

const UTF8 = new TextEncoder();
const BLANK = 32;
const LF = 10;

/** Where the values of a bone are. */
interface WrittenBone {
  /** Its name in UTF-8. */
  readonly name: Uint8Array;
  readonly columns: readonly Column[];
}

/** A column of the file: every `width`th value from `first`, in the file's unit after `convert`. */
interface Column {
  readonly values: Float64Array;
  readonly first: number;
  readonly width: number;
  /** Absent if values are stored in the file's unit. */
  readonly convert?: (value: number) => number;
}

function bonesOf({ skeleton, take }: Capture, isRadians: boolean): readonly WrittenBone[] {
  const starts = firstDofs(skeleton);
  const names = boneNames(skeleton);
  return skeleton.joints.flatMap(({ name, motion, pose }, j) => {
    const columns = dofsOf(motion).map((dof, d): Column => {
      const channel = take?.channels[starts[j] + d];
      if (channel?.kind === 'keys') throw new Error(`${name}.${dof.name} has keys. Resample them to frames first.`);
      const own = dof.unit === 'angle' && !isRadians ? RADIANS_PER_DEGREE : 1;
      const { samples } = take ?? {};
      const first = columnOf(samples, starts[j] + d);
      if (samples && first >= 0) {
        const { values, scales } = samples;
        const scale = scales[first];
        const width = scales.length;
        if (scale === own) return { values, first, width };
        return { values, first, width, convert: (value) => inUnit(value * scale, own) };
      }
      const resting = channel?.kind === 'rest' ? channel.value : pose[d];
      return { values: Float64Array.of(inUnit(resting, own)), first: 0, width: 0 };
    });
    return columns.length > 0 ? [{ name: UTF8.encode(names[j]), columns }] : [];
  });
}

function inUnit(value: number, own: number): number {
  return own === 1 ? value : degreesOf(value);
}

function* frames(text: Text, bones: readonly WrittenBone[], frameCount: number): Generator<Uint8Array<ArrayBuffer>> {
  const longest = bones.reduce((most, { name }) => Math.max(most, name.length), 0) + LONGEST_DECIMAL + 2;
  const bytes = new Uint8Array(Math.max(PIECE, 4 * longest));
  const full = bytes.length - longest;
  let at = 0;
  for (let frame = 0; frame < frameCount; frame++) {
    at = putAscii(`${frame + 1}\n`, bytes, at);
    for (const { name, columns } of bones) {
      bytes.set(name, at);
      at += name.length;
      for (const { values, first, width, convert } of columns) {
        bytes[at++] = BLANK;
        const stored = values[first + frame * width];
        const value = convert ? convert(stored) : stored;
        if (value - value !== 0) text.about(`frame ${frame + 1}`);
        const end = putDecimal(value, bytes, at);
        at = end < 0 ? putAscii(text.number(value), bytes, at) : end;
        if (at < full) continue;
        yield bytes.slice(0, at);
        at = 0;
      }
      bytes[at++] = LF;
      if (at < full) continue;
      yield bytes.slice(0, at);
      at = 0;
    }
  }
  if (at > 0) yield bytes.slice(0, at);
}

function putAscii(text: string, bytes: Uint8Array, at: number): number {
  for (let i = 0; i < text.length; i++) bytes[at + i] = text.charCodeAt(i);
  return at + text.length;
}
