/** Numbers that the kit's files evaluate to, and which known mistakes each set tells apart. */

import { openFiles } from '../../files/open/open-files.ts';
import { formatOf } from '../../files/readers.ts';
import { type Character, EMPTY_DOCUMENT, shownTake } from '../../model/document.ts';
import type { ParsedFile } from '../../model/files.ts';
import { CATALOGUE } from '../catalogue/all.ts';
import type { Variant } from '../catalogue/mistake.ts';
import { diagonalOf, matrixError, pointError } from '../compare/errors.ts';
import { channelValue } from '../program/curve-rules.ts';
import { Evaluator, type FrameNumbers } from '../program/evaluator.ts';
import { type Program, RIGHT_PROGRAM } from '../program/program.ts';
import { KIT_SETS, type KitSet, kitFiles } from './files.ts';

/** A mistake must change a number by this much to be told from rounding: a hundred times what comparing tolerates. */
export const TELLING = 0.01;

/** The right numbers of a set, as `answers.json` has them. */
export interface SetAnswers {
  readonly name: string;
  readonly about: string;
  readonly files: readonly string[];
  /** Codes of the mistakes that change a number here. */
  readonly tells: readonly string[];
  readonly frames?: readonly FrameAnswers[];
  readonly channels?: ChannelAnswers;
}

/** The right numbers of one frame. */
export interface FrameAnswers {
  /** Seconds; absent: the pose of the file, without the animation. */
  readonly time?: number;
  readonly joints: readonly JointAnswer[];
  /** x y z per vertex. */
  readonly vertices?: readonly (readonly number[])[];
  readonly normals?: readonly (readonly number[])[];
}

/** The right matrices of a joint: 16 numbers each. */
export interface JointAnswer {
  readonly name: string;
  /** By columns: the last four are x y z 1 of its position. */
  readonly world: readonly number[];
  readonly local: readonly number[];
}

/** The right values of channels: angles in radians. */
export interface ChannelAnswers {
  readonly times: readonly number[];
  /** Values of each channel, at each time. */
  readonly values: readonly (readonly number[])[];
}

/** Evaluates all sets of the test kit. */
export function setAnswers(): readonly SetAnswers[] {
  const files = kitFiles();
  return KIT_SETS.map((set) => answersOf(set, characterOf(set.files, files)));
}

/**
 * A character of some of the kit's files.
 * @throws Error if a file of the kit has an error
 */
export function characterOf(names: readonly string[], files: ReadonlyMap<string, string>): Character {
  const read = names.map((name): ParsedFile => {
    const bytes = new TextEncoder().encode(files.get(name) ?? '');
    const reader = formatOf(name)?.reader(name, bytes.length);
    reader?.feed(bytes);
    const { value, diagnostics = [] } = reader?.end() ?? {};
    if (!value)
      throw new Error(`${name} of the test kit can't be read: ${diagnostics[0]?.message ?? 'unknown format'}`);
    return { ...value, source: { name, path: name, bytes: bytes.length } };
  });
  return openFiles(EMPTY_DOCUMENT, read).document.characters[0];
}

function answersOf(set: KitSet, character: Character): SetAnswers {
  const { name, about, files, times, channelTimes } = set;
  const evaluator = new Evaluator(character);
  const frames = times.map((time) => frameAnswers(character, evaluator, time));
  const tells = CATALOGUE.filter(({ variants }) => variants.some((variant) => tellsApart(set, character, variant)));
  return {
    name,
    about,
    files,
    tells: tells.map(({ code }) => code),
    ...(frames.length > 0 && { frames }),
    ...(channelTimes.length > 0 && {
      channels: { times: channelTimes, values: channelValues(character, channelTimes, RIGHT_PROGRAM) },
    }),
  };
}

const ALL = { local: true, vertices: true, normals: true };

function frameAnswers(character: Character, evaluator: Evaluator, time: number | undefined): FrameAnswers {
  const { world, local, vertices, normals } = evaluator.frame(RIGHT_PROGRAM, time, ALL);
  const joints = (character.skeleton?.joints ?? []).map(({ name }, j) => ({
    name: name || String(j),
    world: Array.from(world.subarray(16 * j, 16 * j + 16)),
    local: Array.from(local.subarray(16 * j, 16 * j + 16)),
  }));
  return {
    ...(time !== undefined && { time }),
    joints,
    ...(vertices.length > 0 && { vertices: triples(vertices), normals: triples(normals) }),
  };
}

function triples(values: Float64Array): number[][] {
  return Array.from({ length: values.length / 3 }, (_, i) => Array.from(values.subarray(3 * i, 3 * i + 3)));
}

function channelValues(character: Character, times: readonly number[], { curves }: Program): number[][] {
  const take = shownTake(character);
  return (take?.channels ?? []).map((channel) =>
    times.map((time) => channelValue(channel, take?.range ?? [0, 1], time, curves)),
  );
}

/** Whether a program with this mistake prints a number of the set that is clearly another. */
export function tellsApart({ times, channelTimes }: KitSet, character: Character, variant: Variant): boolean {
  const program = variant.apply(RIGHT_PROGRAM);
  if (program.curves !== RIGHT_PROGRAM.curves) {
    const [right, wrong] = [RIGHT_PROGRAM, program].map((each) => channelValues(character, channelTimes, each).flat());
    if (right.some((value, i) => !(Math.abs(value - wrong[i]) <= TELLING))) return true;
  }
  return times.some((time) => {
    const right = copyOf(new Evaluator(character).frame(RIGHT_PROGRAM, time, ALL));
    return differs(right, new Evaluator(character).frame(program, time, ALL));
  });
}

function copyOf({ world, local, vertices, normals }: FrameNumbers): FrameNumbers {
  return { world: world.slice(), local: local.slice(), vertices: vertices.slice(), normals: normals.slice() };
}

function differs(right: FrameNumbers, wrong: FrameNumbers): boolean {
  const size = right.vertices.length > 0 ? diagonalOf(right.vertices, 3, 0) : diagonalOf(right.world, 16, 12);
  for (let o = 0; o < right.world.length; o += 16) {
    if (!(matrixError(right.world, wrong.world, o, size) <= TELLING)) return true;
  }
  for (let o = 0; o < right.vertices.length; o += 3) {
    if (!(pointError(right.vertices, o, wrong.vertices, o, size) <= TELLING)) return true;
    if (!(pointError(right.normals, o, wrong.normals, o, 1) <= TELLING)) return true;
  }
  return false;
}
