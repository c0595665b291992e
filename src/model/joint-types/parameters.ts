/** The parameters that motions have: what their values can be, how they are called, and what another type inherits. */
import type { Vec3 } from '../../math/vec3.ts';
import {
  AXIS_PAIRS,
  COMPOUND_DOFS,
  type CompoundDof,
  EULER_ORDERS,
  type EulerOrder,
  SCALE_MODES,
  type ScaleMode,
} from '../skeleton.ts';

/** What a joint whose type is changed passes on to its new type. */
export interface Inherited {
  readonly axis: Vec3 | undefined;
  /** The one-DOF matrices of its motion, from left to right; none where it is no product of such. */
  readonly factors: readonly CompoundDof[];
}

interface Named {
  /** At the beginning of a message: `The order`. */
  readonly subject: string;
  /** Of its row in the inspector; absent for what is not changed there. */
  readonly label?: string;
  /** The value after the type was changed; absent: that of the type's `initial`. */
  inherit?(from: Inherited): ParameterValues[Parameter['type']];
}

/** One word out of a few. */
export interface ChoiceParameter extends Named {
  readonly type: 'choice';
  readonly choices: readonly string[];
  /** A choice as the inspector lists it. */
  describe(choice: string): string;
}

/** Words out of a few, each at most once. */
export interface ListParameter extends Named {
  readonly type: 'list';
  readonly choices: readonly string[];
}

/** A vector of any length but 0. */
export interface AxisParameter extends Named {
  readonly type: 'axis';
}

/** A finite number. */
export interface NumberParameter extends Named {
  readonly type: 'number';
}

export type Parameter = ChoiceParameter | ListParameter | AxisParameter | NumberParameter;

/** What a parameter's values are, by its type. */
export interface ParameterValues {
  readonly choice: string;
  readonly list: readonly string[];
  readonly axis: Vec3;
  readonly number: number;
}

/** The default direction of an axis. */
export const X: Vec3 = [1, 0, 0];

export const AXIS: Parameter = {
  type: 'axis',
  subject: 'The axis',
  label: 'Axis',
  inherit: ({ axis }) => axis ?? X,
};

/** How far a whole turn advances along the axis. */
export const PITCH: Parameter = { type: 'number', subject: 'The pitch', label: 'Pitch per turn', inherit: () => 1 };

const ORDER = {
  type: 'choice',
  subject: 'The order',
  label: 'Order',
  describe: (order: string) => `${order}: ${order[0]} first`,
} as const;

export const EULER_ORDER: Parameter = { ...ORDER, choices: EULER_ORDERS, inherit: inheritedOrder };

export const PAIR_ORDER: Parameter = {
  ...ORDER,
  choices: AXIS_PAIRS,
  inherit: (from) => AXIS_PAIRS.find((pair) => inheritedOrder(from).startsWith(pair)) ?? 'xy',
};

/** Of three letters; the two of a universal joint come first. */
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

export const MODE: Parameter = {
  type: 'choice',
  subject: 'The mode',
  label: 'Mode',
  choices: SCALE_MODES,
  // Only what is in `choices` is asked about.
  describe: (mode) => MODE_LABELS[mode as ScaleMode],
};

export const COMPOUND: Parameter = {
  type: 'list',
  subject: 'The DOFs of a compound joint',
  label: 'DOFs',
  choices: COMPOUND_DOFS,
  inherit: ({ factors }) => (factors.length ? factors : ['rx']),
};
