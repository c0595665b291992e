/**
 * The joint types of `.skel`: a joint's keyword and its own tokens, which are the parameters of its type
 * (`model/joint-types.ts`). Such a token changes the motion; what every joint has (offset, box, limits, pose) is in
 * `read.ts`.
 */
import type { Parameter, ParameterValues } from '../../model/joint-types/parameters.ts';
import type { JointType } from '../../model/joint-types/type.ts';
import {
  isOfBvh,
  JOINT_TYPES,
  jointTypeOf,
  parameterOf,
  parametersOf,
  withParameter,
} from '../../model/skeleton/joint-types.ts';
import type { Motion } from '../../model/skeleton/skeleton.ts';
import type { GrammarPart } from '../grammar.ts';
import type { Keywords, Tokens } from '../tokens.ts';
import { listOfWords, numberToken, oneOfWords, vectorToken } from './own-tokens.ts';

/** A type that `.skel` has: BVH's joints are converted first (`model/skel-motion.ts`), and points can't be. */
export interface SkelType {
  /** `balljoint`. */
  readonly keyword: string;
  /** The motion without any of its own tokens. */
  readonly motion: Motion;
  readonly tokens: ReadonlyMap<string, Parameter>;
}

/** All joint types that `.skel` has, each with its keyword, default motion and tokens. */
export const SKEL_TYPES: readonly SkelType[] = Object.values<JointType>(JOINT_TYPES)
  .filter(({ format }) => format !== 'bvh' && format !== 'points')
  .map(({ keyword, initial }) => ({ keyword, motion: initial, tokens: new Map(parametersOf(initial)) }));

const BY_KEYWORD = new Map(SKEL_TYPES.map((type) => [type.keyword, type]));

/** The joint type of a keyword in lower case, such as `hingejoint`; undefined if there is none. */
export function skelTypeOf(keyword: string): SkelType | undefined {
  return BY_KEYWORD.get(keyword);
}

/** A joint's keyword in the file. Throws for a BVH joint, which `.skel` does not have. */
export function keywordOf(motion: Motion): string {
  if (isOfBvh(motion)) throw new Error('A BVH joint has to be converted before it is written to .skel.');
  return jointTypeOf(motion).keyword;
}

/** Reads one of a type's own tokens, the current one, into a motion of that type; unchanged after an error. */
export function* readOwn(
  t: Tokens,
  token: string,
  parameter: Parameter,
  motion: Motion,
  keywords: Keywords,
): GrammarPart<Motion> {
  const value = yield* readValue(t, token, parameter, keywords);
  return value === undefined ? motion : withParameter(motion, token, value);
}

function* readValue(
  t: Tokens,
  token: string,
  parameter: Parameter,
  keywords: Keywords,
): GrammarPart<ParameterValues[Parameter['type']] | undefined> {
  switch (parameter.type) {
    case 'choice':
      return yield* oneOfWords(t, token, parameter.choices, keywords);
    case 'list':
      return yield* listOfWords(t, token, parameter.choices, keywords);
    case 'number':
      return yield* numberToken(t, token, keywords);
    case 'angles':
      return yield* vectorToken(t, token, keywords);
    case 'axis': {
      const place = t.mark();
      const found = yield* vectorToken(t, token, keywords);
      if (!found || found.some((part) => part !== 0)) return found;
      t.report.error('axis-zero', 'Expected an axis with a direction, found 0 0 0.', t.placeOf(place, 'error'));
      return undefined;
    }
  }
}

/** Lines of a type's own tokens for a motion; none for defaults. */
export function ownLines(motion: Motion, numbers: (values: readonly number[]) => string): readonly string[] {
  const { initial } = jointTypeOf(motion);
  return parametersOf(motion).flatMap(([token, { type }]) => {
    const words = (of: Motion) => [parameterOf(of, token, type) ?? []].flat();
    const own = words(motion);
    const usual = words(initial);
    if (own.length === usual.length && own.every((word, i) => Object.is(word, usual[i]))) return [];
    return [[token, ...own.map((word) => (typeof word === 'number' ? numbers([word]) : word))].join(' ')];
  });
}

/** The classic tokens for the limits of a ball joint's DOFs; all other DOFs use `limit NAME min max`. */
export const LIMIT_TOKENS: Readonly<Record<string, string>> = { rx: 'rotxlimit', ry: 'rotylimit', rz: 'rotzlimit' };
