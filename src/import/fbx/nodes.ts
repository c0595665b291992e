/**
 * The nodes of an FBX scene and how they are placed:
 *
 *     local = T · Roff · Rp · Rpre · R · Rpost⁻¹ · Rp⁻¹ · Soff · Sp · S · Sp⁻¹
 *
 * with pivots Rp and Sp, offsets Roff and Soff, constant rotations Rpre and Rpost, and T, R, S that move. What that
 * comes to is a translation, a rotation and a scale, too: see `writeLocal`.
 */

import { multiplyQuaternions, writeQuaternion } from '../../evaluate/rotations/euler-orders.ts';
import { ROTATION_ORDERS } from '../../formats/fbx/constants.ts';
import { RADIANS_PER_DEGREE } from '../../math/degrees.ts';
import { type Vec3, ZERO } from '../../math/vec3.ts';
import type { EulerOrder } from '../../model/skeleton/skeleton.ts';
import { type FbxDocument, type FbxObject, type Properties, SCENE_ID } from './document.ts';

/** A node at rest, in the file's units of length. */
export interface FbxNode {
  readonly object: FbxObject;
  /** Index of the parent, smaller than its own; -1 for a root. */
  readonly parent: number;
  readonly translation: Vec3;
  /** About x, y and z, in radians. */
  readonly angles: Vec3;
  readonly scale: Vec3;
  readonly order: EulerOrder;
  readonly inherits: Inheritance;
  readonly pivots: Pivots;
}

/**
 * Whether a node is scaled by its parent like everything else (RSrs), axis by axis before it turns (RrSs), or not by
 * its own parent (Rrs).
 */
export type Inheritance = 'normal' | 'by axis' | 'not of parent';

/** The constant parts of a node's placement. Quaternions x y z w. */
export interface Pivots {
  readonly rotationOffset: Vec3;
  readonly rotationPivot: Vec3;
  readonly scalingOffset: Vec3;
  readonly scalingPivot: Vec3;
  readonly before: Float64Array;
  /** Inverted already. */
  readonly after: Float64Array;
}

const ONE: Vec3 = [1, 1, 1];

/** Levels of models; real files have less than a hundred. */
const MAX_LEVELS = 500;

/**
 * All models of the scene that hang on its root, parents first, depth first. A model that is part of several is part of
 * the first only; those in circles hang on nothing and are left out, as are
 * those more than `MAX_LEVELS` deep.
 */
export function nodesOf(document: FbxDocument): FbxNode[] {
  const nodes: FbxNode[] = [];
  const seen = new Set<number>();
  const pending: { readonly id: number; readonly index: number; at: number }[] = [{ id: SCENE_ID, index: -1, at: 0 }];
  // A stack of its own: files may nest thousands deep.
  for (let top = pending.at(-1); top; top = pending.at(-1)) {
    const link = document.partsOf(top.id)[top.at++];
    if (!link) {
      pending.pop();
      continue;
    }
    const { object, property } = link;
    const isDeep = pending.length > MAX_LEVELS;
    if (object.kind !== 'Model' || property !== undefined || isDeep || seen.has(object.id)) continue;
    seen.add(object.id);
    nodes.push(nodeOf(object, top.index));
    pending.push({ id: object.id, index: nodes.length - 1, at: 0 });
  }
  return nodes;
}

function nodeOf(object: FbxObject, parent: number): FbxNode {
  const { properties } = object;
  const inherit = properties.number('InheritType');
  const hasSpace = hasRotationSpace(properties);
  return {
    object,
    parent,
    translation: properties.vector('Lcl Translation', ZERO),
    angles: inRadians(properties.vector('Lcl Rotation', ZERO)),
    scale: properties.vector('Lcl Scaling', ONE),
    order: (hasSpace && ROTATION_ORDERS[properties.number('RotationOrder') ?? 0]) || 'xyz',
    inherits:
      parent < 0 || inherit === undefined
        ? 'normal'
        : inherit === 0
          ? 'by axis'
          : inherit === 2
            ? 'not of parent'
            : 'normal',
    pivots: pivotsOf(properties, hasSpace),
  };
}

