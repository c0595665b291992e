/** Argument checks of rigging commands; each throws a `CommandError` that says what was expected. */
import type { Vec3 } from '../../math/vec3.ts';
import type { Parameter, ParameterValues } from '../../model/joint-types/parameters.ts';
import { MOTION_KINDS, parametersOf } from '../../model/joint-types.ts';
import type { Motion } from '../../model/skeleton.ts';
import { finiteNumber, listOf, oneOf } from '../arguments.ts';
import { CommandError } from '../store.ts';

export function vector(value: unknown, what: string): Vec3 {
  const parts = listOf(value, what);
  if (parts.length !== 3) throw new CommandError(`${what} must have 3 numbers, found ${parts.length}.`);
  return [
    finiteNumber(parts[0], `x of ${lower(what)}`),
    finiteNumber(parts[1], `y of ${lower(what)}`),
    finiteNumber(parts[2], `z of ${lower(what)}`),
  ];
}

/** Text that may be empty. */
export function checkedName(value: unknown): string {
  if (typeof value === 'string') return value;
  throw new CommandError('The name of a joint must be text.');
}

/** A motion with exactly the parameters of its kind. */
export function checkedMotion(motion: Motion): Motion {
  const kind = oneOf(motion?.kind, MOTION_KINDS, 'The type of a joint');
  // Only parameters of its kind are read, whatever else the value contains.
  const given: ReadonlyMap<string, unknown> = new Map(Object.entries(motion));
  const values = parametersOf({ kind }).map(([name, parameter]) => [
    name,
    checkedParameter(given.get(name), parameter),
  ]);
  // All parameters of its kind, each with a value of its own type.
  return { kind, ...Object.fromEntries(values) } as Motion;
}

function checkedParameter(value: unknown, parameter: Parameter): ParameterValues[Parameter['type']] {
  const { subject } = parameter;
  switch (parameter.type) {
    case 'choice':
      return oneOf(value, parameter.choices, subject);
    case 'list':
      return eachOnce(value, parameter.choices, subject);
    case 'axis':
      return checkedAxis(value, subject);
    case 'number':
      return finiteNumber(value, subject);
  }
}

function checkedAxis(value: unknown, subject: string): Vec3 {
  const axis = vector(value, subject);
  if (axis.every((part) => part === 0)) throw new CommandError('An axis needs a direction; 0 0 0 has none.');
  return axis;
}

function eachOnce<T>(value: unknown, allowed: readonly T[], what: string): readonly T[] {
  const all = listOf(value, what).map((one) => oneOf(one, allowed, `Each of ${lower(what)}`));
  const twice = all.find((one, i) => all.indexOf(one) !== i);
  if (twice !== undefined) throw new CommandError(`${what} list ${String(twice)} twice.`);
  return all;
}

function lower(what: string): string {
  return what.charAt(0).toLowerCase() + what.slice(1);
}
