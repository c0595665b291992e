/**
 * Converts any character to a skeleton of Acclaim bones and a take of it, by way of a BVH capture (`bvh-capture.ts`),
 * which has neither scale nor shear nor linked DOFs: bones without axes of their own, Rz·Ry·Rx in degrees, with
 * translations where the joint moves. The root carries the motion of the character; Acclaim is y up.
 */
import { RADIANS_PER_DEGREE } from '../math/degrees.ts';
import type { Vec3 } from '../math/vec3.ts';
import { type Character, isOfJoints, shownTake } from '../model/document.ts';
import type { Capture } from '../model/files.ts';
import { rootDofCount } from '../model/skeleton/dofs.ts';
import { dofsOf } from '../model/skeleton/joint-types.ts';
import type { AcclaimHeader, AcclaimMotion, Joint, Skeleton } from '../model/skeleton/skeleton.ts';
import { NO_BOX, UNLIMITED } from '../model/skeleton/skeleton.ts';
import { DEFAULT_SPACE, type Space } from '../model/space.ts';
import type { Samples } from '../model/takes/samples.ts';
import { restChannel, SAMPLED, type Take } from '../model/takes/take.ts';
import { bakeTake, eachFrame, type Frames } from './bake.ts';
import { bareCharacter } from './bare-character.ts';
import { type BvhCapture, isUntouched, toBvhCapture } from './bvh-capture.ts';
import { compileSkeleton, localMatrices } from './kinematics.ts';
import { zyxAngles } from './rotations/euler-angles.ts';
import { metresPerUnit } from './space/metres.ts';

/** Bones that only turn, and bones that move as well. */
const TURNS: AcclaimMotion = {
  kind: 'acclaim',
  dofs: ['rx', 'ry', 'rz'],
  axes: [0, 0, 0],
  order: 'xyz',
  frame: 'bone',
};
const MOVES: AcclaimMotion = { ...TURNS, dofs: ['tx', 'ty', 'tz', 'rx', 'ry', 'rz'] };
const INCH = 0.0254;
/** A joint that moves less than this fraction of the skeleton's reach stays where it is. */
const STILL = 1e-9;

/**
 * A character and its shown take as Acclaim bones, sampled at the frames; one that consists of such bones keeps them,
 * and a take that is nothing but its samples is returned as it is.
 * @param character with a skeleton
 * @param frames seconds of the take
 * @param file the name used in diagnostics
 * @throws Error without a skeleton
 */
export function toAcclaimBones(character: Character, frames: Frames, file = ''): BvhCapture {
  const { skeleton, space = DEFAULT_SPACE } = character;
  if (!skeleton) throw new Error(`${character.name} has no skeleton.`);
  const take = shownTake(character);
  const { up } = space;
  const name = take?.name ?? character.name;
  if (isOfJoints(character, 'asf') && up === 'y') {
    if (isUntouched(character, take, frames, 'asf'))
      return { capture: { skeleton, ...(take && { take }) }, diagnostics: [] };
    return { capture: { skeleton, take: takeFrom(name, skeleton, bakeTake(character, frames)) }, diagnostics: [] };
  }
  const { capture: captured, diagnostics } = toBvhCapture(character, frames, file);
  const acclaim: AcclaimHeader = {
    version: '1.10',
    units: ['mass 1.0'],
    length: Number((INCH / metresPerUnit(space)).toPrecision(10)),
    angle: 'deg',
  };
  const made = new Converting(captured, name, up).result();
  return { capture: { ...made, skeleton: { ...made.skeleton, acclaim } }, diagnostics };
}

function takeFrom(name: string, skeleton: Skeleton, samples: Samples): Take {
  const first = rootDofCount(skeleton);
  const count = skeleton.joints.reduce((sum, { motion }) => sum + dofsOf(motion).length, first);
  const { startSeconds, frameSeconds, frameCount } = samples;
  const channels = Array.from({ length: count }, (_, c) => (c < samples.firstChannel ? restChannel() : SAMPLED));
  return { name, range: [startSeconds, startSeconds + (frameCount - 1) * frameSeconds], channels, samples };
}

/**
 * Several roots with the same frames as one: bones with six DOFs below a root that stays at 0.
 * @param captures made by `toAcclaimBones` of characters that don't consist of such bones
 */
export function joinedRoots(captures: readonly Capture[]): Capture {
  const { dofs } = MOVES;
  const joints: Joint[] = [
    {
      name: 'root',
      parent: -1,
      offset: [0, 0, 0],
      box: NO_BOX,
      motion: { ...MOVES, frame: 'root' },
      limits: dofs.map(() => UNLIMITED),
      pose: dofs.map(() => 0),
    },
  ];
  for (const { skeleton } of captures) {
    const first = joints.length;
    for (const joint of skeleton.joints) {
      if (joint.parent < 0) joints.push({ ...joint, parent: 0, motion: MOVES });
      else joints.push({ ...joint, parent: joint.parent + first });
    }
  }
  const skeleton: Skeleton = { ...captures[0].skeleton, joints };
  const all = captures.flatMap(({ take }) => take?.samples ?? []);
  const scales = [
    ...dofs.map((dof) => (dof.startsWith('r') ? RADIANS_PER_DEGREE : 1)),
    ...all.flatMap((s) => [...s.scales]),
  ];
  const [first] = all;
  const values = new Float64Array(first.frameCount * scales.length);
  let from = dofs.length;
  for (const {
    values: own,
    scales: { length },
  } of all) {
    for (let f = 0; f < first.frameCount; f++) {
      values.set(own.subarray(f * length, (f + 1) * length), f * scales.length + from);
    }
    from += length;
  }
  const name = captures[0].take?.name ?? skeleton.name;
  return { skeleton, take: takeFrom(name, skeleton, { ...first, values, scales: Float64Array.from(scales) }) };
}

