/**
 * Converts any character to a BVH capture: its joints with rotation channels (and position channels if they move), and
 * its shown take as rows of values.
 *
 * Positions are taken from the joints' matrices, since BVH position channels replace the offset; angles are the joints'
 * own DOFs wherever these are such angles (`bvh-joints.ts`). The root always has all six channels, or those it had.
 *
 * `.skel` has no End Sites: there they are leaf `fixedjoint`s of that name (`edit/convert/skel-form.ts`), which
 * become End Sites again here.
 */

import { RADIANS_PER_DEGREE } from '../math/degrees.ts';
import { writeRotationPart } from '../math/mat3.ts';
import { invertAffine, multiplyAffine } from '../math/mat4.ts';
import type { Vec3 } from '../math/vec3.ts';
import { type Diagnostic, withoutPlace } from '../model/diagnostic.ts';
import { type Character, isOfJoints, shownTake } from '../model/document.ts';
import type { Capture } from '../model/files.ts';
import { boneEnds } from '../model/skeleton/bone-ends.ts';
import { firstDofs, rootDofCount } from '../model/skeleton/dofs.ts';
import { bvhChannelsOf, dofsOf, isOfBvh, replacesOffset, stretches } from '../model/skeleton/joint-types.ts';
import { type BvhChannel, type Joint, type Skeleton, UNLIMITED } from '../model/skeleton/skeleton.ts';
import { columnOf } from '../model/takes/samples.ts';
import { restChannel, SAMPLED, type Take } from '../model/takes/take.ts';
import { eachFrame, type Frames, framesOf, playedTake } from './bake.ts';
import { compileSkeleton, localMatrices, worldMatrices } from './kinematics.ts';
import { withPlayedEnds } from './moving-ends.ts';
import { type JointPlan, planJoints } from './samples/bvh-joints.ts';
import { framesOfTake } from './samples/key-frames.ts';

/** A character as a BVH capture, with what was lost on the way. */
export interface BvhCapture {
  readonly capture: Capture;
  /** Messages about everything that BVH can't store. */
  readonly diagnostics: readonly Diagnostic[];
}

/** A translation that changes less than this fraction of the skeleton's reach counts as constant. */
const STILL = 1e-12;

const POSITIONS: readonly BvhChannel[] = ['tx', 'ty', 'tz'];

/** Name of a leaf that represents an End Site. */
const END_SITE = /^end[ _]?site$/i;

/** Whether a `.skel` joint represents a BVH End Site: a leaf below another joint that never moves. */
function representsEndSite({ joints }: Skeleton, j: number): boolean {
  const { motion, name, parent } = joints[j];
  return (
    !isOfBvh(motion) && dofsOf(motion).length === 0 && END_SITE.test(name) && parent >= 0 && joints[j + 1]?.parent !== j
  );
}

/**
 * The default frames for sampling a character: those of its take, or `framesPerSecond` over its range; a single frame
 * without a take.
 */
export function framesFor(character: Character, framesPerSecond: number): Frames {
  const take = playedTake(character);
  return take ? framesOfTake(take, framesPerSecond) : framesOf([0, 0], framesPerSecond);
}

/**
 * Converts a character and its shown take to a BVH capture, sampled at the frames; one that is such a character already
 * is returned as it is.
 * @param character with a skeleton
 * @param frames seconds of the take
 * @param file the name used in diagnostics
 * @throws Error without a skeleton
 */
export function toBvhCapture(character: Character, frames: Frames, file = ''): BvhCapture {
  const { skeleton } = character;
  if (!skeleton) throw new Error(`${character.name} has no skeleton.`);
  const take = shownTake(character);
  if (isUntouched(character, take, frames, 'bvh'))
    return { capture: { skeleton, ...(take && { take }) }, diagnostics: [] };
  return new Figuring(character, withPlayedEnds(character, skeleton, frames), frames, file).result();
}

/**
 * Whether the take consists only of its samples, which are then written exactly as they are; or the skeleton is in the
 * pose that a file without frames is read in.
 */
