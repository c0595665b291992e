/**
 * Writes `.bvh`: tabs, LF, one blank between numbers, each the shortest decimal that reads back the same.
 *
 * Values of a sampled channel are written as they are kept, which is as the file had them: nothing is converted that
 * was read in degrees. Positions that are added to the offset are written with it, for by the rule they replace it;
 * but as they are where reading would take them so again (`model/position-channels.ts`). A channel that stands is written in every frame. Keys are not played here: who has some samples
 * them first (`evaluate/bake.ts`).
 *
 * A take of 100 MB is written as pieces of some 40 kB, so that a page can stay alive in between and no string has to
 * hold all of it; `writeBvh` joins them for those who want one text. (V8 ends at 512 MB for a string.)
 */
import type { Diagnostic } from '../../model/diagnostic.ts';
import { firstDofs } from '../../model/dofs.ts';
import type { Figure } from '../../model/files.ts';
import { columnOf, RADIANS_PER_DEGREE } from '../../model/samples.ts';
import { type BvhChannel, dofsOf, type Joint, type Skeleton } from '../../model/skeleton.ts';
import type { WriteResult } from '../reader.ts';
import { Text } from '../write-text.ts';

/** What a file's text is made of, one piece after the other. */
export interface WrittenPieces {
  /** To be gone through once. */
  readonly pieces: Iterable<string>;
  /** Complete when all pieces have been taken. */
  diagnostics(): readonly Diagnostic[];
}

const CHANNEL_NAMES: Readonly<Record<BvhChannel, string>> = {
  tx: 'Xposition',
  ty: 'Yposition',
  tz: 'Zposition',
  rx: 'Xrotation',
  ry: 'Yrotation',
  rz: 'Zrotation',
};

/** Numbers and blanks of a piece: some 40 kB. */
const PIECE = 1 << 13;

/** What a file without frames says of their time. */
const NO_FRAME_SECONDS = 1 / 30;

/**
 * Whether figures can be the roots of one file: those that move have as many frames, of the same time, each.
 */
export function fitOneBvh(figures: readonly Figure[]): boolean {
  const moving = figures.flatMap(({ clip }) => clip?.samples ?? []);
  return moving.every((s) => s.frameCount === moving[0].frameCount && s.frameSeconds === moving[0].frameSeconds);
}

/**
 * Each figure as a root. All joints have `bvh` motions; a clip's channels follow its samples or stand.
 * @param fileName what diagnostics name
 * @throws Error for figures of several frame rates or counts (see `fitOneBvh`), other motions, and channels with keys
 */
export function writeBvh(figures: readonly Figure[], fileName = ''): WriteResult {
  const { pieces, diagnostics } = writeBvhPieces(figures, fileName);
  const text = [...pieces].join('');
  return { text, diagnostics: diagnostics() };
}

/** As `writeBvh`, in pieces. */
export function writeBvhPieces(figures: readonly Figure[], fileName = ''): WrittenPieces {
  if (!fitOneBvh(figures)) throw new Error('Figures of one .bvh need the same frames: write a file for each.');
  const text = new Text(fileName);
  text.line(0, 'HIERARCHY');
  for (const { skeleton } of figures) writeTree(text, skeleton.joints);
  const columns = figures.flatMap((figure) => columnsOf(figure));
  const samples = figures.find(({ clip }) => clip?.samples)?.clip?.samples;
  // A clip that only stands is one frame.
  const frameCount = samples?.frameCount ?? (figures.some(({ clip }) => clip) ? 1 : 0);
  text.line(0, 'MOTION');
  text.line(0, `Frames: ${frameCount}`);
  text.line(0, `Frame Time: ${text.number(samples?.frameSeconds ?? NO_FRAME_SECONDS)}`);
  let diagnostics: readonly Diagnostic[] = [];
  function* pieces() {
    yield text.takeText();
    yield* rows(text, columns, frameCount);
    diagnostics = text.result().diagnostics;
  }
  return { pieces: pieces(), diagnostics: () => diagnostics };
}

