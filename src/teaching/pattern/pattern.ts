/**
 * How numbers differ that no known mistake explains, in words: where they do, and what makes ours theirs there. Only
 * what holds for all of them is said, never why.
 */
import { type Character, shownTake } from '../../model/document.ts';
import { nameOfChannel } from '../compare/channel-name.ts';
import type { FrameTarget, Targets } from '../compare/targets.ts';
import type { FrameNumbers, FrameTime } from '../program/evaluator.ts';
import { channelPattern } from './of-channel.ts';
import { type PointPair, pointPattern } from './of-points.ts';

/** Groups of channels that are told. */
const MAX_GROUPS = 3;
/** Joints, channels and vertices that are named. */
const MAX_NAMED = 4;

/** One time of a comparison. */
interface DifferingFrame {
  readonly time: FrameTime;
  readonly jointErrors: Float64Array;
  readonly vertexErrors: Float64Array;
  readonly normalErrors: Float64Array;
  readonly ours: FrameNumbers;
  readonly size: number;
}

/** The numbers that were compared. */
interface Differing {
  readonly character: Character;
  readonly targets: Targets;
  readonly frames: readonly DifferingFrame[];
  readonly ourChannels: Float64Array;
  readonly tolerance: number;
}

/** `Channel 2 only, after its last key, by 0.9 more each period.` A sentence each for channels and frames that differ. */
export function patternOf(differing: Differing): string {
  return [
    ...jointSentences(differing),
    ...vertexSentences(differing, 'vertices'),
    ...vertexSentences(differing, 'normals'),
    ...channelSentences(differing),
  ].join(' ');
}

// ——— channels ———

function channelSentences({ character, targets, ourChannels, tolerance }: Differing): readonly string[] {
  const { channels, times, values } = targets.channels;
  const take = shownTake(character);
  const byWords = new Map<string, number[]>();
  let count = 0;
  for (let from = 0, to = from; from < channels.length; from = to) {
    while (to < channels.length && channels[to] === channels[from]) to++;
    count++;
    const samples = {
      times: times.subarray(from, to),
      theirs: values.subarray(from, to),
      ours: ourChannels.subarray(from, to),
    };
    const words = channelPattern(take?.channels[channels[from]], samples, tolerance);
    if (words === undefined) continue;
    byWords.set(words, [...(byWords.get(words) ?? []), channels[from]]);
  }
  const groups = [...byWords];
  const sentences = groups.slice(0, MAX_GROUPS).map(([words, list]) => {
    const named = (c: number) => {
      const { name } = nameOfChannel(character, c);
      return name ? `${c} "${name}"` : String(c);
    };
    const only = groups.length === 1 && list.length < count ? ' only' : '';
    const which =
      list.length === count && count > 1
        ? `All ${count} channels`
        : `Channel${list.length > 1 ? 's' : ''} ${listed(list, named)}${only}`;
    return `${which}${words}.`;
  });
  const others = groups.slice(MAX_GROUPS).reduce((sum, [, list]) => sum + list.length, 0);
  return others > 0 ? [...sentences, `${others} other channel${others === 1 ? '' : 's'} in other ways.`] : sentences;
}

// ——— joints and vertices ———

interface FramePair {
  readonly frame: DifferingFrame;
  readonly target: FrameTarget;
}

/** The frames that have errors, and those of them that differ. */
function framesWith({ frames, targets, tolerance }: Differing, errorsOf: (frame: DifferingFrame) => Float64Array) {
  const all = frames.flatMap((frame, f): FramePair[] =>
    errorsOf(frame).length > 0 ? [{ frame, target: targets.frames[f] }] : [],
  );
  const differ = all.filter(({ frame }) => !errorsOf(frame).every((error) => error <= tolerance));
  const count = all.length > 0 ? errorsOf(all[0].frame).length : 0;
  const wrong = Array.from({ length: count }, (_, i) => i).filter((i) =>
    differ.some(({ frame }) => !(errorsOf(frame)[i] <= tolerance)),
  );
  const first = differ[0]?.frame.time;
  const at = ` at ${differ.length} of ${all.length} times${first === undefined ? '' : `, first at ${first} s`}`;
  return { differ, wrong, count, when: differ.length === all.length ? '' : at };
}

function jointSentences(differing: Differing): readonly string[] {
  const { character, tolerance } = differing;
  const { differ, wrong, when } = framesWith(differing, (frame) => frame.jointErrors);
  if (wrong.length === 0) return [];
  const pairs = differ.map(({ frame: { ours, size }, target }) => ({
    ...jointsThatDiffer(ours, target, tolerance, tolerance * size),
    tolerance: tolerance * size,
  }));
  const how = pointPattern(pairs, wrong);
  const isTurned = pairs.some((pair) => pair.isTurned);
  const hasMatrices = differ.some(({ target }) => target.world ?? target.local);
  const words = isTurned
    ? how
      ? `, in rotations, and ${how}`
      : ', in rotations alone'
    : how
      ? `, ${hasMatrices ? 'in places alone, ' : ''}${how}`
      : '';
  return [`${whichJoints(character.skeleton?.joints ?? [], wrong)}${when}${words}.`];
}

interface JointPlaces extends PointPair {
  readonly isTurned: boolean;
}