export function isUntouched(
  character: Character,
  take: Take | undefined,
  frames: Frames,
  format: 'bvh' | 'asf',
): boolean {
  const { skeleton, clampsToLimits, driver } = character;
  if (driver || !skeleton || !isOfJoints(character, format)) return false;
  const first = rootDofCount(skeleton);
  if (take ? take.channels.slice(0, first).some((c) => c.kind !== 'rest' || c.value !== 0) : first > 0) return false;
  if (!take) return isAtOffsets(character, skeleton);
  // Layers are part of the samples by then.
  if (take.goals ?? take.attached) return false;
  const { samples } = take;
  if (samples?.startSeconds !== frames.startSeconds || samples.frameSeconds !== frames.frameSeconds) return false;
  if (samples.frameCount !== frames.frameCount) return false;
  const compiled = compileSkeleton(skeleton);
  if (compiled.couples.length > 0) return false;
  if (clampsToLimits && !compiled.lower.every((v, d) => v <= UNLIMITED.min && compiled.upper[d] >= UNLIMITED.max)) {
    return false;
  }
  for (let d = 0; d < compiled.dofCount; d++) if (take.channels[first + d]?.kind !== 'samples') return false;
  return true;
}

/** Whether positions are at the offsets that they replace, and all other DOFs are 0. */
function isAtOffsets({ pose }: Character, skeleton: Skeleton): boolean {
  const starts = firstDofs(skeleton);
  return skeleton.joints.every(({ motion, offset, couples }, j) => {
    const isAt = ({ name }: { readonly name: string }, d: number) =>
      (pose[starts[j] + d] ?? 0) === (replacesOffset(motion, name) ? offset['xyz'.indexOf(name[1])] : 0);
    return !couples && dofsOf(motion).every(isAt);
  });
}

class Figuring {
  private readonly plans: readonly JointPlan[];
  private readonly isScaled: boolean;
  /** Joints that become BVH joints: all but those that represent End Sites. */
  private readonly kept: readonly number[];
  /** 16 per joint: relative to its parent, without scale and shear. */
  private readonly local: Float64Array<ArrayBuffer>;
  private readonly world: Float64Array<ArrayBuffer>;

  constructor(
    private readonly character: Character,
    private readonly skeleton: Skeleton,
    private readonly frames: Frames,
    private readonly file: string,
  ) {
    const { joints } = skeleton;
    this.plans = planJoints(skeleton);
    this.isScaled = joints.some(({ motion }) => stretches(motion));
    this.kept = joints.flatMap((_, j) => (representsEndSite(skeleton, j) ? [] : [j]));
    this.local = new Float64Array(16 * joints.length);
    this.world = new Float64Array(16 * joints.length);
  }

  result(): BvhCapture {
    const { skeleton, frames, kept } = this;
    const offsets = this.offsets();
    const channels = this.channels(offsets);
    const width = kept.reduce((sum, j) => sum + channels[j].length, 0);
    const values = new Float64Array(frames.frameCount * width);
    const write = this.writer(channels, width, values);
    eachFrame(this.character, frames, (dofs, frame) => {
      this.place(dofs);
      write(dofs, frame);
    });

    const numbers = new Map(kept.map((j, index) => [j, index]));
    const tips = tipsOf(skeleton);
    const leaves = leavesOf(skeleton);
    const joints = kept.map((j): Joint => {
      const { endSites, parent, name, box, restAngles } = skeleton.joints[j];
      const ends = [...(endSites ?? []), ...(tips.get(j) ?? []), ...(leaves.get(j) ?? [])];
      return {
        name: name || (isOfBvh(skeleton.joints[j].motion) ? '' : `joint${j}`),
        parent: numbers.get(parent) ?? -1,
        offset: offsets[j],
        box,
        motion: { kind: 'bvh', channels: channels[j], positions: 'replace' },
        limits: channels[j].map(() => UNLIMITED),
        pose: channels[j].map((channel) => (channel.startsWith('t') ? offsets[j]['xyz'.indexOf(channel[1])] : 0)),
        ...(ends.length && { endSites: ends }),
        // Of the pose that the file's own motion is told from.
        ...(restAngles && !this.character.driver && { restAngles }),
      };
    });
    const converted = { name: skeleton.name, joints };
    const { frameSeconds, frameCount } = frames;
    const scales = joints.flatMap(({ motion }) =>
      dofsOf(motion).map(({ unit }) => (unit === 'angle' ? RADIANS_PER_DEGREE : 1)),
    );
    // Without a root translation before them, or with one that stays 0.
    const firstChannel = rootDofCount(converted);
    const take: Take = {
      name: shownTake(this.character)?.name ?? this.character.name,
      range: [0, (frameCount - 1) * frameSeconds],
      channels: Array.from({ length: firstChannel + width }, (_, c) => (c < firstChannel ? restChannel() : SAMPLED)),
      samples: {
        frameCount,
        frameSeconds,
        startSeconds: 0,
        firstChannel,
        values,
        scales: Float64Array.from(scales),
        interpolation: shownTake(this.character)?.samples?.interpolation ?? 'linear',
      },
    };
    return { capture: { skeleton: converted, take }, diagnostics: this.diagnostics() };
  }

