import { describe, expect, it } from 'vitest';
import { compileTake } from '../../src/evaluate/compiled-take.ts';
import { evaluateChannel } from '../../src/evaluate/curves.ts';
import { compileSkeleton, localMatrices, worldMatrices } from '../../src/evaluate/kinematics.ts';
import { dofCountOf, poseAt } from '../../src/evaluate/pose.ts';
import { blendMorphs, compileSkin, deform } from '../../src/evaluate/skin/deform.ts';
import { type Character, shownSkin, shownTake } from '../../src/model/document.ts';
import { channelValue, RIGHT_CURVES } from '../../src/teaching/program/curve-rules.ts';
import { Evaluator } from '../../src/teaching/program/evaluator.ts';
import { RIGHT_PROGRAM } from '../../src/teaching/program/program.ts';
import { describeShared } from '../helpers/shared.ts';
import { characterOf, OWN, SHARED } from './lesson-files.ts';

/** Relative to the largest number. */
const WITHIN = 1e-12;
const TIMES = [undefined, -1.3, 0, 0.27, 1.15, 4.9];

describe('a program without mistakes', () => {
  it.each(Object.entries(OWN))('has the numbers that are drawn: %s', (_, files) => {
    expectSame(characterOf(...files));
  });
});

describeShared('a program without mistakes, on the reference files', () => {
  it.each(Object.entries(SHARED))('has the numbers that are drawn: %s', (_, files) => {
    expectSame(characterOf(...files));
  });
});

function expectSame(character: Character): void {
  const evaluator = new Evaluator(character);
  for (const time of TIMES) {
    const found = evaluator.frame(RIGHT_PROGRAM, time, { local: true, vertices: true, normals: true });
    const meant = drawn(character, time);
    for (const kind of ['world', 'local', 'vertices', 'normals'] as const) {
      expect(largestDifference(found[kind], meant[kind]), `${kind} at ${time}`).toBeLessThanOrEqual(WITHIN);
    }
  }
  const take = shownTake(character);
  const compiled = take && compileTake(take);
  take?.channels.forEach((channel, c) => {
    if (!compiled || channel.kind !== 'keys') return;
    for (let time = -7; time < 9; time += 0.1737) {
      const value = channelValue(channel, take.range, time, RIGHT_CURVES);
      const scale = Math.max(1, Math.abs(value));
      const difference: number = Math.abs(value - evaluateChannel(compiled, c, time)) / scale;
      if (!(difference <= WITHIN)) expect.fail(`channel ${c} is off by ${difference} at ${time}`);
    }
  });
}

function drawn(character: Character, time: number | undefined) {
  const dofs = new Float64Array(dofCountOf(character));
  poseAt(time === undefined ? { ...character, shownTake: -1 } : character, time ?? 0, dofs);
  const compiled = character.skeleton && compileSkeleton(character.skeleton);
  const world = new Float64Array(16 * (compiled?.jointCount ?? 0));
  const local = new Float64Array(world.length);
  if (compiled) {
    worldMatrices(compiled, dofs, world);
    localMatrices(compiled, dofs, local);
  }
  const skin = shownSkin(character);
  const vertices = new Float64Array(skin?.positions.length ?? 0);
  const normals = new Float64Array(vertices.length);
  if (skin) {
    const of = compileSkin(skin);
    blendMorphs(of, character.morphs, dofs, dofs.length - character.morphs.length, vertices, normals);
    deform(of, compiled && world, vertices, normals, vertices, normals);
  }
  return { world, local, vertices, normals };
}

function largestDifference(a: Float64Array, b: Float64Array): number {
  expect(a.length).toBe(b.length);
  let scale = 1;
  let difference = 0;
  for (let i = 0; i < a.length; i++) {
    scale = Math.max(scale, Math.abs(b[i]));
    difference = Math.max(difference, Math.abs(a[i] - b[i]));
  }
  return difference / scale;
}
