/**
 * Writes `.bvh`: tabs, LF, one blank between numbers, each the shortest decimal that reads back the same.
 *
 * Values of a sampled channel are written as stored, which is as in the file: nothing read in degrees is converted.
 * Positions that are added to the offset are written including it, since in the file they replace it; but unchanged if
 * reading would detect their meaning again (`model/position-channels.ts`). A constant channel is written in every
 * frame. Keys can't be written: sample them first (`evaluate/bake.ts`).
 *
 * A take of 100 MB is written as bytes in pieces of 64 kB, so that a page stays responsive and no string has to hold
 * all of it. (V8 limits strings to 512 MB. Pieces of text take three times as long, for a string per number and joining
 * them.)
 */

import { RADIANS_PER_DEGREE } from '../../math/degrees.ts';
import type { Diagnostic } from '../../model/diagnostic.ts';
import type { Capture } from '../../model/files.ts';
import { firstDofs } from '../../model/skeleton/dofs.ts';
import { bvhChannelsOf, dofsOf, jointTypeOf, positionsOf } from '../../model/skeleton/joint-types.ts';
import type { BvhChannel, Joint, Skeleton } from '../../model/skeleton/skeleton.ts';
import { columnOf } from '../../model/takes/samples.ts';
import type { WrittenPieces } from '../reader.ts';
import { LONGEST_DECIMAL, putDecimal } from '../write-decimal.ts';
import { Text } from '../write-text.ts';
import { CHANNEL_NAMES } from './channels.ts';

/** Bytes per piece of rows. */
const PIECE = 1 << 16;

/** The frame time in a file without frames. */
const NO_FRAME_SECONDS = 1 / 30;

/** Whether characters can be roots of one file: all that move have the same number of frames and frame time. */
export function fitOneBvh(captures: readonly Capture[]): boolean {
  const moving = captures.flatMap(({ take }) => take?.samples ?? []);
  return moving.every((s) => s.frameCount === moving[0].frameCount && s.frameSeconds === moving[0].frameSeconds);
}

/**
 * Each character becomes a root. All joints must have `bvh` motions, and channels must be sampled or at rest.
 * @param fileName appears in diagnostics
 * @throws Error for characters with different frames (see `fitOneBvh`), other motions, and keyed channels
 */
export function writeBvh(captures: readonly Capture[], fileName = ''): WrittenPieces {
  if (!fitOneBvh(captures))
    throw new Error('Skeletons in one .bvh file must have the same frames. Write one file per skeleton.');
  const text = new Text(fileName);
  text.line(0, 'HIERARCHY');
  for (const { skeleton } of captures) writeTree(text, skeleton.joints);
  const columns = captures.flatMap((capture) => columnsOf(capture));
  const samples = captures.find(({ take }) => take?.samples)?.take?.samples;
  // A take at rest is one frame.
  const frameCount = samples?.frameCount ?? (captures.some(({ take }) => take) ? 1 : 0);
  text.line(0, 'MOTION');
  text.line(0, `Frames: ${frameCount}`);
  text.about('the frame time');
  text.line(0, `Frame Time: ${text.number(samples?.frameSeconds ?? NO_FRAME_SECONDS)}`);
  let diagnostics: readonly Diagnostic[] = [];
  function* pieces() {
    yield UTF8.encode(text.takeText());
    yield* rows(text, columns, frameCount);
    diagnostics = text.result().diagnostics;
  }
  return { pieces: pieces(), diagnostics: () => diagnostics };
}

/** One walk in pre-order: joints that are not ancestors of the next one are closed before it. */
function writeTree(text: Text, joints: readonly Joint[]): void {
  const open: number[] = [];
  const close = () => {
    open.pop();
    text.line(open.length, '}');
  };
  joints.forEach((joint, index) => {
    while (open.length > 0 && open.at(-1) !== joint.parent) close();
    const depth = open.length;
    text.about(`joint ${index} "${joint.name}"`);
    text.line(depth, `${depth === 0 ? 'ROOT' : 'JOINT'}${text.lineName(joint.name, 'joint')}`);
    text.line(depth, '{');
    const { own, ends } = joint.restAngles ?? {};
    text.line(depth + 1, `OFFSET ${text.numbers([...joint.offset, ...(own ?? [])])}`);
    const channels = channelsOf(joint);
    text.line(depth + 1, ['CHANNELS', channels.length, ...channels.map((name) => CHANNEL_NAMES[name])].join(' '));
    joint.endSites?.forEach((end, i) => {
      text.line(depth + 1, 'End Site');
      text.line(depth + 1, '{');
      text.line(depth + 2, `OFFSET ${text.numbers([...end, ...(ends?.[i] ?? [])])}`);
      text.line(depth + 1, '}');
    });
    open.push(index);
  });
  while (open.length > 0) close();
}