  /** Computes each joint relative to its parent, as a rotation and a position. */
  private place(dofs: Float64Array): void {
    const { local, world, skeleton, plans, isScaled } = this;
    const compiled = compileSkeleton(skeleton);
    localMatrices(compiled, dofs, local);
    if (!isScaled) return;
    worldMatrices(compiled, dofs, world);
    const { joints } = skeleton;
    joints.forEach((_, j) => {
      if (plans[j].isScaled) writeRotationPart(world, 16 * j, world, 16 * j, 4);
    });
    joints.forEach(({ parent }, j) => {
      if (!plans[j].isScaled) return;
      if (parent < 0) {
        local.set(world.subarray(0, 16), 0);
        return;
      }
      invertAffine(world, 16 * parent, inverse, 0);
      multiplyAffine(inverse, 0, world, 16 * j, local, 16 * j);
    });
  }

  /** Offsets: positions of joints that don't move, and initial positions of the others. */
  private offsets(): readonly Vec3[] {
    const { skeleton, plans, frames, local, kept } = this;
    const { joints } = skeleton;
    const offsets = joints.map(({ offset }) => offset);
    const own = kept.filter((j) => plans[j].mayMove && !plans[j].positions);
    if (own.length) {
      eachFrame(this.character, { ...frames, frameCount: 1 }, (dofs) => this.place(dofs));
      for (const j of own) {
        if (plans[j].isScaled) offsets[j] = [local[16 * j + 12], local[16 * j + 13], local[16 * j + 14]];
      }
    }
    return offsets;
  }

  private channels(offsets: readonly Vec3[]): readonly (readonly BvhChannel[])[] {
    const { skeleton, plans } = this;
    const moving = this.moving(offsets);
    return skeleton.joints.map(({ parent, motion }, j) => {
      const plan = plans[j];
      // A BVH joint keeps its channels in order; a root that something else moves gets the missing ones.
      const own = bvhChannelsOf(motion);
      if (own && !plan.isScaled && (parent >= 0 || rootDofCount(skeleton) === 0)) return own;
      const positions = parent < 0 || moving.has(j) || plan.positions ? POSITIONS : [];
      const turns = plan.angles ? plan.angles.map(({ channel }) => channel) : plan.matrix.channels;
      return [...positions, ...turns];
    });
  }

  /** Joints whose offset from their parent changes over the frames. */
  private moving(offsets: readonly Vec3[]): ReadonlySet<number> {
    const { plans, local, kept } = this;
    const still = kept.filter((j) => plans[j].mayMove && !plans[j].positions);
    const moving = new Set<number>();
    if (still.length === 0) return moving;
    const reach = offsets.reduce((most, offset) => Math.max(most, ...offset.map(Math.abs)), 0);
    eachFrame(this.character, this.frames, (dofs) => {
      if (moving.size === still.length) return;
      this.place(dofs);
      for (const j of still) {
        for (let k = 0; k < 3; k++) {
          if (Math.abs(local[16 * j + 12 + k] - offsets[j][k]) > STILL * reach) moving.add(j);
        }
      }
    });
    return moving;
  }

