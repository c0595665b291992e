/** Parameters of motions: their possible values, their names, and what another type inherits. */
import type { Vec3 } from '../../math/vec3.ts';
import {
  AXIS_PAIRS,
  COMPOUND_DOFS,
  type CompoundDof,
  EULER_ORDERS,
  type EulerOrder,
  SCALE_MODES,
  type ScaleMode,
} from '../skeleton/skeleton.ts';

/** Values that a joint passes on to its new type. */
export interface Inherited {
  readonly axis: Vec3 | undefined;
  /** The motion as one-DOF matrices, from left to right; empty if it is no such product. */
  readonly factors: readonly CompoundDof[];
}

interface Named {
  /** How messages begin: `The order`. */
  readonly subject: string;
  /** Label of its row in the inspector; absent if it can't be edited there. */
  readonly label?: string;
  /** The value after a change of type; absent: that of the type's `initial`. */
  inherit?(from: Inherited): ParameterValues[Parameter['type']];
}

/** One of several words. */
export interface ChoiceParameter extends Named {
  readonly type: 'choice';
  readonly choices: readonly string[];
  /** A choice as the inspector lists it. */
  describe(choice: string): string;
}

/** Several of a set of words, each at most once. */
export interface ListParameter extends Named {
  readonly type: 'list';
  readonly choices: readonly string[];
}

/** A vector of any length except 0. */
export interface AxisParameter extends Named {
  readonly type: 'axis';
}

/** Three angles in radians. */
export interface AnglesParameter extends Named {
  readonly type: 'angles';
}

/** A finite number. */
export interface NumberParameter extends Named {
  readonly type: 'number';
}

/** The shape of one parameter of a motion, told by `type`: a choice, a list of choices, an axis, angles or a number. */
export type Parameter = ChoiceParameter | ListParameter | AxisParameter | AnglesParameter | NumberParameter;

/** The value of each type of parameter. */
export interface ParameterValues {
  readonly choice: string;
  readonly list: readonly string[];
  readonly axis: Vec3;
  readonly angles: Vec3;
  readonly number: number;
}

/** The default direction of an axis. */
export const X: Vec3 = [1, 0, 0];

/** The axis of a joint that turns about, slides along or scales along it; by default the previous type's axis, or x. */
export const AXIS: Parameter = {
  type: 'axis',
  subject: 'The axis',
  label: 'Axis',
  inherit: ({ axis }) => axis ?? X,
};

/** Advance along the axis per full turn. */
export const PITCH: Parameter = { type: 'number', subject: 'The pitch', label: 'Pitch per turn', inherit: () => 1 };

const ORDER = {
  type: 'choice',
  subject: 'The order',
  label: 'Order',
  describe: (order: string) => `${order}: ${order[0]} first`,
} as const;

/** The order of three rotations; by default that of the previous type's rotations, or xyz. */
export const EULER_ORDER: Parameter = { ...ORDER, choices: EULER_ORDERS, inherit: inheritedOrder };

/** The order of a universal joint's two rotations; by default the first two of the previous type's order, or xy. */
export const PAIR_ORDER: Parameter = {
  ...ORDER,
  choices: AXIS_PAIRS,
  inherit: (from) => AXIS_PAIRS.find((pair) => inheritedOrder(from).startsWith(pair)) ?? 'xy',
};

/** The three letters of an order; those of a universal joint come first. */
function inheritedOrder({ factors }: Inherited): EulerOrder {
  const applied = factors.filter((name) => name.startsWith('r')).reverse();
  const letters = applied.map((name) => name[1]).join('');
  return EULER_ORDERS.find((order) => order.startsWith(letters)) ?? 'xyz';
}

const MODE_LABELS: Readonly<Record<ScaleMode, string>> = {
  uniform: 'Uniform',
  xyz: 'Per axis',
  axis: 'Along an axis',
  volume: 'Along an axis, volume preserved',
};

/** The mode of a scale joint; see `SCALE_MODES`. */
export const MODE: Parameter = {
  type: 'choice',
  subject: 'The mode',
  label: 'Mode',
  choices: SCALE_MODES,
  // Only called for values in `choices`.
  describe: (mode) => MODE_LABELS[mode as ScaleMode],
};

/** The DOFs of a compound joint; by default the one-DOF factors of the previous type, or rx. */
export const COMPOUND: Parameter = {
  type: 'list',
  subject: 'The DOFs of a compound joint',
  label: 'DOFs',
  choices: COMPOUND_DOFS,
  inherit: ({ factors }) => (factors.length ? factors : ['rx']),
};
