/**
 * Rebinds skins so that every vertex stays in place when joints move:
 *
 *     W′ · B′⁻¹ = W · B⁻¹        so    B′ = B · W⁻¹ · W′
 *
 * Vertices of removed joints need more than that (`vertex-places.ts`).
 */
import { invertAffine, isSingular, multiplyAffine, setIdentity } from '../../math/mat4.ts';
import type { Character } from '../../model/document.ts';
import type { Skeleton } from '../../model/skeleton/skeleton.ts';
import { bindingCount, type Skin } from '../../model/skin.ts';
import type { JointMap } from './joint-map.ts';
import { bindNew } from './remap-skin.ts';
import { requireSkeleton, type ShownPose, shownAt, skeletonSize } from './shown.ts';
import { VertexPlaces } from './vertex-places.ts';

/** Relative tolerance within which matrices are equal. */
const SAME = 1e-13;

/**
 * The character after a change, with its skins in place in the displayed pose.
 * @param map from the skeleton of `before` to the joints of `after`
 */
export function withSkinsStaying(before: Character, after: Character, map: JointMap, timeSeconds: number): Character {
  if (after.skins.length === 0) return after;
  const grown = withTakenUp(after, firstTakenUp(map), timeSeconds);
  return withSkinsBoundAgain(before, grown, map, timeSeconds);
}

function withSkinsBoundAgain(before: Character, after: Character, map: JointMap, timeSeconds: number): Character {
  const was = shownAt(before, timeSeconds);
  const is = shownAt(after, timeSeconds);
  const moved = movedJoints(was, is, map);
  const isGone = map.to.some((index) => index < 0);
  const isNew = map.origins.some((origin) => origin < 0);
  if (!moved.some((m) => m === 1) && !isGone) return after;
  let { morphs } = after;
  const skins = after.skins.map((skin, s) => {
    const bound = skin.attachments
      ? boundAgain(skin, is, was, map, moved, isNew ? requireSkeleton(after) : undefined)
      : rootBoundAgain(before.skins[s], skin, is, was);
    if (!isGone) return bound;
    const places = new VertexPlaces(before.skins[s], bound, was, is, map);
    // Morphs belong to the shown skin.
    if (s === after.shownSkin) morphs = places.morphs(morphs);
    return places.skin();
  });
  return { ...after, skins, morphs };
}

/**
 * The character with its skins in place when it gains the joints from `first` on. Vertices attached to joints that
 * don't exist are static; when these joints are created they are bound where they are, B = W, so that the vertices stay
 * in place.
 */
export function withTakenUp(after: Character, first: number, timeSeconds: number): Character {
  const { joints } = requireSkeleton(after);
  if (first >= joints.length || !after.skins.some((skin) => takenUp(skin, joints.length) > first)) return after;
  const { world } = shownAt(after, timeSeconds);
  const skins = after.skins.map((skin) => {
    const end = takenUp(skin, joints.length);
    if (end <= first) return skin;
    const bindings = new Float64Array(Math.max(skin.bindings.length, 16 * end));
    bindings.set(skin.bindings);
    for (let j = first; j < end; j++) {
      if (isSingular(world, 16 * j)) continue;
      bindings.set(world.subarray(16 * j, 16 * j + 16), 16 * j);
    }
    return { ...skin, bindings };
  });
  return { ...after, skins };
}

/** Number of existing joints that a skin refers to; one without attachments follows the root. */
function takenUp(skin: Skin, joints: number): number {
  return Math.min(joints, skin.attachments ? bindingCount(skin) : 1);
}

/** Index of the first new joint, if existing ones keep their indices. */
function firstTakenUp({ heirs, origins }: JointMap): number {
  return heirs.every((heir, j) => heir === j) ? heirs.length : origins.length;
}

/** By new joint, whether it existed before and has moved. */
function movedJoints(was: ShownPose, is: ShownPose, { origins }: JointMap): Uint8Array {
  const near = SAME * skeletonSize(was.world);
  return Uint8Array.from(origins, (origin, j) => {
    if (origin < 0) return 0;
    for (let k = 0; k < 16; k++) {
      const allowed = k < 12 ? SAME : near;
      if (!(Math.abs(was.world[16 * origin + k] - is.world[16 * j + k]) <= allowed)) return 1;
    }
    return 0;
  });
}

/** @param grown the new skeleton, if it has new joints: their bindings follow their parents' */
function boundAgain(
  skin: Skin,
  is: ShownPose,
  was: ShownPose,
  { origins }: JointMap,
  moved: Uint8Array,
  grown: Skeleton | undefined,
): Skin {
  const count = Math.min(bindingCount(skin), origins.length);
  if (!moved.subarray(0, count).some((m) => m === 1)) return skin;
  const bindings = skin.bindings.slice();
  const known = new Uint8Array(bindings.length / 16).fill(1);
  for (let j = 0; j < count; j++) {
    if (origins[j] < 0) known[j] = 0;
    else if (moved[j]) rebind(was.world, 16 * origins[j], is.world, 16 * j, bindings, 16 * j);
  }
  if (grown) bindNew(grown, bindings, known);
  return { ...skin, bindings };
}

/** The whole skin follows the root, whichever joint that is now. */
function rootBoundAgain(before: Skin, skin: Skin, is: ShownPose, was: ShownPose): Skin {
  const bindings = skin.bindings.length ? skin.bindings.slice() : new Float64Array(16);
  if (before.bindings.length) bindings.set(before.bindings.subarray(0, 16));
  else setIdentity(bindings);
  rebind(was.world, 0, is.world, 0, bindings, 0);
  return bindings.every((value, i) => value === skin.bindings[i]) ? skin : { ...skin, bindings };
}

/** B′ = B · W⁻¹ · W′, in place; unchanged if W or W′ is singular. */
function rebind(was: Float64Array, w: number, is: Float64Array, i: number, bindings: Float64Array, b: number): void {
  if (isSingular(was, w) || isSingular(is, i)) return;
  invertAffine(was, w, inverse, 0);
  multiplyAffine(inverse, 0, is, i, way, 0);
  multiplyAffine(bindings, b, way, 0, next, 0);
  bindings.set(next, b);
}

/** Scratch; never escapes. */
const inverse = new Float64Array(16);
const way = new Float64Array(16);
const next = new Float64Array(16);
