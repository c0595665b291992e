/** Takes as animation stacks: one layer each, with a curve for each number that moves. */
import { eachFrame, type Frames, framesOf, MAX_FRAMES, ownFrames, playedTake } from '../../evaluate/bake.ts';
import { fitKeys } from '../../evaluate/fitting/fit-keys.ts';
import type { CompiledSkeleton } from '../../evaluate/kinematics.ts';
import { dofCountOf } from '../../evaluate/pose.ts';
import { writeNearestForm } from '../../evaluate/rotations/euler-angles.ts';
import { resolvedSlopes } from '../../evaluate/slopes.ts';
import { turnedNear } from '../../math/euler.ts';
import type { Character } from '../../model/document.ts';
import type { Interpolation } from '../../model/takes/samples.ts';
import { hasControls } from '../../model/takes/take.ts';
import { type JointNodes, NODE_WIDTH, nodeWriter, type WriteNodes } from '../shared/joint-nodes.ts';
import type { ExchangeOptions } from '../shared/options.ts';
import type { TakeReport } from '../shared/report.ts';
import { TakeError, type TakeMotion, takeMotion } from '../shared/take-motion.ts';
import { frameCurve, frameTimes, keyCurve, ticksOf } from './curves.ts';
import { type FbxDocument, type ListedTake, numberProperty, properties, timeProperty } from './document.ts';
import { DofCurves, type Keys } from './dof-curves.ts';
import { sumAt } from './node-rules.ts';
import { type FbxBytes, type FbxOut, named } from './records.ts';
import type { Target } from './targets.ts';

/** Everything that takes of a character move. */
export interface Moved {
  readonly targets: readonly Target[];
  readonly skeleton: CompiledSkeleton;
  /** The joints as glTF has them, from which numbers are fitted. */
  readonly fits: JointNodes;
  readonly size: number;
  readonly tolerance: number;
}

/** A take in the file. */
export interface WrittenTake {
  readonly motion: TakeMotion;
  readonly listed: ListedTake;
  readonly report: TakeReport;
  /** Curves that say by themselves how they repeat, which not all programs read. */
  readonly repeating: number;
}

/** One curve of a target, as records; undefined where the number rests. */
interface Curve {
  readonly records: readonly FbxOut[];
  readonly keys: number;
  readonly first: number;
  readonly isRepeating: boolean;
}

/** The rotation that may be off at each joint, in radians, if the tolerance is the usual 1/2000 of the size. */
const ANGLE_PER_TOLERANCE = 0.1;

/**
 * Adds the shown take of a character, or what is retargeted to it; undefined if nothing plays.
 * @throws TakeError
 */
export function addTake(
  document: FbxDocument,
  character: Character,
  moved: Moved,
  options: ExchangeOptions,
): WrittenTake | undefined {
  const writing = writingOf(character, moved, options);
  if (!writing) return undefined;
  const { motion } = writing;
  const [start, end] = [ticksOf(motion.start), ticksOf(motion.end)];
  const times = ['LocalStart', 'LocalStop', 'ReferenceStart', 'ReferenceStop'];
  const stack = document.add('AnimationStack', named(motion.name, 'AnimStack'), '', [
    properties(...times.map((name, i) => timeProperty(name, i % 2 ? end : start))),
  ]);
  const layer = document.add('AnimationLayer', named('BaseLayer', 'AnimLayer'), '', []);
  document.connect(layer, stack);
  let [channels, keys, repeating] = [0, 0, 0];
  const curves = curvesOf(writing);
  const isStill = curves.every((own) => own.every((curve) => curve === undefined));
  moved.targets.forEach((target, t) => {
    // A take moves something at least: the root, which stays where it is.
    const own = isStill && t === 0 ? target.rest.map((value) => constantCurve(value * target.factor)) : curves[t];
    if (own.every((curve) => curve === undefined)) return;
    addCurves(document, layer, target, own);
    for (const curve of own) {
      if (!curve) continue;
      channels++;
      keys += curve.keys;
      if (curve.isRepeating) repeating++;
    }
  });
  const report = { name: motion.name, seconds: motion.end - motion.start, channels, keys };
  return { motion, listed: { name: motion.name, start, end }, report, repeating };
}