/** Whether a node turns in its own order, between its pre- and post-rotation; else these don't count. */
function hasRotationSpace(properties: Properties): boolean {
  const isActive = properties.number('RotationActive') !== 0;
  const isForLimitsOnly = (properties.number('RotationSpaceForLimitOnly') ?? 0) !== 0;
  return isActive && !isForLimitsOnly;
}

function pivotsOf(properties: Properties, hasSpace: boolean): Pivots {
  const turnOf = (name: string) => {
    const turn = new Float64Array(4);
    writeQuaternion('xyz', inRadians(hasSpace ? properties.vector(name, ZERO) : ZERO), turn);
    return turn;
  };
  const before = turnOf('PreRotation');
  const after = turnOf('PostRotation');
  for (let k = 0; k < 3; k++) after[k] = -after[k];
  return {
    rotationOffset: properties.vector('RotationOffset', ZERO),
    rotationPivot: properties.vector('RotationPivot', ZERO),
    scalingOffset: properties.vector('ScalingOffset', ZERO),
    scalingPivot: properties.vector('ScalingPivot', ZERO),
    before,
    after,
  };
}

/** Angles in degrees as radians. */
export function inRadians([x, y, z]: Vec3): Vec3 {
  return [x * RADIANS_PER_DEGREE, y * RADIANS_PER_DEGREE, z * RADIANS_PER_DEGREE];
}

const q = new Float64Array(4);

/** The rotation of a node whose own angles are these: Rpre · R · Rpost⁻¹, at `out[0]`. */
export function writeNodeRotation({ order, pivots }: FbxNode, angles: ArrayLike<number>, out: Float64Array): void {
  writeQuaternion(order, angles, q);
  multiplyQuaternions(pivots.before, q, out);
  multiplyQuaternions(out, pivots.after, out);
}

/**
 * Where a node with this rotation, its own translation and scale is: T + Roff + Rp + Rotation·(Soff + Sp − S·Sp − Rp),
 * at `out[0]`.
 */
export function writeNodeTranslation(
  { pivots }: FbxNode,
  translation: ArrayLike<number>,
  rotation: Float64Array,
  scale: ArrayLike<number>,
  out: Float64Array,
): void {
  const { rotationOffset, rotationPivot, scalingOffset, scalingPivot } = pivots;
  const x = scalingOffset[0] + scalingPivot[0] * (1 - scale[0]) - rotationPivot[0];
  const y = scalingOffset[1] + scalingPivot[1] * (1 - scale[1]) - rotationPivot[1];
  const z = scalingOffset[2] + scalingPivot[2] * (1 - scale[2]) - rotationPivot[2];
  const qx = rotation[0];
  const qy = rotation[1];
  const qz = rotation[2];
  const qw = rotation[3];
  const cx = qy * z - qz * y + qw * x;
  const cy = qz * x - qx * z + qw * y;
  const cz = qx * y - qy * x + qw * z;
  out[0] = translation[0] + rotationOffset[0] + rotationPivot[0] + x + 2 * (qy * cz - qz * cy);
  out[1] = translation[1] + rotationOffset[1] + rotationPivot[1] + y + 2 * (qz * cx - qx * cz);
  out[2] = translation[2] + rotationOffset[2] + rotationPivot[2] + z + 2 * (qx * cy - qy * cx);
}

/** Whether the place of a node depends on its rotation or its scale. */
export function hasPivots({ pivots }: FbxNode): boolean {
  const { rotationPivot, scalingOffset, scalingPivot } = pivots;
  return [rotationPivot, scalingOffset, scalingPivot].some((vector) => vector.some((v) => v !== 0));
}
