/**
 * Writes takes as a VRM animation: GLB with `VRMC_vrm_animation` 1.0, which plays on any humanoid. Its skeleton is that of
 * the character from the hips down to its bones, in metres, y up, facing +z; without rotations it is a T-pose. With S and
 * T the rotations of a joint in the world, in a frame and in the T-pose, and V the turn to +z:
 *
 *     world rotation = V · S · T⁻¹        the hips are moved, too; all other joints only turn
 */
import { eachFrame, type Frames, framesOf, playedTake } from '../../evaluate/bake.ts';
import { type RetargetBody, retargetBody } from '../../evaluate/retarget/body.ts';
import { partsOf } from '../../evaluate/retarget/roles.ts';
import { playedSource } from '../../evaluate/retarget/source-pose.ts';
import { framesOfTake } from '../../evaluate/samples/key-frames.ts';
import { backMultiply3, multiply3, turnVector } from '../../math/mat3.ts';
import { quaternionOfRotation } from '../../math/quaternion.ts';
import { type Character, DEFAULT_PLACEMENT } from '../../model/document.ts';
import { filePose } from '../../model/skeleton/dofs.ts';
import { type Joint, NO_BOX, type Skeleton, UNLIMITED } from '../../model/skeleton/skeleton.ts';
import { SAMPLED, type Take } from '../../model/takes/take.ts';
import { writeGlb } from '../glb/write.ts';
import type { ExchangeOptions } from '../shared/options.ts';
import type { ExchangeFile, ExchangeProgress, Loss } from '../shared/report.ts';
import { playedTakes, TakeError } from '../shared/take-motion.ts';
import { type HumanBones, humanBones, REQUIRED } from './human-bones.ts';
import { type TPose, tPoseOf } from './t-pose.ts';

/** Frames per second of takes that have no rate of their own. */
const USUAL_RATE = 60;

/**
 * The takes of a character as a VRM animation.
 * @throws TakeError, in a sentence, if it is no humanoid, or has no take
 */
export function writeVrma(
  character: Character,
  options: ExchangeOptions,
  onProgress?: (progress: ExchangeProgress) => void,
): ExchangeFile {
  const { skeleton, space, name } = character;
  if (!skeleton) throw new TakeError(`${name} has no skeleton; a VRM animation moves the bones of one.`);
  const bones = humanBones(skeleton, partsOf(skeleton, space?.up));
  const missing = REQUIRED.filter((bone) => !bones.has(bone));
  if (missing.length > 0) {
    throw new TakeError(
      `A VRM animation needs a joint for each of VRM's ${REQUIRED.length} required bones; ${name} has none for ${missing.join(', ')}. Name its joints after these.`,
    );
  }
  const played = playedTakes(character, options.take);
  if (played.length === 0) throw new TakeError(`${name} has no take; a VRM animation is one.`);
  const body = bodyOf(skeleton, played[0], bones);
  const moved = played.map((one) => takeOf(one, skeleton, body, options));
  const human: Character = {
    id: character.id,
    name,
    skeleton: skeletonOf(skeleton, body),
    skins: [],
    shownSkin: 0,
    morphs: [],
    textures: [],
    takes: moved.map(({ take }) => take),
    shownTake: 0,
    pose: [],
    clampsToLimits: false,
    placements: [DEFAULT_PLACEMENT],
    timeOffsetSeconds: 0,
    sources: [],
  };
  const { framesPerSecond: _, take: __, ...rest } = options;
  const { pieces, report } = writeGlb(human, { ...rest, keys: 'linear', body: false }, false, onProgress, (nodes) => ({
    extensionsUsed: [EXTENSION],
    extensions: { [EXTENSION]: { specVersion: '1.0', humanoid: { humanBones: nodesOf(body, bones, nodes) } } },
  }));
  const drift = Math.max(...moved.map(({ off }) => off));
  return { pieces, report: { ...report, losses: [...report.losses, ...lossesOf(character, drift)] } };
}

const EXTENSION = 'VRMC_vrm_animation';

/** The joints that are written, and how they rest. */
interface Body {
  /** The hips, and the joints between them and the bones; each after its parent. */
  readonly kept: readonly number[];
  readonly pose: TPose;
  /** The body whose bones have the lengths that are written. */
  readonly lengths: RetargetBody;
}

function bodyOf(skeleton: Skeleton, played: Character, bones: HumanBones): Body {
  const hips = bones.get('hips') ?? 0;
  const needed = new Set<number>();
  for (const joint of bones.values()) {
    const chain: number[] = [];
    for (let j = joint; j >= 0; j = skeleton.joints[j].parent) {
      chain.push(j);
      // What hangs on something else moves as that does, and no player asks for it.
      if (j === hips) for (const each of chain) needed.add(each);
    }
  }
  const take = playedTake(played);
  let lengths = retargetBody(skeleton, played.space);
  const start = { startSeconds: take?.range[0] ?? 0, frameSeconds: 1, frameCount: 1 };
  eachFrame(played, start, (dofs) => {
    lengths = retargetBody(skeleton, played.space, dofs);
  });
  const { clampsToLimits, limbs } = played;
  // What is retargeted to it has joints of its own.
  const stood =
    take && !played.driver
      ? {
          played: playedSource({
            skeleton,
            take,
            pose: filePose(skeleton, 0),
            clampsToLimits,
            ...(limbs && { limbs }),
          }),
          range: take.range,
        }
      : undefined;
  const pose = tPoseOf(skeleton, played.space, bones, stood, lengths);
  return { kept: [...needed].sort((a, b) => a - b), pose, lengths };
}

