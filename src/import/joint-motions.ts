/**
 * Which type of joint a node becomes: the smallest that can hold its rest and all that its takes do.
 *
 *     nothing moves             fixedjoint, or balljoint if it rests turned
 *     rotation                  balljoint, in an order that keeps clear of gimbal lock; else quaternionjoint
 *     translation               translationaljoint
 *     translation, rotation     freejoint
 *     scale, or rests scaled    compoundjoint of the DOFs that it needs
 *
 * A part of the body that the file states turns at any rate, and the hips move: a character without takes can be posed.
 */

import { lockedness } from '../evaluate/rotations/euler-orders.ts';
import type { Vec3 } from '../math/vec3.ts';
import { type CompoundDof, EULER_ORDERS, type EulerOrder, type Motion } from '../model/skeleton/skeleton.ts';
import { type Channel, keysOf, restChannel } from '../model/takes/take.ts';
import type { RotationForm, TrackedDof } from '../model/takes/tracked-take.ts';
import { type RotationDofs, rotationDofs } from './fit-rotation.ts';
import { NOISE } from './noise.ts';
import { curveOf, visited } from './quaternion-curve.ts';
import type { AxisCurves, SceneMove, SceneNode } from './scene.ts';

/** The type of joint of a node, at rest, with how its takes become channels. */
export interface JointMotion {
  readonly motion: Motion;
  readonly offset: Vec3;
  readonly pose: readonly number[];
  /** The channels of its DOFs in a take; a take may leave the node alone. Those of quaternions are yet to be fitted. */
  channels(move: SceneMove | undefined): readonly (Channel | TrackedDof)[];
}

/** Middle angles up to 80° are clear of gimbal lock. */
const CLEAR = Math.sin((80 * Math.PI) / 180);
/** From 88° on, a rotation is better kept as a quaternion. */
const LOCKED = Math.sin((88 * Math.PI) / 180);

/**
 * The type of joint that a node becomes, from its rest and all that its takes do.
 * @param size of the character, in the space of the node's parent
 */
export function jointMotion(node: SceneNode, moves: readonly SceneMove[], size: number): JointMotion {
  const { translation, euler, role } = node;
  const scale = withoutNoise(node.scale);
  const rest = Float64Array.from(node.rotation);
  const [lengthNoise, scaleNoise] = [size, Math.max(...scale.map(Math.abs))].map((value) => NOISE * value);
  const movesBy = (curves: AxisCurves | undefined, values: Vec3, tolerance: number) =>
    curves?.some((curve, axis) => curve !== undefined && departs(curve, values[axis], tolerance)) ?? false;
  const isTranslated = role === 'hips' || moves.some((move) => movesBy(move.translation, translation, lengthNoise));
  const isScaled = scale.some((s) => s !== 1) || moves.some((move) => movesBy(move.scale, scale, scaleNoise));
  const paths = moves.flatMap(({ rotation }) => (rotation?.kind === 'turns' ? [visited(curveOf(rotation.track))] : []));
  const isTurning =
    paths.some((path) => turns(path, rest)) ||
    moves.some(
      ({ rotation }) => rotation?.kind === 'euler' && movesBy(rotation.angles, euler?.angles ?? [0, 0, 0], NOISE),
    );
  const isTurned =
    role !== undefined ||
    isTurning ||
    Math.hypot(rest[0], rest[1], rest[2]) > 1e-12 ||
    (euler?.angles.some((a) => a !== 0) ?? false);
  const clearest = euler?.order ?? clearestOrder(rest, paths);
  const isLocked = !euler && isTurning && worstOf(rest, paths, clearest) > LOCKED;
  const isQuaternion = isLocked && !isTranslated && !isScaled;
  const form: RotationForm = isQuaternion ? 'xyzw' : clearest;
  const angles = restDofs(node, rest, rotationDofs(form));

  const translated = (move: SceneMove | undefined) => axisChannels(move?.translation, translation, lengthNoise);
  const turnedBy = (move: SceneMove | undefined): readonly (Channel | TrackedDof)[] => {
    const rotation = move?.rotation;
    if (!rotation) return angles.map((value) => restChannel(value));
    if (rotation.kind === 'euler') return axisChannels(rotation.angles, euler?.angles ?? [0, 0, 0], NOISE);
    const tracked = { track: rotation.track, form, rest: angles };
    return angles.map((_, index) => ({ kind: 'tracked', rotation: tracked, index }));
  };
  const scaledBy = (move: SceneMove | undefined) => axisChannels(move?.scale, scale, scaleNoise);

  if (isScaled) {
    const factors: CompoundDof[] = [];
    if (isTranslated) factors.push('tx', 'ty', 'tz');
    // Letters of an order are axes; the first is applied first, so it is multiplied last.
    if (isTurned) factors.push(...[...clearest].reverse().map((axis) => `r${axis}` as CompoundDof));
    factors.push('sx', 'sy', 'sz');
    const at = (dof: CompoundDof) => 'xyz'.indexOf(dof[1]);
    const values = { t: translation, r: angles, s: scale };
    const kind = (dof: CompoundDof) => dof[0] as keyof typeof values;
    return {
      motion: { kind: 'compound', dofs: factors },
      offset: isTranslated ? [0, 0, 0] : translation,
      pose: factors.map((dof) => values[kind(dof)][at(dof)]),
      channels: (move) => {
        const all = { t: translated(move), r: isTurned ? turnedBy(move) : [], s: scaledBy(move) };
        return factors.map((dof) => all[kind(dof)][at(dof)]);
      },
    };
  }
  if (isTranslated && isTurned) {
    return {
      motion: { kind: 'free', order: clearest },
      offset: [0, 0, 0],
      pose: [...translation, ...angles],
      channels: (move) => [...translated(move), ...turnedBy(move)],
    };
  }
  if (isTranslated) {
    return { motion: { kind: 'translational' }, offset: [0, 0, 0], pose: translation, channels: translated };
  }
  if (!isTurned) return { motion: { kind: 'fixed' }, offset: translation, pose: [], channels: () => [] };
  const motion: Motion = isQuaternion ? { kind: 'quaternion' } : { kind: 'ball', order: clearest };
  return { motion, offset: translation, pose: angles, channels: turnedBy };
}

