/** The shape of a joint's motion, as commands take it: its kind, with the parameters of that kind and no others. */
import type { Vec3 } from '../../math/vec3.ts';
import type { Parameter } from '../../model/joint-types/parameters.ts';
import { MOTION_KINDS, parametersOf } from '../../model/skeleton/joint-types.ts';
import type { Motion } from '../../model/skeleton/skeleton.ts';
import { CommandError } from '../command-error.ts';
import { list, misfit, number, oneOf, type Shape } from '../schema/shape.ts';
import { vector } from '../schema/shared-shapes.ts';

const kind = oneOf(MOTION_KINDS);

const axis: Shape<Vec3> = {
  what: vector.what,
  read(value, path) {
    const read = vector.read(value, path);
    if (read.some((part) => part !== 0)) return read;
    throw new CommandError('An axis needs a direction; 0 0 0 has none.');
  },
};

/**
 * The shape of a motion in arguments of commands; it refuses parameters that the kind lacks or that are out of range.
 */
export const motion: Shape<Motion> = {
  what: `{ kind: ${kind.what}; ${parametersInWords()} }`,
  read(value, path) {
    if (typeof value !== 'object' || value === null) throw misfit(path, 'a type of joint with its parameters', value);
    const field = (name: string): unknown => (Object.hasOwn(value, name) ? Reflect.get(value, name) : undefined);
    const own = { kind: kind.read(field('kind'), `${path}.kind`) };
    const values = parametersOf(own).map(([name, parameter]) => [
      name,
      shapeOf(parameter).read(field(name), `${path}.${name}`),
    ]);
    // All parameters of its kind, each with a value of its own type.
    return { ...own, ...Object.fromEntries(values) } as Motion;
  },
};

/** A motion with exactly the parameters of its kind, in a fixed order. @throws CommandError if it is none */
export function checkedMotion(given: Motion): Motion {
  return motion.read(given, 'motion');
}

/** Each parameter once, with what it must be; those of the same name and choices are the same for several kinds. */
function parametersInWords(): string {
  const words = MOTION_KINDS.flatMap((one) =>
    parametersOf({ kind: one }).map(([name, parameter]) => `${name}, if of its kind: ${shapeOf(parameter).what}`),
  );
  return [...new Set(words)].join('; ');
}

function shapeOf(parameter: Parameter): Shape<unknown> {
  switch (parameter.type) {
    case 'choice':
      return oneOf(parameter.choices);
    case 'list':
      return eachOnce(parameter.choices);
    case 'axis':
      return axis;
    case 'angles':
      return vector;
    case 'number':
      return number;
  }
}

function eachOnce(choices: readonly string[]): Shape<readonly string[]> {
  const all = list(oneOf(choices));
  return {
    what: `${all.what}, each once`,
    read(value, path) {
      const read = all.read(value, path);
      const twice = read.find((one, i) => read.indexOf(one) !== i);
      if (twice === undefined) return read;
      throw new CommandError(`"${path}" lists ${twice} twice.`);
    },
  };
}