function addCurves(document: FbxDocument, layer: number, target: Target, curves: readonly (Curve | undefined)[]): void {
  const isWeight = target.property === 'DeformPercent';
  const names = isWeight ? ['d|DeformPercent'] : ['d|X', 'd|Y', 'd|Z'];
  const values = curves.map((curve, k) => curve?.first ?? target.rest[k] * target.factor);
  const short = isWeight ? target.property : target.property[4];
  const node = document.add('AnimationCurveNode', named(short, 'AnimCurveNode'), '', [
    properties(...names.map((name, k) => numberProperty(name, values[k]))),
  ]);
  document.connect(node, layer);
  document.connect(node, target.id, target.property);
  curves.forEach((curve, k) => {
    if (!curve) return;
    document.connect(document.add('AnimationCurve', named('', 'AnimCurve'), '', curve.records), node, names[k]);
  });
}

/** Everything that the curves of a take are made from. */
interface Writing {
  readonly character: Character;
  readonly moved: Moved;
  readonly motion: TakeMotion;
  /** What channels drive; absent if something else does: another character's take, layers, goals, an attachment. */
  readonly curves: DofCurves | undefined;
  /** At which there is a key each: of samples, or as the options say. */
  readonly frames: Frames | undefined;
  /** How samples continue between frames. */
  readonly interpolation: Interpolation;
  /** Whether keyed numbers get a key for each frame, too. */
  readonly isByFrames: boolean;
  readonly nodes: WriteNodes;
  readonly dofCount: number;
}

function writingOf(character: Character, moved: Moved, { framesPerSecond }: ExchangeOptions): Writing | undefined {
  const take = playedTake(character);
  if (!take) return undefined;
  const nodes = nodeWriter(moved.skeleton, moved.fits);
  const dofCount = dofCountOf(character);
  const own = dofCount - character.morphs.length;
  const all: WriteNodes = (dofs, row, o) => {
    row.set(dofs, o);
    nodes(dofs, row, o + dofCount);
  };
  const motion = takeMotion(character, all, own);
  if (!motion) return undefined;
  const isByChannels = !character.driver && !hasControls(take);
  const isByFrames = framesPerSecond !== undefined;
  const frames = isByFrames ? framesOf(take.range, framesPerSecond) : within(ownFrames(character), take.range);
  if (frames && frames.frameCount > MAX_FRAMES) {
    throw new TakeError(`${take.name} has ${frames.frameCount} frames at this rate; write fewer per second.`);
  }
  return {
    character,
    moved,
    motion,
    curves: isByChannels ? new DofCurves(character, moved.skeleton, take) : undefined,
    frames,
    interpolation: isByFrames || character.driver ? 'linear' : (take.samples?.interpolation ?? 'linear'),
    isByFrames,
    nodes,
    dofCount,
  };
}

/** Those of frames that a range shows, with the ones before and after. */
function within(frames: Frames | undefined, [start, end]: readonly [number, number]): Frames | undefined {
  if (!frames) return undefined;
  const { startSeconds, frameSeconds, frameCount } = frames;
  const at = (seconds: number) => (seconds - startSeconds) / frameSeconds;
  const first = Math.min(frameCount - 1, Math.max(0, Math.floor(at(start) + 1e-6)));
  const last = Math.max(first, Math.min(frameCount - 1, Math.ceil(at(end) - 1e-6)));
  return { startSeconds: startSeconds + first * frameSeconds, frameSeconds, frameCount: last - first + 1 };
}

type Curves = readonly (Curve | undefined)[];

