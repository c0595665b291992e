/** Arguments of the commands of rigging, checked; each refuses with a `CommandError` that says what was expected. */
import type { Vec3 } from '../../math/vec3.ts';
import {
  AXIS_PAIRS,
  type BvhChannel,
  COMPOUND_DOFS,
  EULER_ORDERS,
  type Motion,
  SCALE_MODES,
} from '../../model/skeleton.ts';
import { finiteNumber, listOf, oneOf } from '../arguments.ts';
import { CommandError } from '../store.ts';

export function vector(value: unknown, what: string): Vec3 {
  const parts = listOf(value, what);
  if (parts.length !== 3) throw new CommandError(`${what} has to have 3 numbers; it has ${parts.length}.`);
  return [
    finiteNumber(parts[0], `x of ${lower(what)}`),
    finiteNumber(parts[1], `y of ${lower(what)}`),
    finiteNumber(parts[2], `z of ${lower(what)}`),
  ];
}

/** A text that may be empty. */
export function jointName(value: unknown): string {
  if (typeof value === 'string') return value;
  throw new CommandError('The name of a joint has to be a text.');
}

const KINDS: readonly Motion['kind'][] = [
  'ball',
  'hinge',
  'universal',
  'quaternion',
  'prismatic',
  'translational',
  'free',
  'screw',
  'scale',
  'shear',
  'fixed',
  'compound',
  'bvh',
];

const BVH_CHANNELS: readonly BvhChannel[] = ['tx', 'ty', 'tz', 'rx', 'ry', 'rz'];

/** A motion with what its kind takes, and nothing else. */
export function checkedMotion(motion: Motion): Motion {
  const kind = oneOf(motion?.kind, KINDS, 'The type of a joint');
  // Only fields of its kind are asked for, whatever else the value that was given has.
  const given = motion as unknown as Readonly<Record<string, unknown>>;
  switch (kind) {
    case 'ball':
    case 'free':
      return { kind, order: oneOf(given.order, EULER_ORDERS, 'The order') };
    case 'universal':
      return { kind, order: oneOf(given.order, AXIS_PAIRS, 'The order') };
    case 'hinge':
    case 'prismatic':
      return { kind, axis: axisOf(given.axis) };
    case 'screw':
      return { kind, axis: axisOf(given.axis), pitch: finiteNumber(given.pitch, 'The pitch') };
    case 'scale':
      return { kind, mode: oneOf(given.mode, SCALE_MODES, 'The mode'), axis: axisOf(given.axis) };
    case 'compound':
      return { kind, dofs: eachOnce(given.dofs, COMPOUND_DOFS, 'The DOFs of a compound joint') };
    case 'bvh': {
      const positions = oneOf(given.positions, ['replace', 'add'] as const, 'What position channels mean');
      return { kind, channels: eachOnce(given.channels, BVH_CHANNELS, 'The channels'), positions };
    }
    case 'quaternion':
    case 'translational':
    case 'shear':
    case 'fixed':
      return { kind };
  }
}

function axisOf(value: unknown): Vec3 {
  const axis = vector(value, 'The axis');
  if (axis.every((part) => part === 0)) throw new CommandError('An axis has to have a direction; 0 0 0 has none.');
  return axis;
}

function eachOnce<T>(value: unknown, allowed: readonly T[], what: string): readonly T[] {
  const all = listOf(value, what).map((one) => oneOf(one, allowed, `Each of ${lower(what)}`));
  const twice = all.find((one, i) => all.indexOf(one) !== i);
  if (twice !== undefined) throw new CommandError(`${what} have ${String(twice)} twice.`);
  return all;
}

function lower(what: string): string {
  return what.charAt(0).toLowerCase() + what.slice(1);
}