function skeletonOf({ name, joints }: Skeleton, { kept, pose }: Body): Skeleton {
  const { points } = pose;
  const own = kept.map((j): Joint => {
    const parent = kept.indexOf(joints[j].parent);
    const above = parent < 0 ? undefined : 3 * joints[j].parent;
    const offset = (k: number) => points[3 * j + k] - (above === undefined ? 0 : points[above + k]);
    return {
      name: joints[j].name,
      parent,
      offset: [offset(0), offset(1), offset(2)],
      box: NO_BOX,
      motion: { kind: 'quaternion' },
      limits: [UNLIMITED, UNLIMITED, UNLIMITED, UNLIMITED],
      pose: [0, 0, 0, 1],
    };
  });
  return { name, joints: own };
}

/** A take of the written skeleton: the hips' way, and a quaternion for each joint. */
function takeOf(
  character: Character,
  skeleton: Skeleton,
  body: Body,
  { framesPerSecond }: ExchangeOptions,
): { readonly take: Take; readonly off: number } {
  const { kept, pose, lengths } = body;
  const take = playedTake(character);
  if (!take) throw new TakeError(`${character.name} has no take; a VRM animation is one.`);
  const frames: Frames =
    framesPerSecond === undefined ? framesOfTake(take, USUAL_RATE) : framesOf(take.range, framesPerSecond);
  const width = 3 + 4 * kept.length;
  const values = new Float64Array(width * frames.frameCount);
  const parents = kept.map((j) => kept.indexOf(skeleton.joints[j].parent));
  const worlds = new Float64Array(9 * kept.length);
  const local = new Float64Array(9);
  const hips = kept[0];
  let off = 0;
  eachFrame(character, frames, (dofs, frame) => {
    const { rotations, points } = retargetBody(skeleton, character.space, dofs);
    const o = width * frame;
    turnVector(pose.turn, 0, points, 3 * hips, values, o);
    for (let k = 0; k < 3; k++) values[o + k] -= pose.points[3 * hips + k];
    kept.forEach((j, i) => {
      multiply3(pose.turn, 0, rotations, 9 * j, local, 0);
      // V · S · T⁻¹, and from the parent's.
      multiply3(local, 0, transposed(pose.rotations, 9 * j), 0, worlds, 9 * i);
      if (parents[i] < 0) local.set(worlds.subarray(9 * i, 9 * i + 9));
      else {
        backMultiply3(worlds, 9 * parents[i], worlds, 9 * i, local, 0);
        off = Math.max(off, Math.abs(lengthOf(points, j, skeleton) - lengthOf(lengths.points, j, skeleton)));
      }
      quaternionOfRotation(local, 0, quaternion);
      values.set(quaternion, o + 3 + 4 * i);
    });
  });
  const samples = {
    ...frames,
    firstChannel: 0,
    values,
    scales: new Float64Array(width).fill(1),
    interpolation: 'linear',
  } as const;
  return {
    take: { name: take.name, range: take.range, channels: Array.from({ length: width }, () => SAMPLED), samples },
    off,
  };
}

/** Scratch of `takeOf`. */
const quaternion = new Float64Array(4);

function lengthOf(points: Float64Array, j: number, { joints }: Skeleton): number {
  const p = 3 * joints[j].parent;
  return Math.hypot(points[3 * j] - points[p], points[3 * j + 1] - points[p + 1], points[3 * j + 2] - points[p + 2]);
}

function transposed(m: Float64Array, o: number): Float64Array {
  return Float64Array.from({ length: 9 }, (_, i) => m[o + 3 * (i % 3) + Math.floor(i / 3)]);
}

function nodesOf({ kept }: Body, bones: HumanBones, nodes: readonly number[]): Readonly<Record<string, unknown>> {
  return Object.fromEntries(
    [...bones].flatMap(([bone, joint]) => {
      const at = kept.indexOf(joint);
      return at < 0 ? [] : [[bone, { node: nodes[at] }]];
    }),
  );
}

/** Metres by which bones may change their length without a word. */
const STEADY = 1e-3;

function lossesOf({ skins, morphs }: Character, drift: number): readonly Loss[] {
  const parts = [
    ...(skins.length > 0 ? ['the skin'] : []),
    ...(morphs.length > 0 ? ['morphs'] : []),
    'expressions and gaze',
  ];
  const message = `A VRM animation turns bones and moves the hips. Not in the file: ${parts.join(', ')}.`;
  const losses: Loss[] = [{ code: 'motion-only', severity: 'info', message }];
  if (drift <= STEADY) return losses;
  const length = `${Number(drift.toPrecision(2))} m`;
  return [
    ...losses,
    {
      code: 'positions-left-at-rest',
      severity: 'warning',
      message: `Bones change their length by up to ${length}: only the hips move in a VRM animation, so all other joints stay at their rest positions.`,
    },
  ];
}