/** The curves of all targets. */
function curvesOf(writing: Writing): readonly Curves[] {
  const { moved, curves, frames, isByFrames } = writing;
  const drives = moved.targets.map((target) => driveOf(target, writing));
  const byFrames = moved.targets.filter((_, t) => drives[t] === 'samples' || (isByFrames && drives[t] !== 'constant'));
  const framed = frames ? frameCurves(writing, frames, byFrames) : new Map<Target, Curves>();
  const rows = new Rows(writing);
  return moved.targets.map((target) => {
    const found = framed.get(target);
    if (found) return found;
    if (!curves || target.sums === 'fitted') return fittedCurves(target, writing, rows);
    return target.sums.map((sum, k) => {
      if (curves.driveOf(sum) === 'keys') return keyedCurve(curves.keysOf(sum), target.factor);
      return resting(curves.valueAt(sum, writing.motion.start), target, k);
    });
  });
}

function driveOf({ sums }: Target, { curves, frames, motion }: Writing): 'constant' | 'keys' | 'samples' {
  if (!curves) return frames ? 'samples' : 'keys';
  // What is fitted follows DOFs that are not told: samples of the take may drive them.
  if (sums === 'fitted') return motion.framesPerSecond === undefined ? 'keys' : 'samples';
  const drives = sums.map((sum) => curves.driveOf(sum));
  return drives.includes('samples') ? 'samples' : drives.includes('keys') ? 'keys' : 'constant';
}

/** A curve of one key, unless the number rests there anyway. */
function resting(value: number, { rest, factor }: Target, k: number): Curve | undefined {
  return Math.abs(value - rest[k]) <= 1e-9 * Math.max(1, Math.abs(value)) ? undefined : constantCurve(value * factor);
}

function constantCurve(value: number): Curve {
  const keys = {
    times: [0],
    values: [value],
    slopesIn: [0],
    slopesOut: [0],
    before: 'constant',
    after: 'constant',
  } as const;
  return { records: keyCurve(keys, 1), keys: 1, first: value, isRepeating: false };
}

function keyedCurve(keys: Keys, factor: number): Curve {
  return {
    records: keyCurve(keys, factor),
    keys: keys.times.length,
    first: keys.values[0] * factor,
    isRepeating: keys.before !== 'constant' || keys.after !== 'constant',
  };
}

/** A key a frame for some of the targets. */
function frameCurves(writing: Writing, frames: Frames, targets: readonly Target[]): Map<Target, Curves> {
  const found = new Map<Target, Curves>();
  if (targets.length === 0) return found;
  const { character, nodes, interpolation, moved } = writing;
  const { frameCount, startSeconds, frameSeconds } = frames;
  const columns = targets.map(({ rest }) => rest.map(() => new Float32Array(frameCount)));
  const values = targets.map(({ rest }) => Float64Array.from(rest));
  const row = new Float64Array(NODE_WIDTH * moved.fits.nodes.length);
  const isFitted = targets.some(({ sums }) => sums === 'fitted');
  eachFrame(character, frames, (dofs, frame) => {
    if (isFitted) nodes(dofs, row, 0);
    targets.forEach((target, t) => {
      writeFrame(target, dofs, row, values[t], frame === 0);
      for (let k = 0; k < values[t].length; k++) columns[t][k][frame] = values[t][k] * target.factor;
    });
  });
  const isHeld = interpolation === 'nearest';
  // The nearer frame shows: from half a frame before it on.
  const seconds = Array.from({ length: frameCount }, (_, f) =>
    isHeld && f > 0 ? startSeconds + (f - 0.5) * frameSeconds : startSeconds + f * frameSeconds,
  );
  const times = frameTimes(seconds);
  targets.forEach((target, t) => {
    const rests = target.rest.map((value) => Math.fround(value * target.factor));
    found.set(
      target,
      columns[t].map((column, k) => {
        if (mayRest(target, k, writing) && column.every((value) => value === column[0])) {
          return column[0] === rests[k] ? undefined : constantCurve(column[0]);
        }
        return interpolation === 'cubic' ? smoothCurve(seconds, column) : framed(times, column, isHeld);
      }),
    );
  });
  return found;
}

