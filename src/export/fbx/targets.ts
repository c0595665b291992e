/** What takes move in an FBX file: translation, rotation and scale of each node, and the weights of morphs. */
import { axesOfOrder, lockedness, writeAnglesNear } from '../../evaluate/rotations/euler-orders.ts';
import { RADIANS_PER_DEGREE } from '../../math/degrees.ts';
import { EULER_ORDERS, type EulerOrder } from '../../model/skeleton/skeleton.ts';
import { NODE_WIDTH, ROTATION, SCALE } from '../shared/joint-nodes.ts';
import type { NodeRule, Sum } from './node-rules.ts';

/** A property that takes may move. */
export interface Target {
  /** Of the object that has it. */
  readonly id: number;
  readonly property: 'Lcl Translation' | 'Lcl Rotation' | 'Lcl Scaling' | 'DeformPercent';
  /** One per number; `fitted` where they are no sums of DOFs. */
  readonly sums: readonly Sum[] | 'fitted';
  /** Writes what is fitted, from the numbers of glTF's nodes: angles nearest to what `out` has. */
  readonly write?: (rows: Float64Array, o: number, out: Float64Array) => void;
  /** The axes of three angles that are one rotation, the first applied first: other angles may be the same rotation. */
  readonly turns?: readonly [number, number, number];
  /** From radians, lengths and weights to the file's numbers. */
  readonly factor: number;
  /** At rest, before that factor. */
  readonly rest: readonly number[];
  /** How far numbers may be off where they are fitted, before that factor: a fraction of the size if it is a length. */
  readonly isLength: boolean;
}

const DEGREES = 1 / RADIANS_PER_DEGREE;

/** The properties of a node that may move. @param rest its translation, angles and scale at rest */
export function targetsOf(rule: NodeRule, id: number, rest: NodeRest): readonly Target[] {
  const moves = (sums: NodeRule['rotation']) => sums === 'fitted' || sums.some(({ terms }) => terms.length > 0);
  const targets: Target[] = [];
  const { translation, rotation, scale, order, fit } = rule;
  const at = NODE_WIDTH * fit;
  if (moves(translation)) {
    const common = { property: 'Lcl Translation', factor: 1, isLength: true } as const;
    targets.push({ ...common, id, sums: translation, rest: rest.translation });
  }
  if (moves(rotation)) {
    const isWhole = rotation !== 'fitted' && rotation.every(isOneAngle);
    targets.push({
      id,
      property: 'Lcl Rotation',
      sums: rotation,
      ...(rotation === 'fitted' && { write: anglesAt(at + ROTATION, order) }),
      ...((isWhole || rotation === 'fitted') && { turns: axesOfOrder(order) }),
      factor: DEGREES,
      rest: rest.angles,
      isLength: false,
    });
  }
  if (moves(scale)) {
    const write = (rows: Float64Array, o: number, out: Float64Array) => {
      for (let k = 0; k < 3; k++) out[k] = rows[o + at + SCALE + k];
    };
    const common = { property: 'Lcl Scaling', factor: 1, isLength: false } as const;
    targets.push({ ...common, id, sums: scale, ...(scale === 'fitted' && { write }), rest: rest.scale });
  }
  return targets;
}

/** The numbers of a node at rest; angles in radians. */
export interface NodeRest {
  readonly translation: readonly number[];
  readonly angles: readonly number[];
  readonly scale: readonly number[];
}

function isOneAngle({ constant, terms }: Sum): boolean {
  return constant === 0 && terms.length === 1 && Math.abs(terms[0].gain) === 1;
}

function anglesAt(at: number, order: EulerOrder): NonNullable<Target['write']> {
  const q = new Float64Array(4);
  return (rows, o, out) => {
    for (let k = 0; k < 4; k++) q[k] = rows[o + at + k];
    writeAnglesNear(order, q, out);
  };
}

/** The weight of a morph. */
export function morphTarget(id: number, dof: number, rest: number): Target {
  const sums = [{ constant: 0, terms: [{ dof, gain: 1 }] }];
  return { id, property: 'DeformPercent', sums, factor: 100, rest: [rest], isLength: false };
}

/** The order of angles that keeps rotations furthest from gimbal lock. @param rotations 4 numbers each */
export function clearestOrder(rotations: readonly number[]): EulerOrder {
  const locked = (order: EulerOrder) => lockedness(order, rotations);
  // The usual one, unless it comes near.
  if (locked('xyz') < 0.95) return 'xyz';
  return EULER_ORDERS.reduce((best, order) => (locked(order) < locked(best) ? order : best));
}