/** Places by the first kind of numbers that differs, since a frame may have several: world, local or positions. */
function jointsThatDiffer(ours: FrameNumbers, target: FrameTarget, tolerance: number, near: number): JointPlaces {
  const { world, local, positions = new Float64Array(0) } = target;
  const ofWorld = world && matrixPlaces(world, ours.world, tolerance, near);
  const ofLocal = local && matrixPlaces(local, ours.local, tolerance, near);
  const isOff = ({ theirs, ours: own, isTurned }: JointPlaces) => isTurned || !areNear(theirs, own, near);
  const found = [ofWorld, ofLocal].find((each) => each && isOff(each));
  if (found) return found;
  if (positions.length === 0 && (ofWorld ?? ofLocal)) return ofWorld ?? ofLocal ?? NO_PLACES;
  return { theirs: positions, ours: placesOf(ours.world), tolerance: near, isTurned: false };
}
const NO_PLACES: JointPlaces = {
  ...{ theirs: new Float64Array(0), ours: new Float64Array(0), tolerance: 0, isTurned: false },
};

function matrixPlaces(theirs: Float64Array, ours: Float64Array, tolerance: number, near: number): JointPlaces {
  const isTurned = theirs.some((value, i) => i % 16 < 12 && !(Math.abs(value - ours[i]) <= tolerance));
  return { theirs: placesOf(theirs), ours: placesOf(ours), tolerance: near, isTurned };
}

function areNear(theirs: Float64Array, ours: Float64Array, near: number): boolean {
  return theirs.every((value, i) => Math.abs(value - ours[i]) <= near);
}

function vertexSentences(differing: Differing, kind: 'vertices' | 'normals'): readonly string[] {
  const { character, tolerance } = differing;
  const { differ, wrong, count, when } = framesWith(differing, (frame) =>
    kind === 'vertices' ? frame.vertexErrors : frame.normalErrors,
  );
  if (wrong.length === 0) return [];
  const pairs = differ.map(({ frame: { ours, size }, target }) => ({
    theirs: target[kind] ?? new Float64Array(0),
    ours: ours[kind],
    tolerance: kind === 'vertices' ? tolerance * size : tolerance,
  }));
  const which =
    wrong.length === count
      ? `All ${count} ${kind}`
      : `${wrong.length} of ${count} ${kind}${attachedTo(character, wrong)}`;
  return [`${which}${when}, ${pointPattern(pairs, wrong)}.`];
}

/** The joint to which these vertices are attached, and no others. */
function attachedTo(character: Character, wrong: readonly number[]): string {
  const { attachments } = character.skins[character.shownSkin] ?? {};
  if (!attachments) return '';
  const { start, joints } = attachments;
  const count = new Map<number, number>();
  const isWrong = new Set(wrong);
  const outside = new Set<number>();
  for (let v = 0; v + 1 < start.length; v++) {
    for (const joint of new Set(joints.subarray(start[v], start[v + 1]))) {
      if (isWrong.has(v)) count.set(joint, (count.get(joint) ?? 0) + 1);
      else outside.add(joint);
    }
  }
  const joint = [...count].find(([each, of]) => of === wrong.length && !outside.has(each))?.[0];
  if (joint === undefined) return '';
  return `, those attached to ${character.skeleton?.joints[joint]?.name || `joint ${joint}`}`;
}

/** x y z of each matrix. */
function placesOf(matrices: Float64Array): Float64Array {
  return Float64Array.from(
    { length: (3 * matrices.length) / 16 },
    (_, i) => matrices[16 * Math.floor(i / 3) + 12 + (i % 3)],
  );
}

/** `Joint 3 "elbow" only`, `shoulder and all joints below it`, `All joints below shoulder`. */
function whichJoints(
  joints: readonly { readonly name: string; readonly parent: number }[],
  wrong: readonly number[],
): string {
  const nameOf = (j: number) => joints[j]?.name || `joint ${j}`;
  if (wrong.length === joints.length) return wrong.length === 1 ? `Joint ${nameOf(0)}` : `All ${joints.length} joints`;
  if (wrong.length === 1) return `Joint ${nameOf(wrong[0])} only`;
  const below = (top: number) => joints.flatMap((_, j) => (isBelow(joints, j, top) ? [j] : []));
  const isSame = (list: readonly number[]) => list.length === wrong.length && list.every((j, i) => j === wrong[i]);
  const [first] = wrong;
  if (isSame([first, ...below(first)])) return `Joint ${nameOf(first)} and all below it`;
  const parent = joints[first].parent;
  if (parent >= 0 && isSame(below(parent))) return `All joints below ${nameOf(parent)}`;
  return `${wrong.length} of ${joints.length} joints (${listed(wrong, nameOf)})`;
}

function isBelow(joints: readonly { readonly parent: number }[], joint: number, top: number): boolean {
  for (let j = joints[joint].parent; j >= 0; j = joints[j].parent) if (j === top) return true;
  return false;
}

function listed(list: readonly number[], nameOf: (index: number) => string): string {
  const named = list.slice(0, MAX_NAMED).map(nameOf).join(', ');
  return list.length > MAX_NAMED ? `${named} and ${list.length - MAX_NAMED} more` : named;
}
