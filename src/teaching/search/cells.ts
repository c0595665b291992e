/**
 * The compared numbers, cut into the smallest parts that a mistake may explain alone: those of one dump that one step
 * of a program makes. Several dumps may be of several programs, and a program may make one mistake in its joints and
 * another in its skin.
 */
import type { Character } from '../../model/document.ts';
import type { DumpKind } from '../../model/dump.ts';
import { larger, matrixError, pointError } from '../compare/errors.ts';
import { type ChannelTarget, FRAME_KINDS, type FrameKind, type FrameTarget, type Targets } from '../compare/targets.ts';
import type { Evaluator, FrameNumbers, FrameTime } from '../program/evaluator.ts';
import { valuesNearest } from '../program/own-values.ts';
import type { Program } from '../program/program.ts';

/** The steps of a program whose numbers are told apart. */
export const CELL_GROUPS = ['joints', 'vertices', 'channels'] as const;
/** A step of a program; see `CELL_GROUPS`. */
export type CellGroup = (typeof CELL_GROUPS)[number];

const GROUPS: Readonly<Record<DumpKind, CellGroup>> = {
  world: 'joints',
  local: 'joints',
  positions: 'joints',
  vertices: 'vertices',
  normals: 'vertices',
  channels: 'channels',
};

/** The group that is counted of some kinds: joints, if there are any, else vertices. */
export function groupOf(kinds: readonly DumpKind[]): CellGroup {
  return CELL_GROUPS.find((group) => kinds.some((kind) => GROUPS[kind] === group)) ?? 'joints';
}

/** The numbers of one dump that one step makes. */
export interface Cell {
  /** Into the dumps. */
  readonly dump: number;
  readonly group: CellGroup;
  readonly kinds: readonly DumpKind[];
  /** Whether a number differs from ours. */
  readonly isWrong: boolean;
  /** Pieces of joints or vertices: the cell's numbers of some frames. */
  readonly pieces: readonly CellPiece[];
  /** Values of channels, by channel and time. */
  readonly channels: ChannelTarget;
}

/** Numbers of a cell in one frame. */
export interface CellPiece {
  /** Into all frames. */
  readonly frame: number;
  readonly target: FrameTarget;
}

/** Our numbers, as `compare` has it. */
export interface ComparedNumbers {
  readonly character: Character;
  readonly targets: Targets;
  /** Our numbers, per frame. */
  readonly own: readonly FrameNumbers[];
  /** Sizes of the character, per frame. */
  readonly sizes: readonly number[];
  readonly tolerance: number;
}

/** By dump, then by group. */
export function cellsOf(numbers: ComparedNumbers): readonly Cell[] {
  const { targets } = numbers;
  const { origins, frames, channels } = targets;
  const dumps = Array.from({ length: origins?.fileNames.length ?? 1 }, (_, dump) => dump);
  const cells = dumps.flatMap((dump) => CELL_GROUPS.map((group) => cellOf(numbers, dump, group)));
  return cells.filter(({ kinds }) => kinds.length > 0 && frames.length + channels.channels.length > 0);
}

function cellOf(numbers: ComparedNumbers, dump: number, group: CellGroup): Cell {
  const { character, targets, own, sizes, tolerance } = numbers;
  const { origins, frames, channels } = targets;
  if (group === 'channels') {
    const target = samplesOf(channels, (i) => (origins?.samples[i] ?? 0) === dump);
    const own = valuesNearest(character, target, tolerance);
    const error = own.reduce((most, value, i) => larger(most, value - target.values[i]), 0);
    const kinds = target.channels.length > 0 ? (['channels'] as const) : [];
    return { dump, group, kinds, isWrong: !(error <= tolerance), pieces: [], channels: target };
  }
  const pieces: CellPiece[] = [];
  const kinds = new Set<FrameKind>();
  let isWrong = false;
  frames.forEach((frame, f) => {
    const isOf = (kind: FrameKind) => GROUPS[kind] === group && (origins?.frames[f][kind] ?? 0) === dump;
    const held = FRAME_KINDS.filter((kind) => frame[kind] && isOf(kind));
    if (held.length === 0) return;
    for (const kind of held) {
      kinds.add(kind);
      isWrong ||= !(errorOf(frame, kind, own[f], sizes[f]) <= tolerance);
    }
    const lists = Object.fromEntries(held.map((kind) => [kind, frame[kind]]));
    pieces.push({ frame: f, target: { time: frame.time, ...lists } });
  });
  return { dump, group, kinds: [...kinds], isWrong, pieces, channels: samplesOf(channels, () => false) };
}

/**
 * A program's numbers of a frame; where a DOF jumps at its time, those of the side that is nearest theirs.
 *
 * @param targets theirs of that frame
 */
export function frameNearest(
  evaluator: Evaluator,
  program: Program,
  time: FrameTime,
  targets: readonly FrameTarget[],
  size: number,
): FrameNumbers {
  const has = (kind: FrameKind) => targets.some((target) => target[kind] !== undefined);
  const wanted = { local: has('local'), vertices: has('vertices'), normals: has('normals') };
  const [own, ...others] = evaluator.sidesAt(program.curves, time);
  let nearest = own;
  let numbers = evaluator.frame(program, own, wanted);
  if (others.length === 0) return numbers;
  let least = Number.POSITIVE_INFINITY;
  for (const side of [own, ...others]) {
    numbers = evaluator.frame(program, side, wanted);
    const errors = targets.flatMap((target) =>
      FRAME_KINDS.map((kind) => (target[kind] ? errorOf(target, kind, numbers, size) : 0)),
    );
    const error = Math.max(...errors);
    if (error < least) [least, nearest] = [error, side];
  }
  return evaluator.frame(program, nearest, wanted);
}

/** The largest error of a kind. */
function errorOf(frame: FrameTarget, kind: FrameKind, own: FrameNumbers, size: number): number {
  const theirs = frame[kind] ?? new Float64Array(0);
  let error = 0;
  if (kind === 'world' || kind === 'local') {
    for (let o = 0; o < theirs.length; o += 16) error = Math.max(error, matrixError(theirs, own[kind], o, size));
  } else if (kind === 'positions') {
    for (let j = 0; 3 * j < theirs.length; j++)
      error = Math.max(error, pointError(theirs, 3 * j, own.world, 16 * j + 12, size));
  } else {
    const by = kind === 'normals' ? 1 : size;
    for (let o = 0; o < theirs.length; o += 3) error = Math.max(error, pointError(theirs, o, own[kind], o, by));
  }
  return error;
}

/** Some of the samples. */
export function samplesOf(target: ChannelTarget, isOf: (index: number) => boolean): ChannelTarget {
  const rows = Array.from(target.channels.keys()).filter(isOf);
  return {
    channels: Uint32Array.from(rows, (i) => target.channels[i]),
    times: Float64Array.from(rows, (i) => target.times[i]),
    values: Float64Array.from(rows, (i) => target.values[i]),
  };
}