class Converting {
  private readonly local: Float64Array<ArrayBuffer>;
  private readonly samples: Frames;

  /** @param up what is turned to y up */
  constructor(
    private readonly captured: Capture,
    private readonly name: string,
    private readonly up: Space['up'],
  ) {
    this.local = new Float64Array(16 * captured.skeleton.joints.length);
    const { frameCount = 1, frameSeconds = 1 / 30, startSeconds = 0 } = captured.take?.samples ?? {};
    this.samples = { frameCount, frameSeconds, startSeconds };
  }

  result(): { readonly skeleton: Skeleton; readonly take: Take } {
    const { skeleton } = this.captured;
    const { offsets, moving } = this.offsets();
    const joints = skeleton.joints.map((joint, j): Joint => {
      const { name, parent, endSites } = joint;
      const motion: AcclaimMotion = parent < 0 ? { ...MOVES, frame: 'root' } : moving[j] ? MOVES : TURNS;
      return {
        name,
        parent,
        offset: offsets[j],
        box: joint.box,
        motion,
        limits: motion.dofs.map(() => UNLIMITED),
        pose: motion.dofs.map(() => 0),
        ...(endSites && { endSites }),
      };
    });
    const to: Skeleton = { name: skeleton.name, joints };
    return { skeleton: to, take: takeFrom(this.name, to, this.values(joints)) };
  }

  /** Where joints are that don't move, and where those that do are at first; the root at 0. */
  private offsets(): { readonly offsets: readonly Vec3[]; readonly moving: Uint8Array } {
    const { skeleton } = this.captured;
    const count = skeleton.joints.length;
    const moving = new Uint8Array(count);
    const offsets: Vec3[] = [];
    let reach = 0;
    this.eachFrame((frame) => {
      for (let j = 0; j < count; j++) {
        const o = 16 * j + 12;
        const [x, y, z] = this.local.subarray(o, o + 3);
        if (frame === 0) {
          offsets.push(j === 0 ? [0, 0, 0] : [x, y, z]);
          if (j > 0) reach = Math.max(reach, Math.abs(x), Math.abs(y), Math.abs(z));
        } else if (j > 0 && !moving[j]) {
          const [a, b, c] = offsets[j];
          if (Math.max(Math.abs(x - a), Math.abs(y - b), Math.abs(z - c)) > STILL * reach) moving[j] = 1;
        }
      }
    });
    return { offsets, moving };
  }

  private values(joints: readonly Joint[]): Samples {
    const { local, samples } = this;
    const width = joints.reduce((sum, { motion }) => sum + dofsOf(motion).length, 0);
    const values = new Float64Array(samples.frameCount * width);
    const before = new Float64Array(3 * joints.length);
    this.eachFrame((frame) => {
      let at = frame * width;
      joints.forEach(({ motion, offset }, j) => {
        const o = 16 * j;
        if (dofsOf(motion).length > 3) for (let k = 0; k < 3; k++) values[at++] = local[o + 12 + k] - offset[k];
        // z, y, x: near those of the frame before, so that nothing jumps by a turn.
        zyxAngles(local, o, before, 3 * j);
        for (let k = 2; k >= 0; k--) values[at++] = before[3 * j + k] / RADIANS_PER_DEGREE;
      });
    });
    const scales = joints.flatMap(({ motion }) =>
      dofsOf(motion).map(({ unit }) => (unit === 'angle' ? RADIANS_PER_DEGREE : 1)),
    );
    return { ...samples, firstChannel: 0, values, scales: Float64Array.from(scales), interpolation: 'linear' };
  }

  /** Fills `local` for each frame. */
  private eachFrame(see: (frame: number) => void): void {
    const { captured, samples, local, up } = this;
    const compiled = compileSkeleton(captured.skeleton);
    eachFrame(bareCharacter(captured.skeleton, captured.take), samples, (dofs, frame) => {
      localMatrices(compiled, dofs, local);
      if (up !== 'y') turnUp(local, up);
      see(frame);
    });
  }
}

/** The root's matrix turned to y up: x y z becomes x z −y if z is up, x −y −z if y is down. */
function turnUp(m: Float64Array, up: 'z' | '-y'): void {
  for (let c = 0; c < 16; c += 4) {
    const [y, z] = [m[c + 1], m[c + 2]];
    m[c + 1] = up === 'z' ? z : -y;
    m[c + 2] = up === 'z' ? -y : -z;
  }
}
