/**
 * Automatic weights: which joints move each vertex of a skin, and how much, from the positions of its bones
 * (`evaluate/weights/heat-weights.ts`). Replaces existing weights and bindings; the mesh is kept, and so are the morphs
 * made for it.
 */

import { compileSkeleton, worldMatrices } from '../../evaluate/kinematics.ts';
import { dofCountOf, poseAt } from '../../evaluate/pose.ts';
import { runToEnd, type Steps } from '../../evaluate/steps.ts';
import { boneSegments } from '../../evaluate/weights/bones.ts';
import { heatWeights } from '../../evaluate/weights/heat-weights.ts';
import { invertAffine, isSingular, multiplyAffine } from '../../math/mat4.ts';
import type { Character, Document } from '../../model/document.ts';
import { jointName } from '../../model/skeleton/joint-name.ts';
import type { Skeleton } from '../../model/skeleton/skeleton.ts';
import { bindingCount, type Skin, vertexCount } from '../../model/skin.ts';
import { indexIn } from '../arguments.ts';
import { changeCharacter, requireCharacter } from '../characters.ts';
import { command } from '../command.ts';
import { CommandError } from '../command-error.ts';
import { cutName } from '../cut-name.ts';
import { index, oneOf, optional, whole } from '../schema/shape.ts';
import { NOW } from '../schema/shared-shapes.ts';

/**
 * Where mesh and skeleton are bound. `bound`: as before, keeping the bindings. `drawn`: as both are displayed now, so
 * that nothing moves; for a skin that follows the root as a whole. `file`: the mesh as in its file, with the skeleton
 * as posed now.
 */
export const BIND_PLACES = ['bound', 'drawn', 'file'] as const;
/** The pose in which a skin is bound; see `BIND_PLACES`. */
export type BindPlace = (typeof BIND_PLACES)[number];

/** Arguments of computing weights. */
export interface AutoWeights {
  readonly characterId: string;
  /** Index of the character's skins; default: the shown one. */
  readonly skin?: number;
  /** Seconds of the transport: the pose for `drawn` and `file`. */
  readonly timeSeconds: number;
  /** One of `bindPlaces`; default: the first of them. */
  readonly bind?: BindPlace;
  /** Maximum number of joints per vertex: 1 to 16; default 4. */
  readonly mostInfluences?: number;
}

/** Joints per vertex at most, unless stated. */
export const USUAL_INFLUENCES = 4;
const MAX_INFLUENCES = 16;

/** The result of automatic weighting. */
export interface AutoWeighted {
  readonly document: Document;
  readonly skin: Skin;
  /** Vertices weighted by distance alone. */
  readonly byDistance: number;
  /** Number of joints that move any vertex. */
  readonly moving: number;
  /** Joints that have a bone but move no vertex: the bone is outside the mesh, or others are nearer everywhere. */
  readonly idle: readonly number[];
}

/** Computes weights and bindings of a skin by heat equilibrium; existing ones are replaced. */
export const autoWeights = command({
  id: 'skin.autoWeights',
  args: {
    ...NOW,
    skin: optional(index),
    bind: optional(oneOf(BIND_PLACES)),
    mostInfluences: optional(whole(1)),
  },
  label(document, args) {
    const { skins, shownSkin } = requireCharacter(document, args.characterId);
    return `Automatic weights of ${cutName(skins[args.skin ?? shownSkin]?.name ?? 'the skin')}`;
  },
  run: (document, args) => runToEnd(autoWeightsSteps(document, args)).document,
});

/**
 * Runs `autoWeights` in steps, yielding progress every few milliseconds.
 * @throws CommandError if there is no skeleton or skin, for more than 16 joints per vertex, or if the skin can't be
 * bound in that pose
 */
export function* autoWeightsSteps(document: Document, args: AutoWeights): Steps<AutoWeighted> {
  const character = requireCharacter(document, args.characterId);
  const { skeleton, skins } = character;
  if (!skeleton) throw new CommandError(`${character.name} has no skeleton to bind its skin to.`);
  if (skins.length === 0) throw new CommandError(`${character.name} has no skin.`);
  const index = indexIn(args.skin ?? character.shownSkin, 0, skins.length, 'skin');
  const skin = skins[index];
  const most = args.mostInfluences ?? USUAL_INFLUENCES;
  if (!Number.isInteger(most) || most < 1 || most > MAX_INFLUENCES) {
    throw new CommandError(`A vertex takes 1 to ${MAX_INFLUENCES} joints, found ${most}.`);
  }
  const { timeSeconds: seconds } = args;
  const places = bindPlaces(character, skin, seconds);
  const place = args.bind ?? places[0];
  if (!places.includes(place)) throw new CommandError(`${skin.name} ${WHY_NOT[place]}`);
  const bindings = place === 'bound' ? skin.bindings : framesAt(character, skeleton, skin, seconds, place);
  for (let j = 0; j < skeleton.joints.length; j++) {
    if (isSingular(bindings, 16 * j)) {
      const name = jointName(skeleton, j);
      throw new CommandError(`${name} is scaled to zero in the current pose, so nothing can be bound to it.`);
    }
  }
  const bones = boneSegments(skeleton, bindings);
  const { attachments, byDistance } = yield* heatWeights(skin, bones, most);
  yield 1;
  const isMoving = new Uint8Array(skeleton.joints.length);
  for (let i = 0; i < attachments.joints.length; i++) isMoving[attachments.joints[i]] = 1;
  const moving = isMoving.reduce((sum, is) => sum + is, 0);
  const idle = [...new Set(bones.joints)].filter((joint) => isMoving[joint] === 0);
  yield 1;
  const weighted: Skin = { ...skin, attachments, bindings };
  if (sameWeights(skin, weighted)) return { document, skin, byDistance, moving, idle };
  const changed = changeCharacter(document, character.id, (c) => ({ ...c, skins: c.skins.with(index, weighted) }));
  return { document: changed, skin: weighted, byDistance, moving, idle };
}

