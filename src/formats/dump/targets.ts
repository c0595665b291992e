/**
 * Statements of dumps of inverse kinematics about their solver: where it shall bring which point, and that they are of
 * one step.
 *
 *     target hand 0.3 1.2 0              the joint's name or index, then the place; a comment too
 *     target hand@0,0.5,0 = 0.3 1.2 0    a point of the joint, by default its tip, or its origin
 *     one step                           also `after 1 step`, `steps 1`
 */
import type { Vec3 } from '../../math/vec3.ts';
import type { DumpLabel, DumpTarget } from '../../model/dump.ts';
import { labelWith } from './labels.ts';
import { isIndex, isStrange, numbersOf, tokensOf } from './tokens.ts';

const TARGET = /^\W*(?:ik[ _-]?)?(?:target|goal)s?\b(?![.-]\w)(?!.*\b(?:fps|frames?|seconds?)\b)/i;
const ONE_STEP =
  /^\W*(?:after\s+)?(?:one|1)\s+(?:ik\s+)?(?:step|iteration)\W*$|^\W*(?:steps|iterations)\s*[:=]?\s*1\W*$/i;
const MAX_LENGTH = 200;

/** Whether a line says that the solver made a single step. */
export function statesOneStep(line: string): boolean {
  return line.length < MAX_LENGTH && ONE_STEP.test(line);
}

/** The target in a line; undefined if it states none. */
export function targetIn(line: string): Omit<DumpTarget, 'line'> | undefined {
  const found = line.length < MAX_LENGTH ? TARGET.exec(line) : null;
  if (!found) return undefined;
  const { tokens, more } = tokensOf(line.slice(found[0].length));
  const numbers = numbersOf(tokens, more);
  const first = tokens.find(({ kind }) => kind === 'number');
  const hasPoint = tokens.some(({ text }) => text === '@');
  const isIndexed = first !== undefined && isIndex(first) && (numbers.length === 4 || numbers.length === 7);
  const [index, ...others] = isIndexed ? numbers : [undefined, ...numbers];
  if (others.length !== (hasPoint ? 6 : 3)) return undefined;
  const words = tokens.filter(isStrange).map(({ text }) => text);
  const of = labelWith(index, words.length > 0 ? words.join(' ') : undefined);
  const point = hasPoint ? triple(others.slice(0, 3)) : undefined;
  const position = triple(others.slice(-3));
  return position && { of, ...(point && { point }), position };
}

/** The targets in the value of a key such as `targets`; undefined if it has another form. */
export function targetsOf(value: unknown): readonly Omit<DumpTarget, 'line'>[] | undefined {
  if (Array.isArray(value)) {
    const all = value.map(targetOf);
    return all.length > 0 && all.every((one) => one !== undefined) ? all : undefined;
  }
  const one = targetOf(value);
  if (one) return [one];
  if (!isObject(value)) return undefined;
  const named = Object.entries(value).map(([name, place]) => {
    const position = placeOf(place);
    return position && { of: labelOfKey(name), position };
  });
  return named.length > 0 && named.every((each) => each !== undefined) ? named : undefined;
}

function targetOf(value: unknown): Omit<DumpTarget, 'line'> | undefined {
  if (!isObject(value)) return undefined;
  const position = placeOf(value.position ?? value.target ?? value.goal ?? value.at);
  if (!position) return undefined;
  const joint = value.joint ?? value.name ?? value.index ?? value.bone ?? value.effector ?? value.endEffector;
  const point = placeOf(value.point);
  const of =
    typeof joint === 'number' ? labelWith(joint, undefined) : typeof joint === 'string' ? labelOfKey(joint) : null;
  return { of, ...(point && { point }), position };
}

function labelOfKey(name: string): DumpLabel | null {
  return /^#?\d+$/.test(name) ? labelWith(Number(name.replace('#', '')), undefined) : labelWith(undefined, name);
}

function placeOf(value: unknown): Vec3 | undefined {
  if (Array.isArray(value)) return triple(value);
  return isObject(value) ? triple([value.x, value.y, value.z]) : undefined;
}

function triple(values: readonly unknown[]): Vec3 | undefined {
  const [x, y, z] = values;
  const isPlace = values.length === 3 && typeof x === 'number' && typeof y === 'number' && typeof z === 'number';
  return isPlace && Number.isFinite(x + y + z) ? [x, y, z] : undefined;
}

function isObject(value: unknown): value is Readonly<Record<string, unknown>> {
  return typeof value === 'object' && value !== null && !Array.isArray(value);
}