/** Whether a number that never changes needs no key for each frame: samples that drive it have them. */
function mayRest({ sums }: Target, k: number, { curves }: Writing): boolean {
  return !curves || sums === 'fitted' || curves.driveOf(sums[k]) !== 'samples';
}

function framed(times: FbxBytes, column: Float32Array<ArrayBuffer>, isHeld: boolean): Curve {
  return { records: frameCurve(times, column, isHeld), keys: column.length, first: column[0], isRepeating: false };
}

/** A smooth curve through all frames, as samples have it. */
function smoothCurve(seconds: readonly number[], column: Float32Array): Curve {
  const last = column.length - 1;
  const slopes = Array.from(column, (_, f) => {
    const [a, b] = [Math.max(0, f - 1), Math.min(last, f + 1)];
    return a === b ? 0 : (column[b] - column[a]) / (seconds[b] - seconds[a]);
  });
  const ends = { before: 'constant', after: 'constant' } as const;
  return keyedCurve({ times: seconds, values: column, slopesIn: slopes, slopesOut: slopes, ...ends }, 1);
}

/** Writes the numbers of a target in a frame, angles without jumps from those of the frame before. */
function writeFrame(
  target: Target,
  dofs: Float64Array,
  row: Float64Array,
  values: Float64Array,
  isFirst: boolean,
): void {
  const { sums, turns, write, property } = target;
  if (sums === 'fitted') {
    write?.(row, 0, values);
    return;
  }
  const own = sums.map((sum) => sumAt(sum, dofs));
  if (isFirst || property !== 'Lcl Rotation') values.set(own);
  else if (turns) {
    const [i, j, k] = turns;
    writeNearestForm(own[i], own[j], own[k], values[i], values[j], values[k], nearest, 0);
    turns.forEach((axis, at) => {
      values[axis] = nearest[at];
    });
  } else for (let k = 0; k < values.length; k++) values[k] = turnedNear(own[k], values[k]);
}

/** Scratch of `writeFrame`. */
const nearest = new Float64Array(3);

/** The motion's numbers at times, which fits of many nodes ask for again. */
class Rows {
  private readonly known = new Map<number, Float64Array>();
  private readonly most: number;

  constructor(private readonly writing: Writing) {
    this.most = Math.ceil(MAX_NUMBERS / this.width);
  }

  private get width(): number {
    return this.writing.dofCount + NODE_WIDTH * this.writing.moved.fits.nodes.length;
  }

  at(seconds: number): Float64Array {
    const known = this.known.get(seconds);
    if (known) return known;
    if (this.known.size >= this.most) this.known.clear();
    const row = new Float64Array(this.width);
    this.writing.motion.write(seconds, row);
    this.known.set(seconds, row);
    return row;
  }
}

/** Numbers of kept rows. */
const MAX_NUMBERS = 8_000_000;

/** Keys that hold the tolerance, of numbers that are no sums of channels. */
function fittedCurves(target: Target, { moved, motion, dofCount }: Writing, rows: Rows): Curves {
  const { sums, write, rest, factor, isLength, property } = target;
  const { size, tolerance } = moved;
  const near = (seconds: number, before: Float64Array, out: Float64Array) => {
    const row = rows.at(seconds);
    out.set(before);
    if (sums === 'fitted') write?.(row, dofCount, out);
    else writeFrame(target, row, row, out, property !== 'Lcl Rotation');
  };
  const allowed = isLength ? tolerance * ANGLE_PER_TOLERANCE : (tolerance / size) * ANGLE_PER_TOLERANCE;
  const lists = fitKeys(
    near,
    [...motion.breaks],
    rest,
    rest.map(() => allowed),
  );
  return lists.map((list, k) => {
    if (list.isConstant(1e-9)) return resting(list.firstValue, target, k);
    const channel = list.channel(1, 0, 'constant', 'constant');
    const slopes = resolvedSlopes(channel);
    const { times, values } = channel;
    const ends = { before: 'constant', after: 'constant' } as const;
    return keyedCurve({ times, values, slopesIn: slopes.in, slopesOut: slopes.out, ...ends }, factor);
  });
}