const WHY_NOT: Readonly<Record<BindPlace, string>> = {
  bound: 'does not have bindings for all joints.',
  drawn: 'already has weights, so what you see is deformed. Bind the mesh as in the file instead.',
  file: 'can’t be bound there.',
};

/**
 * Where a skin can be bound, most likely first: as before; or for one that follows the root, where mesh and skeleton
 * coincide, as displayed or as in the file.
 */
export function bindPlaces(character: Character, skin: Skin, timeSeconds: number): readonly BindPlace[] {
  const { skeleton } = character;
  if (!skeleton) return [];
  const before: BindPlace[] = isBound(skeleton, skin) ? ['bound'] : [];
  if (skin.attachments) return [...before, 'file'];
  const misfit = (place: BindPlace) => misfitOf(skin, framesAt(character, skeleton, skin, timeSeconds, place));
  const [drawn, file] = [misfit('drawn'), misfit('file')];
  return [...before, ...(drawn <= file ? (['drawn', 'file'] as const) : (['file', 'drawn'] as const))];
}

function isBound({ joints }: Skeleton, skin: Skin): boolean {
  return bindingCount(skin) >= joints.length && joints.every((_, j) => !isSingular(skin.bindings, 16 * j));
}

/** World matrices of the joints at a time, relative to the mesh as in its file. */
function framesAt(
  character: Character,
  skeleton: Skeleton,
  skin: Skin,
  timeSeconds: number,
  place: BindPlace,
): Float64Array {
  const dofs = new Float64Array(dofCountOf(character));
  poseAt(character, timeSeconds, dofs);
  const world = new Float64Array(16 * skeleton.joints.length);
  worldMatrices(compileSkeleton(skeleton), dofs, world);
  if (place !== 'drawn' || isSingular(world)) return world;
  // A skin that follows the root is drawn by M = W₀·B₀⁻¹. With B = M⁻¹·W = B₀·W₀⁻¹·W it stays in place.
  const back = new Float64Array(16);
  invertAffine(world, 0, back, 0);
  if (bindingCount(skin) > 0) {
    const mesh = new Float64Array(16);
    multiplyAffine(skin.bindings, 0, back, 0, mesh, 0);
    back.set(mesh);
  }
  const frames = new Float64Array(world.length);
  for (let o = 0; o < world.length; o += 16) multiplyAffine(back, 0, world, o, frames, o);
  return frames;
}

/** How far the bounding boxes of mesh and joints differ: the distances of their lower and of their upper corners. */
function misfitOf(skin: Skin, frames: Float64Array): number {
  const mesh = boxOf(skin.positions, 0, 3);
  const joints = boxOf(frames, 12, 16);
  return [0, 1].reduce((sum, end) => sum + Math.hypot(...mesh[end].map((x, k) => x - joints[end][k])), 0);
}

function boxOf(values: Float64Array, first: number, stride: number): readonly (readonly number[])[] {
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  for (let o = first; o < values.length; o += stride) {
    for (let k = 0; k < 3; k++) {
      low[k] = Math.min(low[k], values[o + k]);
      high[k] = Math.max(high[k], values[o + k]);
    }
  }
  return [low, high];
}

function sameWeights(a: Skin, b: Skin): boolean {
  const [x, y] = [a.attachments, b.attachments];
  if (!x || !y || !same(a.bindings, b.bindings)) return false;
  return same(x.start, y.start) && same(x.joints, y.joints) && same(x.weights, y.weights);
}

function same(a: Float64Array | Uint32Array, b: Float64Array | Uint32Array): boolean {
  if (a === b) return true;
  if (a.length !== b.length) return false;
  for (let i = 0; i < a.length; i++) if (a[i] !== b[i]) return false;
  return true;
}

/** Average number of joints per vertex. */
export function meanInfluences(skin: Skin): number {
  return (skin.attachments?.joints.length ?? 0) / Math.max(1, vertexCount(skin));
}
