import { readdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { describe, expect, it } from 'vitest';
import { compileSkeleton, worldMatrices } from '../../../src/evaluate/kinematics.ts';
import { formulaOf, motionText } from '../../../src/model/joint-types/texts.ts';
import {
  dofsOf,
  factorsOf,
  isOffered,
  JOINT_TYPES,
  MOTION_KINDS,
  motionOfKind,
  parameterOf,
} from '../../../src/model/skeleton/joint-types.ts';
import { EULER_ORDERS, type Motion, UNLIMITED } from '../../../src/model/skeleton/skeleton.ts';
import { joint } from '../../ui/builders.ts';

const hinge: Motion = { kind: 'hinge', axis: [0, 0, 2] };
const bvh: Motion = { kind: 'bvh', channels: ['tx', 'ty', 'tz', 'rz', 'rx', 'ry'], positions: 'replace' };

describe('another kind of joint', () => {
  it('another kind of joint keeps the axis, as it was written', () => {
    expect(motionOfKind('screw', hinge)).toEqual({ kind: 'screw', axis: [0, 0, 2], pitch: 1 });
    expect(motionOfKind('prismatic', { kind: 'ball', order: 'xyz' })).toEqual({ kind: 'prismatic', axis: [1, 0, 0] });
  });

  it('another kind of joint keeps the order, as far as it applies', () => {
    expect(motionOfKind('free', { kind: 'ball', order: 'zxy' })).toEqual({ kind: 'free', order: 'zxy' });
    expect(motionOfKind('universal', { kind: 'ball', order: 'zxy' })).toEqual({ kind: 'universal', order: 'zx' });
    expect(motionOfKind('ball', { kind: 'universal', order: 'yz' })).toEqual({ kind: 'ball', order: 'yzx' });
  });

  it('tells the order with the product that it means', () => {
    expect(motionText({ kind: 'ball', order: 'xyz' }, String)).toBe('balljoint, Rz·Ry·Rx (xyz)');
    expect(motionText({ kind: 'universal', order: 'yz' }, String)).toBe('universaljoint, Rz·Ry (yz)');
  });

  it('takes BVH’s order the other way round: it lists what is multiplied from left to right', () => {
    expect(motionOfKind('ball', bvh)).toEqual({ kind: 'ball', order: 'yxz' });
  });

  it('made of chosen DOFs has those of the one before', () => {
    expect(motionOfKind('compound', bvh)).toEqual({ kind: 'compound', dofs: bvh.channels });
    expect(motionOfKind('compound', { kind: 'quaternion' })).toEqual({ kind: 'compound', dofs: ['rx'] });
  });

  it('made of chosen DOFs moves as before, and turned back it is what it was', () => {
    for (const order of EULER_ORDERS) {
      const compound = motionOfKind('compound', { kind: 'ball', order });
      expect(motionOfKind('ball', compound)).toEqual({ kind: 'ball', order });
    }
    expect(motionOfKind('compound', { kind: 'ball', order: 'xyz' })).toEqual({
      kind: 'compound',
      dofs: ['rz', 'ry', 'rx'],
    });
    expect(motionOfKind('compound', { kind: 'free', order: 'zxy' })).toEqual({
      kind: 'compound',
      dofs: ['tx', 'ty', 'tz', 'ry', 'rx', 'rz'],
    });
    expect(motionOfKind('universal', motionOfKind('compound', { kind: 'universal', order: 'yz' }))).toEqual({
      kind: 'universal',
      order: 'yz',
    });
  });

  it('made of chosen DOFs turns its space exactly as before', () => {
    const values = [0.3, -0.8, 1.1];
    const matrixOf = (motion: Motion, angles: Readonly<Record<string, number>>) => {
      const own = joint('one', -1);
      const pose = dofsOf(motion).map(({ name }) => angles[name]);
      const world = new Float64Array(16);
      const skeleton = { name: 's', joints: [{ ...own, motion, pose, limits: pose.map(() => UNLIMITED) }] };
      worldMatrices(compileSkeleton(skeleton), Float64Array.from([0, 0, 0, ...pose]), world);
      return [...world];
    };
    for (const order of EULER_ORDERS) {
      const ball: Motion = { kind: 'ball', order };
      const angles = { rx: values[0], ry: values[1], rz: values[2] };
      const [was, is] = [ball, motionOfKind('compound', ball)].map((motion) => matrixOf(motion, angles));
      is.forEach((x, i) => {
        expect(Math.abs(x - was[i])).toBeLessThan(1e-14);
      });
    }
  });

  it('another kind of joint can be made of each kind', () => {
    for (const kind of MOTION_KINDS.filter(isOffered)) {
      const made = motionOfKind(kind, bvh);
      expect(made.kind).toBe(kind);
      expect(dofsOf(made).length).toBeGreaterThanOrEqual(kind === 'fixed' ? 0 : 1);
    }
  });
});

describe('the types of joints', () => {
  it('begin with a value for each of their parameters, of the type that the parameter has', () => {
    for (const { initial, parameters } of Object.values(JOINT_TYPES)) {
      const fields = Object.keys(initial).filter((name) => name !== 'kind');
      expect(fields).toEqual(Object.keys(parameters));
      for (const [name, { type }] of Object.entries(parameters)) expect(parameterOf(initial, name, type)).toBeDefined();
    }
  });

  it('have a formula where their matrix is no product of one-DOF matrices', () => {
    for (const { initial } of Object.values(JOINT_TYPES)) {
      expect(formulaOf(initial) !== undefined || factorsOf(initial) !== undefined).toBe(true);
    }
  });

  it('multiply one-DOF matrices of their own DOFs, each once', () => {
    const compound: Motion = { kind: 'compound', dofs: ['ry', 'tz', 'sx'] };
    for (const motion of [...Object.values(JOINT_TYPES).map(({ initial }) => initial), compound, bvh]) {
      const factors = JOINT_TYPES[motion.kind].factors(motion as never);
      if (factors)
        expect([...factors].sort()).toEqual(
          dofsOf(motion)
            .map(({ name }) => name)
            .sort(),
        );
    }
  });
});

/**
 * The files that may tell the types apart: where they are defined, and where each becomes a matrix. Any other asks a
 * type's record, or a new type would have to be known there too.
 */
const MAY_ASK = [
  /^model\/skeleton\/skeleton\.ts$/,
  /^model\/(skeleton\/joint-types\.ts$|joint-types\/)/,
  /^evaluate\/motions(\.ts$|\/)/,
];

/** Kinds whose names other things in the program have too. */
const SHARED_KINDS: readonly string[] = ['ball', 'free', 'scale', 'shear', 'fixed', 'bvh'];
const OWN_KINDS = MOTION_KINDS.filter((kind) => !SHARED_KINDS.includes(kind)).join('|');

const ASKING: readonly RegExp[] = [
  // motion.kind === 'ball', switch (motion.kind)
  /\b(motion|made)\??\.kind\b\)?\s*([!=]==|\{)|switch \([^)]*\b[mM]otion\??\.kind\)/,
  // kind === 'hinge', case 'hinge':
  new RegExp(`([!=]==|\\bcase)\\s*'(${OWN_KINDS})'`),
  // Record<Motion['kind'], …>, a table by kind
  /Motion\['kind'\]/,
  // 'axis' in motion
  /'(axis|channels|dofs|mode|order|pitch|positions)' in /,
];

