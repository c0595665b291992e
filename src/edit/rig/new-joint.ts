/** Creates joints in the style of their skeleton: position and motion. */
import type { Vec3 } from '../../math/vec3.ts';
import { type Character, isBvh, shownSkin } from '../../model/document.ts';
import { tipOf } from '../../model/skeleton/bone-ends.ts';
import { isNoBox } from '../../model/skeleton/boxes.ts';
import { bvhChannelsOf, dofsOf, jointTypeOf, positionsOf } from '../../model/skeleton/joint-types.ts';
import {
  type BvhChannel,
  DEFAULT_BOX,
  DEFAULT_MOTION,
  type Joint,
  type Motion,
  NO_BOX,
  type Skeleton,
  UNLIMITED,
} from '../../model/skeleton/skeleton.ts';

/** Default bone length. */
const PLAIN_LENGTH = 0.5;
/** Bone length in a skin without bones, as a fraction of its size. */
const PART_OF_SKIN = 0.2;

/** A default root. */
export function newRoot(name: string): Joint {
  return withMotion({ name, parent: -1, offset: [0, 0, 0], box: DEFAULT_BOX }, DEFAULT_MOTION);
}

/**
 * A child in the style of the existing joints: in BVH with three rotations in its parent's order, and an End Site; in
 * the axis-angle form a hinge with a bone; else a balljoint.
 * @param offset in the parent's space; undefined: as from `nextPlace`
 */
export function newChild(character: Character, skeleton: Skeleton, parent: number, name: string, offset?: Vec3): Joint {
  const above = skeleton.joints[parent];
  const at = offset ?? nextPlace(character, skeleton, parent);
  const plain = { name, parent, offset: at, box: isNoBox(above.box) ? NO_BOX : DEFAULT_BOX };
  if (isBvh(character)) {
    const end: Vec3 = at.some((v) => v !== 0) ? at : [0, typicalLength(character, skeleton), 0];
    return { ...withMotion(plain, rotationsLike(above.motion)), endSites: [end] };
  }
  if (skeleton.form === 'axis-angle' && jointTypeOf(above.motion).isAxisAngle) {
    return { ...withMotion(plain, above.motion), length: above.length ?? 0 };
  }
  return withMotion(plain, DEFAULT_MOTION);
}

function withMotion(joint: Omit<Joint, 'motion' | 'limits' | 'pose'>, motion: Motion): Joint {
  const dofs = dofsOf(motion);
  return { ...joint, motion, limits: dofs.map(() => UNLIMITED), pose: dofs.map(({ rest }) => rest) };
}

function rotationsLike(motion: Motion): Motion {
  const own = bvhChannelsOf(motion)?.filter((name) => name.startsWith('r')) ?? [];
  const channels: readonly BvhChannel[] = own.length === 3 ? own : ['rz', 'rx', 'ry'];
  return { kind: 'bvh', channels, positions: positionsOf(motion) ?? 'replace' };
}

/**
 * Where a child continues its parent's bone: at the tip or End Site that ends it, else at the bone's length; from the
 * root upwards. Beside existing children.
 */
function nextPlace(character: Character, skeleton: Skeleton, parent: number): Vec3 {
  const { joints } = skeleton;
  const above = joints[parent];
  const tip = tipOf(above);
  if (tip) return tip;
  const siblings = joints.filter((joint) => joint.parent === parent);
  if (above.endSites?.length && siblings.length === 0) return above.endSites[0];
  const length = typicalLength(character, skeleton);
  const isBone = parent > 0 && above.offset.some((v) => v !== 0);
  const up = character.space?.up;
  let [x, y, z] = isBone ? above.offset : up === 'z' ? [0, 0, length] : [0, up === '-y' ? -length : length, 0];
  while (siblings.some(({ offset }) => Math.hypot(offset[0] - x, offset[1] - y, offset[2] - z) < length / 100)) {
    x += length / 2;
  }
  return [x, y, z];
}

/** The mean length of bones; a fraction of the skin's size if there are none. */
function typicalLength(character: Character, { joints }: Skeleton): number {
  const lengths = joints.flatMap(({ offset, parent }) => (parent < 0 ? [] : [Math.hypot(...offset)]));
  const known = lengths.filter((length) => length > 0 && length < Infinity);
  if (known.length) return known.reduce((sum, length) => sum + length, 0) / known.length;
  const positions = shownSkin(character)?.positions ?? new Float64Array(0);
  let size = 0;
  for (let k = 0; k < 3; k++) {
    let low = Infinity;
    let high = -Infinity;
    for (let o = k; o < positions.length; o += 3) {
      low = Math.min(low, positions[o]);
      high = Math.max(high, positions[o]);
    }
    size = Math.max(size, high - low);
  }
  // Three digits are enough for a default length.
  return size > 0 && size < Infinity ? Number((PART_OF_SKIN * size).toPrecision(3)) : PLAIN_LENGTH;
}

/**
 * A BVH joint that loses its last child: its bone ends where that was. The same joint if a bone ends already, and
 * outside BVH, which has no End Sites.
 */
export function endedAt(character: Character, joint: Joint, at: Vec3): Joint {
  if (!isBvh(character) || joint.endSites?.length || at.every((v) => v === 0)) return joint;
  return { ...joint, endSites: [at] };
}

/** Without the End Site that a first child replaces. */
export function continued(joint: Joint): Joint {
  if (!joint.endSites) return joint;
  const {
    endSites: [, ...others],
    ...rest
  } = joint;
  return others.length ? { ...rest, endSites: others } : rest;
}
