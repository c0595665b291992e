/** Makes joints from the bones of a `.asf` and its hierarchy. */
import { scaled, type Vec3 } from '../../math/vec3.ts';
import {
  type AcclaimDof,
  type EulerOrder,
  type Joint,
  type Limit,
  NO_BOX,
  UNLIMITED,
} from '../../model/skeleton/skeleton.ts';
import { boneDirection } from '../../model/skeleton/stretch.ts';
import { shortName } from '../words.ts';
import type { AcclaimLines } from './lines.ts';

/** The name of the root in hierarchies and frames. */
export const ROOT = 'root';

/** A bone as an `.asf` has it: angles and lengths in its own units, offsets of the places in bytes. */
export interface Bone {
  name: string;
  id?: string;
  /** Bytes of the file that say so, for messages. */
  at: number;
  directionAt?: number;
  dofAt?: number;
  limitsAt?: number;
  /** Of the root, its orientation. */
  axes: Vec3;
  order: EulerOrder;
  /** Of the root. */
  position: Vec3;
  direction: Vec3;
  length: number;
  dofs: readonly AcclaimDof[];
  /** Pairs, infinite ones too. */
  limits?: number[];
  readonly kept: string[];
}

/** `:hierarchy`: children in the file's order, and where each is named as a child. */
export interface Hierarchy {
  readonly children: ReadonlyMap<string, readonly string[]>;
  readonly parents: ReadonlyMap<string, string>;
  readonly places: ReadonlyMap<string, number>;
}

/** Bones in depth-first order, each with the index of its parent. */
export type OrderedBones = readonly { readonly bone: Bone; readonly parent: number }[];

/**
 * The bones below the root, depth first. Bones outside the hierarchy are left out, with a warning. Undefined, and an
 * error, if bones go round in a loop.
 */
export function bonesInOrder(
  root: Bone,
  bones: ReadonlyMap<string, Bone>,
  { children, parents, places }: Hierarchy,
  lines: AcclaimLines,
): OrderedBones | undefined {
  const { report } = lines;
  const order: { bone: Bone; parent: number }[] = [];
  const seen = new Set<string>();
  const open: { name: string; parent: number }[] = [{ name: ROOT, parent: -1 }];
  for (let next = open.pop(); next; next = open.pop()) {
    const { name, parent } = next;
    const bone = name === ROOT ? root : bones.get(name);
    if (!bone) continue;
    const index = order.length;
    order.push({ bone, parent });
    seen.add(name);
    // The first child is visited first.
    const below = children.get(name) ?? [];
    for (let i = below.length - 1; i >= 0; i--) open.push({ name: below[i], parent: index });
  }
  const outside = new Set<string>();
  for (const [name, bone] of bones) {
    if (seen.has(name)) continue;
    const looped = inLoopAbove(name, parents, outside);
    if (looped !== undefined) {
      const at = lines.placeAt(places.get(looped) ?? bone.at);
      report.error('bone-loop', `"${shortName(looped)}" is its own ancestor: the hierarchy goes round in a loop.`, at);
      return undefined;
    }
    const message = `The bone "${shortName(name)}" is not below the root in :hierarchy.`;
    report.warn('bone-outside', message, lines.placeAt(bone.at), 'left it out');
  }
  if (order.length === 1)
    report.error('bone-missing', 'Expected bones below the root in :hierarchy, found none.', lines.placeAt(0));
  return order;
}

/**
 * A bone in the loop that one comes to by going up from a bone; undefined if there is none.
 * @param without bones above which there is no loop; gets those passed, so that no bone is passed twice
 */
function inLoopAbove(name: string, parents: ReadonlyMap<string, string>, without: Set<string>): string | undefined {
  const passed = new Set<string>();
  for (let at: string | undefined = name; at !== undefined && !without.has(at); at = parents.get(at)) {
    if (passed.has(at)) return at;
    passed.add(at);
  }
  for (const bone of passed) without.add(bone);
  return undefined;
}

/** The joints of bones. @param radians per angle of the file */
export function jointsOf(order: OrderedBones, radians: number, lines: AcclaimLines): readonly Joint[] {
  const tips = order.map(({ bone }) => tipOfBone(bone, lines));
  const isParent = new Uint8Array(order.length);
  for (const { parent } of order) if (parent >= 0) isParent[parent] = 1;
  return order.map(({ bone, parent }, j): Joint => {
    const { name, id, dofs, direction, length, kept } = bone;
    // Angles are listed in the order of their letters.
    const [x, y, z] = [...'xyz'].map((axis) => bone.axes[bone.order.indexOf(axis)] * radians);
    return {
      name,
      parent,
      offset: parent < 0 ? bone.position : tips[parent],
      box: NO_BOX,
      motion: { kind: 'acclaim', dofs, axes: [x, y, z], order: bone.order, frame: parent < 0 ? 'root' : 'bone' },
      limits: limitsOf(bone, radians, lines),
      pose: dofs.map(() => 0),
      ...(parent >= 0 && {
        bone: { ...(id !== undefined && { id }), direction, length, ...(kept.length > 0 && { kept }) },
      }),
      ...(parent >= 0 && !isParent[j] && { endSites: [tips[j]] }),
    };
  });
}

function tipOfBone({ name, direction, directionAt, length, at }: Bone, lines: AcclaimLines): Vec3 {
  if (name === ROOT) return [0, 0, 0];
  const along = boneDirection(direction);
  const place = () => lines.placeAt(directionAt ?? at);
  if (!along) {
    if (length !== 0) {
      lines.report.error('direction-zero', `The bone "${shortName(name)}" has a length, but no direction.`, place());
    }
    return [0, 0, 0];
  }
  if (along !== direction) {
    const size = Number(Math.hypot(...direction).toPrecision(4));
    const message = `Expected a direction of length 1 of the bone "${shortName(name)}", found one of ${size}.`;
    lines.report.warn('direction-length', message, place(), 'used it normalised');
  }
  return scaled(along, length);
}

function limitsOf(
  { name, dofs, limits, limitsAt, dofAt, at }: Bone,
  radians: number,
  lines: AcclaimLines,
): readonly Limit[] {
  if (limits && limits.length !== 2 * dofs.length) {
    const found = limits.length % 2 === 0 ? `${limits.length / 2}` : `${limits.length} numbers`;
    const message = `Expected ${dofs.length} limits of the bone "${shortName(name)}", one for each of its dof, found ${found}.`;
    lines.report.warn('limits-count', message, lines.placeAt(limitsAt ?? dofAt ?? at), 'used those that are there');
  }
  return dofs.map((dof, i) => {
    const [min, max] = [limits?.[2 * i], limits?.[2 * i + 1]];
    if (min === undefined || max === undefined) return UNLIMITED;
    const scale = dof.startsWith('r') ? radians : 1;
    return { min: min * scale, max: max * scale };
  });
}