const asks = (text: string) => ASKING.some((pattern) => pattern.test(text));

describe('what type a joint is', () => {
  it('the type of a joint is asked of no motion but by the records of the types and their matrices', () => {
    const src = fileURLToPath(new URL('../../../src/', import.meta.url));
    const files = readdirSync(src, { recursive: true, encoding: 'utf8' })
      .map((file) => file.replaceAll('\\', '/'))
      .filter((file) => file.endsWith('.ts') && !MAY_ASK.some((pattern) => pattern.test(file)));
    const asking = files.flatMap((file) => {
      const lines = readFileSync(join(src, file), 'utf8').split('\n');
      return lines.flatMap((line, i) => (asks(line) ? [`${file}:${i + 1} ${line.trim()}`] : []));
    });
    expect(asking, 'ask model/joint-types.ts instead, with a new question if need be').toEqual([]);
  });

  it.each([
    "if (motion.kind === 'ball') return;",
    "return motion?.kind !== 'bvh';",
    'switch (joint.motion.kind) {',
    "    case 'hinge':",
    "const is = kind === 'quaternion';",
    "const NAMES: Record<Motion['kind'], string> = {",
    "return 'axis' in motion;",
  ])('would be noticed: %s', (line) => expect(asks(line)).toBe(true));
});
