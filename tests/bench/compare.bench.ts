/**
 * `marrow compare` on a frame of 240 joints and 31,000 vertices with an animation of 723 channels: the search for
 * mistakes, against posing and skinning the same frame once. Goal: under 2 s where nothing explains the numbers, the
 * longest search.
 */
import { bench, describe } from 'vitest';
import { runToEnd } from '../../src/evaluate/steps.ts';
import type { Character } from '../../src/model/document.ts';
import { oneSurface, type Skin } from '../../src/model/skin.ts';
import type { Take } from '../../src/model/takes/take.ts';
import { SMOOTH } from '../../src/model/takes/tangent-kinds.ts';
import { CATALOGUE } from '../../src/teaching/catalogue/all.ts';
import { compare } from '../../src/teaching/compare/compare.ts';
import type { Targets } from '../../src/teaching/compare/targets.ts';
import { Evaluator } from '../../src/teaching/program/evaluator.ts';
import { type Program, RIGHT_PROGRAM } from '../../src/teaching/program/program.ts';
import { character, joint } from '../helpers/builders.ts';
import { random } from '../teaching/planted.ts';

const JOINTS = 240;
const VERTICES = 31_000;
const KEYS = 5;
const TIME = -3.21;
const ALL = { local: false, vertices: true, normals: true };

const noise = random(1);
/** −1 to 1. */
const some = () => 2 * noise.next().value - 1;

function bigCharacter(): Character {
  const joints = Array.from({ length: JOINTS }, (_, j) =>
    joint(j === 0 ? -1 : j % 7 === 0 ? Math.max(0, j - 7) : j - 1, {
      offset: [some(), some(), some()],
      limits: [0, 1, 2].map(() => ({ min: -1.2, max: 1.2 })),
    }),
  );
  const tangents = { kinds: new Uint8Array(KEYS).fill(SMOOTH), slopes: new Float64Array(KEYS) };
  const take: Take = {
    name: 'big',
    range: [0, 3],
    channels: Array.from({ length: 3 + 3 * JOINTS }, () => ({
      kind: 'keys',
      extrapolateIn: 'cycle_offset',
      extrapolateOut: 'bounce',
      times: Float64Array.of(0, 0.4, 1.1, 1.7, 2.2),
      values: Float64Array.from({ length: KEYS }, some),
      tangentsIn: tangents,
      tangentsOut: tangents,
    })),
  };
  const bare = character({ skeleton: { name: 'big', joints } });
  const bindings = new Evaluator(bare).frame(RIGHT_PROGRAM, undefined, ALL).world.slice();
  const skin = bigSkin(bindings);
  return { ...bare, skins: [skin], shownSkin: 0, takes: [take], shownTake: 0 };
}

function bigSkin(bindings: Float64Array): Skin {
  const start = new Uint32Array(VERTICES + 1);
  const joints: number[] = [];
  const weights: number[] = [];
  for (let v = 0; v < VERTICES; v++) {
    const count = 1 + (v % 5);
    for (let a = 0; a < count; a++) {
      joints.push((7 * v + a) % JOINTS);
      weights.push(1 / count);
    }
    start[v + 1] = joints.length;
  }
  return {
    name: 'big',
    positions: Float64Array.from({ length: 3 * VERTICES }, some),
    normals: Float64Array.from({ length: 3 * VERTICES }, some),
    attachments: { start, joints: Uint32Array.from(joints), weights: Float64Array.from(weights) },
    triangles: new Uint32Array(0),
    surfaces: oneSurface(new Uint32Array(0)),
    bindings,
  };
}

const big = bigCharacter();
const evaluator = new Evaluator(big);

/** Six digits of all numbers of a program, times a factor. */
function printed(program: Program, factor = 1): Targets {
  const { world, vertices, normals } = evaluator.frame(program, TIME, ALL);
  const round = (values: Float64Array) => values.map((value) => Number((factor * value).toFixed(6)));
  const frame = { time: TIME, world: round(world), vertices: round(vertices), normals: round(normals) };
  const channels = { channels: new Uint32Array(0), times: new Float64Array(0), values: new Float64Array(0) };
  return { frames: [frame], channels };
}

function withMistakes(...codes: readonly string[]): Program {
  return codes.reduce((program, code) => {
    const mistake = CATALOGUE.find((each) => each.code === code);
    if (!mistake) throw new Error(`There is no mistake ${code}.`);
    return mistake.variants[0].apply(program);
  }, RIGHT_PROGRAM);
}

describe('240 joints and 31,000 vertices', () => {
  const single = printed(withMistakes('concatenation-order'));
  const pair = printed(withMistakes('concatenation-order', 'rotation-sign'));
  const unknown = printed(RIGHT_PROGRAM, 1.1);
  const options = { time: 2000, warmupTime: 500 };

  bench('posing and skinning once', () => void evaluator.frame(RIGHT_PROGRAM, TIME, ALL), options);
  bench('one mistake named', () => void runToEnd(compare(big, single)), options);
  bench('two mistakes named', () => void runToEnd(compare(big, pair)), options);
  bench('nothing explains it', () => void runToEnd(compare(big, unknown)), options);
});