  /** A function that fills a row from the DOFs and the computed matrices. */
  private writer(channels: readonly (readonly BvhChannel[])[], width: number, values: Float64Array) {
    const { character, skeleton, plans, kept, local, frames } = this;
    const starts = firstDofs(skeleton);
    const take = shownTake(character);
    const samples = take?.samples;
    const isOwn = samples?.startSeconds === frames.startSeconds && samples.frameSeconds === frames.frameSeconds;
    const angles = new Float64Array(3);
    const turns = new Float64Array(3 * skeleton.joints.length);
    /** Rows are written in order, and angles from matrices continue from the previous row. */
    return (dofs: Float64Array, frame: number) => {
      let at = frame * width;
      for (const j of kept) {
        const plan = plans[j];
        if (!plan.angles) {
          angles.set(turns.subarray(3 * j, 3 * j + 3));
          plan.matrix.write(local, 16 * j, angles, 0);
          turns.set(angles, 3 * j);
        }
        for (const channel of channels[j]) {
          if (channel.startsWith('t')) {
            values[at++] = local[16 * j + 12 + 'xyz'.indexOf(channel[1])];
            continue;
          }
          const angle = plan.angles?.find((a) => a.channel === channel);
          if (!angle) {
            values[at++] = turns[3 * j + plan.matrix.channels.indexOf(channel)] / RADIANS_PER_DEGREE;
            continue;
          }
          const dof = starts[j] + angle.dof;
          const column = isOwn && take?.channels[dof]?.kind === 'samples' ? columnOf(samples, dof) : -1;
          const raw = column >= 0 && samples ? samples.values[frame * samples.scales.length + column] : 0;
          const isRaw = column >= 0 && samples?.scales[column] === RADIANS_PER_DEGREE;
          // Values read in degrees are written as they were read, unless a limit changed them.
          values[at++] =
            isRaw && angle.sign > 0 && raw * RADIANS_PER_DEGREE === dofs[dof]
              ? raw
              : (angle.sign * dofs[dof]) / RADIANS_PER_DEGREE;
        }
      }
    };
  }

  private diagnostics(): readonly Diagnostic[] {
    const { isScaled, skeleton, character, file } = this;
    const found: Diagnostic[] = [];
    const info = (code: string, message: string, assumed: string) =>
      found.push(withoutPlace('info', code, message, file, assumed));
    if (isScaled) {
      const names = skeleton.joints.filter(({ motion }) => stretches(motion)).map(({ name }) => name || '(no name)');
      const message = `BVH can't store the scale or shear of ${names.join(', ')}.`;
      info('scale-not-held', message, 'left out; joints keep their positions');
    }
    if (character.morphs.length) {
      const count = character.morphs.length;
      info(
        'morphs-not-held',
        `BVH can't store the weights of ${count === 1 ? 'a morph' : `${count} morphs`}.`,
        'left out',
      );
    }
    const couples = skeleton.joints.some((joint) => joint.couples?.length);
    if (couples) info('couples-not-held', "BVH can't store linked DOFs.", 'wrote their resulting values');
    return found;
  }
}

/** Ends of bones along +y that no joint continues: in BVH they need End Sites. */
function tipsOf(skeleton: Skeleton): ReadonlyMap<number, readonly Vec3[]> {
  const tips = boneEnds(skeleton).filter(({ joint, at }) => !skeleton.joints[joint].endSites?.includes(at));
  return new Map(tips.map(({ joint, at }) => [joint, [at]]));
}

/** The End Sites that leaves represent, by the joint above them. */
function leavesOf(skeleton: Skeleton): ReadonlyMap<number, readonly Vec3[]> {
  const leaves = new Map<number, Vec3[]>();
  skeleton.joints.forEach(({ parent, offset }, j) => {
    if (!representsEndSite(skeleton, j)) return;
    const siblings = leaves.get(parent);
    if (siblings) siblings.push(offset);
    else leaves.set(parent, [offset]);
  });
  return leaves;
}

/** Scratch; never escapes. */
const inverse = new Float64Array(16);