/** Pre-order makes this a walk: joints that are no ancestors of the next one are closed before it. */
function writeTree(text: Text, joints: readonly Joint[]): void {
  const open: number[] = [];
  const close = () => {
    open.pop();
    text.line(open.length, '}');
  };
  joints.forEach((joint, index) => {
    while (open.length > 0 && open.at(-1) !== joint.parent) close();
    const depth = open.length;
    text.line(depth, `${depth === 0 ? 'ROOT' : 'JOINT'}${text.lineName(joint.name, 'joint')}`);
    text.line(depth, '{');
    text.line(depth + 1, `OFFSET ${text.numbers(joint.offset)}`);
    const channels = channelsOf(joint);
    text.line(depth + 1, ['CHANNELS', channels.length, ...channels.map((name) => CHANNEL_NAMES[name])].join(' '));
    for (const end of joint.endSites ?? []) {
      text.line(depth + 1, 'End Site');
      text.line(depth + 1, '{');
      text.line(depth + 2, `OFFSET ${text.numbers(end)}`);
      text.line(depth + 1, '}');
    }
    open.push(index);
  });
  while (open.length > 0) close();
}

function channelsOf({ name, motion }: Joint): readonly BvhChannel[] {
  if (motion.kind === 'bvh') return motion.channels;
  throw new Error(`${name || 'A joint'} is no joint of BVH, but ${motion.kind}: make it one first.`);
}

/** Where the numbers of one column of the file come from: value · factor + plus, at every `width`th value. */
interface Column {
  readonly values: Float64Array;
  readonly first: number;
  readonly width: number;
  /** 1 where values are kept in the file's own unit: they are written to the last bit then. */
  readonly factor: number;
  /** The offset that position channels are added to, since in the file they replace it. */
  readonly plus: number;
}

function columnsOf({ skeleton, clip }: Figure): readonly Column[] {
  const starts = firstDofs(skeleton);
  return skeleton.joints.flatMap((joint, j) =>
    dofsOf(joint.motion).map(({ name, unit }, d): Column => {
      const channel = clip?.channels[starts[j] + d];
      if (channel?.times.length) throw new Error(`${joint.name}.${name} has keys: sample them first.`);
      const unitOfFile = unit === 'angle' ? RADIANS_PER_DEGREE : 1;
      const plus = unit === 'angle' ? 0 : addedTo(skeleton, j, name);
      const { samples } = clip ?? {};
      const first = columnOf(samples, starts[j] + d);
      if (samples && first >= 0) {
        const { values, scales } = samples;
        const factor = scales[first] === unitOfFile ? 1 : scales[first] / unitOfFile;
        return { values, first, width: scales.length, factor, plus };
      }
      const stands = (channel ? (channel.rest ?? 0) : joint.pose[d]) / unitOfFile;
      return { values: Float64Array.of(stands), first: 0, width: 0, factor: 1, plus };
    }),
  );
}

function addedTo({ joints }: Skeleton, j: number, name: string): number {
  const { motion, offset } = joints[j];
  return motion.kind === 'bvh' && motion.positions === 'add' ? offset['xyz'.indexOf(name[1])] : 0;
}

/** The rows, in pieces that end anywhere between two numbers: a row may be long. */
function* rows(text: Text, columns: readonly Column[], frameCount: number): Generator<string> {
  const piece: string[] = [];
  for (let frame = 0; frame < frameCount; frame++) {
    for (let c = 0; c < columns.length; c++) {
      const { values, first, width, factor, plus } = columns[c];
      let value = values[first + frame * width];
      if (factor !== 1) value *= factor;
      // Adding 0 would turn −0 into 0.
      if (plus !== 0) value += plus;
      piece.push(text.number(value), c + 1 < columns.length ? ' ' : '\n');
      if (piece.length < PIECE) continue;
      yield piece.join('');
      piece.length = 0;
    }
    if (columns.length === 0) piece.push('\n');
  }
  if (piece.length) yield piece.join('');
}