function channelsOf({ name, motion }: Joint): readonly BvhChannel[] {
  const channels = bvhChannelsOf(motion);
  if (channels) return channels;
  throw new Error(`${name || 'A joint'} is a ${jointTypeOf(motion).keyword}, not a BVH joint. Convert it first.`);
}

/** Source of a column in the file: value · factor + plus, at every `width`th value. */
interface Column {
  readonly values: Float64Array;
  readonly first: number;
  readonly width: number;
  /** 1 if values are stored in the file's unit, and so written exactly. */
  readonly factor: number;
  /** The offset that position channels are added to; in the file they replace it. */
  readonly plus: number;
}

function columnsOf({ skeleton, take }: Capture): readonly Column[] {
  const starts = firstDofs(skeleton);
  return skeleton.joints.flatMap((joint, j) =>
    dofsOf(joint.motion).map(({ name, unit }, d): Column => {
      const channel = take?.channels[starts[j] + d];
      if (channel?.kind === 'keys') throw new Error(`${joint.name}.${name} has keys. Resample them to frames first.`);
      const unitOfFile = unit === 'angle' ? RADIANS_PER_DEGREE : 1;
      const plus = unit === 'angle' ? 0 : addedTo(skeleton, j, name);
      const { samples } = take ?? {};
      const first = columnOf(samples, starts[j] + d);
      if (samples && first >= 0) {
        const { values, scales } = samples;
        const factor = scales[first] === unitOfFile ? 1 : scales[first] / unitOfFile;
        return { values, first, width: scales.length, factor, plus };
      }
      const stands = (channel ? (channel.kind === 'rest' ? channel.value : 0) : joint.pose[d]) / unitOfFile;
      return { values: Float64Array.of(stands), first: 0, width: 0, factor: 1, plus };
    }),
  );
}

function addedTo({ joints }: Skeleton, j: number, name: string): number {
  const { motion, offset } = joints[j];
  return positionsOf(motion) === 'add' ? offset['xyz'.indexOf(name[1])] : 0;
}

const UTF8 = new TextEncoder();
const BLANK = 32;
const LF = 10;

/** The rows, in pieces that may end between any two numbers, since rows may be long. */
function* rows(text: Text, columns: readonly Column[], frameCount: number): Generator<Uint8Array<ArrayBuffer>> {
  const bytes = new Uint8Array(PIECE);
  // Leaves room for a number and its separator.
  const full = PIECE - LONGEST_DECIMAL - 1;
  let at = 0;
  for (let frame = 0; frame < frameCount; frame++) {
    for (let c = 0; c < columns.length; c++) {
      const { values, first, width, factor, plus } = columns[c];
      let value = values[first + frame * width];
      if (factor !== 1) value *= factor;
      // Adding 0 would turn −0 into 0.
      if (plus !== 0) value += plus;
      if (value - value !== 0) text.about(`frame ${frame + 1}, column ${c + 1}`);
      const end = putDecimal(value, bytes, at);
      at = end < 0 ? putAscii(text.number(value), bytes, at) : end;
      bytes[at++] = c + 1 < columns.length ? BLANK : LF;
      if (at < full) continue;
      yield bytes.slice(0, at);
      at = 0;
    }
    if (columns.length > 0) continue;
    bytes[at++] = LF;
    if (at < full) continue;
    yield bytes.slice(0, at);
    at = 0;
  }
  if (at > 0) yield bytes.slice(0, at);
}

function putAscii(text: string, bytes: Uint8Array, at: number): number {
  for (let i = 0; i < text.length; i++) bytes[at + i] = text.charCodeAt(i);
  return at + text.length;
}