/** The rest as the joint's DOFs. */
function restDofs({ euler }: SceneNode, rest: Float64Array, dofs: RotationDofs): readonly number[] {
  if (euler) return euler.angles;
  const out = new Float64Array(dofs.count);
  if (dofs.count === 4) out.set(rest);
  else dofs.write(rest, out);
  return [...out];
}

function withoutNoise(scale: Vec3): Vec3 {
  const [x, y, z] = scale.map((s) => (Math.abs(s - 1) <= NOISE ? 1 : s));
  return [x, y, z];
}

/** The curves of three axes; those without one rest at their value, as do those that only tremble by noise. */
function axisChannels(curves: AxisCurves | undefined, values: Vec3, noise: number): readonly Channel[] {
  return values.map((value, axis) => {
    const curve = curves?.[axis];
    if (!curve || !departs(curve, value, noise)) return restChannel(value);
    const keys = keysOf(curve);
    const isConstant = keys.times.length > 0 && !departs(curve, keys.values[0], noise);
    return isConstant ? restChannel(keys.values[0]) : curve;
  });
}

/** Whether a channel is ever further than `tolerance` from a value. */
function departs(channel: Channel, value: number, tolerance: number): boolean {
  if (channel.kind === 'rest') return Math.abs(channel.value - value) > tolerance;
  const { times, values, tangentsIn, tangentsOut } = keysOf(channel);
  for (let k = 0; k < times.length; k++) {
    if (Math.abs(values[k] - value) > tolerance) return true;
    const seconds = Math.max((times[k + 1] ?? times[k]) - times[k], times[k] - (times[k - 1] ?? times[k]));
    if (Math.abs(tangentsIn.slopes[k]) * seconds > tolerance) return true;
    if (Math.abs(tangentsOut.slopes[k]) * seconds > tolerance) return true;
  }
  return false;
}

/** Whether a path of quaternions ever leaves a rotation. */
function turns(path: Float64Array, rest: Float64Array): boolean {
  for (let o = 0; o < path.length; o += 4) {
    const [x, y, z, w] = [path[o], path[o + 1], path[o + 2], path[o + 3]];
    const sign = x * rest[0] + y * rest[1] + z * rest[2] + w * rest[3] < 0 ? -1 : 1;
    const apart = Math.hypot(x - sign * rest[0], y - sign * rest[1], z - sign * rest[2], w - sign * rest[3]);
    if (2 * apart > NOISE) return true;
  }
  return false;
}

function clearestOrder(rest: Float64Array, paths: readonly Float64Array[]): EulerOrder {
  const worst = (order: EulerOrder) => worstOf(rest, paths, order);
  if (worst('xyz') < CLEAR) return 'xyz';
  return EULER_ORDERS.reduce((best, order) => (worst(order) < worst(best) ? order : best));
}

/** The nearest that a rotation comes to gimbal lock in an order. */
function worstOf(rest: Float64Array, paths: readonly Float64Array[], order: EulerOrder): number {
  return paths.reduce((most, path) => Math.max(most, lockedness(order, path)), lockedness(order, rest));
}
