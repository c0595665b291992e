/**
 * Every type of joint, one exhibit each, on three steps like seats in a theatre: rotating types in front, sliding and
 * mixed ones behind, stretching ones at the back. Each has its own plinth and is named after its type.
 *
 *     y ↑      scale_xyz scale_axis scale_volume scale_uniform shear
 *       │    prismatic screw free fixed compound translational
 *       │  ball hinge universal quaternion leader·coupled length·at_tip            → x
 */
import type { Vec3 } from '../../../src/math/vec3.ts';
import type { Couple, Motion } from '../../../src/model/skeleton/skeleton.ts';

export type Family = 'turn' | 'slide' | 'mix' | 'stretch';

/** How far one DOF moves to either side of its rest; or its values at given parts of its time. */
export type Sway = number | readonly (readonly [part: number, value: number])[];

/** The piece that moves with a joint, in its space. */
export type Piece =
  | { readonly kind: 'block'; readonly centre: Vec3; readonly half: Vec3 }
  | { readonly kind: 'ball'; readonly centre: Vec3; readonly radius: number }
  /** A disc that faces +z, with a mark. */
  | { readonly kind: 'wheel'; readonly radius: number };

export interface Exhibit {
  readonly name: string;
  readonly family: Family;
  readonly motion: Motion;
  /** Position of the pivot above the middle of the plinth; for a child, relative to the parent's pivot. */
  readonly at: Vec3;
  readonly piece: Piece;
  /** One per DOF, played one after the other. */
  readonly sways: readonly Sway[];
  /** Limits of each DOF to both sides of its rest; absent: none. */
  readonly reach?: number;
  readonly length?: number;
  readonly couples?: readonly Omit<Couple, 'joint'>[];
  /** Static rods: from and to, above the middle of the plinth. */
  readonly rods?: readonly (readonly [Vec3, Vec3])[];
  /** A child of the previous exhibit, on the same plinth. */
  readonly isChild?: boolean;
  /** Beside the previous exhibit, on the same plinth. */
  readonly isBeside?: boolean;
}

const block = (half: Vec3, centre: Vec3 = [0, half[1], 0]): Piece => ({ kind: 'block', centre, half });
const POST: Vec3 = [0, 0.2, 0];
const post: readonly (readonly [Vec3, Vec3])[] = [[[0, 0, 0], POST]];
const SKEW: Vec3 = [1, 1, 0.5];
const SLOPE: Vec3 = [0.8, 0.6, 0];
const UP: Vec3 = [0, 1, 0];
/** Axis of an axis scale: up and to the right. */
const LEAN: Vec3 = [0.6, 0.8, 0];

const TURNS: readonly Exhibit[] = [
  {
    name: 'ball',
    family: 'turn',
    motion: { kind: 'ball', order: 'xyz' },
    at: POST,
    piece: block([0.2, 0.28, 0.2]),
    sways: [0.6, 0.7, 0.6],
    reach: 1,
    rods: post,
  },
  {
    name: 'hinge',
    family: 'turn',
    motion: { kind: 'hinge', axis: SKEW },
    at: [0, 0.42, 0],
    piece: block([0.22, 0.22, 0.22], [0, 0, 0]),
    sways: [1.2],
    reach: 1.5,
    rods: [
      [
        [-0.36, 0.06, -0.18],
        [0.36, 0.78, 0.18],
      ],
    ],
  },
  {
    name: 'universal',
    family: 'turn',
    motion: { kind: 'universal', order: 'xz' },
    at: POST,
    piece: block([0.2, 0.28, 0.2]),
    sways: [0.7, 0.7],
    reach: 1,
    rods: post,
  },
  {
    name: 'quaternion',
    family: 'turn',
    motion: { kind: 'quaternion' },
    at: POST,
    piece: block([0.2, 0.28, 0.2]),
    // The real component alone rotates nothing: z leads, and follows back.
    sways: [
      0.35,
      0.35,
      [
        [0.5, 0],
        [0.58, 0.35],
        [0.66, -0.35],
        [0.74, 0.25],
        [0.96, 0.25],
        [1, 0],
      ],
      [
        [0.76, 1],
        [0.86, 0.3],
        [0.96, 1],
      ],
    ],
    rods: post,
  },
  {
    name: 'leader',
    family: 'turn',
    motion: { kind: 'hinge', axis: [0, 0, 1] },
    at: [-0.16, 0.38, 0],
    piece: { kind: 'wheel', radius: 0.32 },
    sways: [1.4],
    reach: 1.6,
    rods: [
      [
        [-0.16, 0, -0.1],
        [-0.16, 0.38, -0.1],
      ],
      [
        [0.18, 0, -0.1],
        [0.18, 0.72, -0.1],
      ],
    ],
  },
  {
    name: 'coupled',
    family: 'turn',
    motion: { kind: 'hinge', axis: [0, 0, 1] },
    at: [0.18, 0.72, 0],
    piece: { kind: 'wheel', radius: 0.16 },
    sways: [0],
    couples: [{ dof: 'r', follows: 'r', gain: -2, offset: 0 }],
    isBeside: true,
  },
  {
    name: 'length',
    family: 'turn',
    motion: { kind: 'hinge', axis: [0, 0, 1] },
    at: [0, 0.08, 0],
    piece: block([0.09, 0.2, 0.09], [0, 0.22, 0]),
    sways: [
      [
        [0.12, 0.6],
        [0.38, -0.6],
        [0.5, 0],
      ],
    ],
    reach: 1,
    length: 0.44,
  },
  {
    name: 'at_tip',
    family: 'turn',
    motion: { kind: 'hinge', axis: [0, 0, 1] },
    at: [0, 0.44, 0],
    piece: block([0.07, 0.15, 0.07], [0, 0.17, 0]),
    sways: [
      [
        [0.5, 0],
        [0.62, 1],
        [0.88, -1],
        [1, 0],
      ],
    ],
    reach: 1.4,
    length: 0.34,
    isChild: true,
  },
];

const SLIDES: readonly Exhibit[] = [
  {
    name: 'prismatic',
    family: 'slide',
    motion: { kind: 'prismatic', axis: SLOPE },
    at: [0, 0.4, 0],
    piece: block([0.16, 0.16, 0.16], [0, 0, 0]),
    sways: [0.3],
    reach: 0.35,
    rods: [
      [
        [-0.45, 0.0625, 0],
        [0.45, 0.7375, 0],
      ],
    ],
  },
  {
    name: 'screw',
    family: 'mix',
    motion: { kind: 'screw', axis: UP, pitch: 0.2 },
    at: [0, 0.14, 0],
    piece: block([0.3, 0.1, 0.12], [0, 0, 0]),
    // Two turns up, and down again.
    sways: [
      [
        [0.46, 12.566],
        [0.54, 12.566],
      ],
    ],
    reach: 12.6,
    rods: [
      [
        [0, 0, 0],
        [0, 0.8, 0],
      ],
    ],
  },
  {
    name: 'free',
    family: 'mix',
    motion: { kind: 'free', order: 'xyz' },
    at: [0, 0.4, 0],
    piece: block([0.19, 0.15, 0.15], [0, 0, 0]),
    sways: [0.25, 0.2, 0.25, 0.7, 0.7, 0.7],
    reach: 1,
  },
  { name: 'fixed', family: 'mix', motion: { kind: 'fixed' }, at: [0, 0, 0], piece: block([0.2, 0.28, 0.2]), sways: [] },
  {
    name: 'compound',
    family: 'mix',
    motion: { kind: 'compound', dofs: ['tx', 'rz', 'ry'] },
    at: POST,
    piece: block([0.2, 0.26, 0.2]),
    sways: [0.25, 0.6, 0.8],
    reach: 1,
  },
  {
    name: 'translational',
    family: 'slide',
    motion: { kind: 'translational' },
    at: [0, 0.4, 0],
    piece: block([0.17, 0.17, 0.17], [0, 0, 0]),
    sways: [0.25, 0.2, 0.25],
    reach: 0.3,
  },
];

const STRETCHES: readonly Exhibit[] = [
  {
    name: 'scale_xyz',
    family: 'stretch',
    motion: { kind: 'scale', mode: 'xyz', axis: UP },
    at: [0, 0, 0],
    piece: { kind: 'ball', centre: [0, 0.27, 0], radius: 0.27 },
    sways: [0.5, 0.5, 0.5],
    reach: 0.8,
  },
  {
    name: 'scale_axis',
    family: 'stretch',
    motion: { kind: 'scale', mode: 'axis', axis: LEAN },
    at: [0, 0.36, 0],
    piece: block([0.2, 0.2, 0.2], [0, 0, 0]),
    sways: [0.5],
    reach: 0.8,
    rods: [
      [
        [-0.22, 0.0667, 0],
        [0.33, 0.8, 0],
      ],
    ],
  },
  {
    name: 'scale_volume',
    family: 'stretch',
    motion: { kind: 'scale', mode: 'volume', axis: UP },
    at: [0, 0, 0],
    piece: { kind: 'ball', centre: [0, 0.27, 0], radius: 0.27 },
    sways: [0.5],
    reach: 0.8,
  },
  {
    name: 'scale_uniform',
    family: 'stretch',
    motion: { kind: 'scale', mode: 'uniform', axis: UP },
    at: [0, 0, 0],
    piece: block([0.2, 0.25, 0.2]),
    sways: [0.5],
    reach: 0.8,
  },
  {
    name: 'shear',
    family: 'stretch',
    motion: { kind: 'shear' },
    at: [0, 0, 0],
    piece: block([0.2, 0.25, 0.2]),
    sways: [0.7, 0.7, 0.7],
    reach: 1,
  },
];

/** Front to back. Within a row, long names are placed so that they hide none in the initial view. */
export const ROWS: readonly (readonly Exhibit[])[] = [TURNS, SLIDES, STRETCHES];

/** Width of the steps, and each one's depth and rise. */
export const WIDTH = 8.1;
export const STEP_DEPTH = 1.25;
export const STEP_HEIGHT = 0.85;
/** Half the plinth's width, and its height. */
export const PLINTH = { half: 0.42, height: 0.12 };

/** An exhibit with its position. */
export interface Placed {
  readonly exhibit: Exhibit;
  /** The middle of its plinth, on top. */
  readonly plinth: Vec3;
}

/** In joint order, without the root. */
export const PLACED: readonly Placed[] = ROWS.flatMap((row, r) => {
  const own = row.filter((e) => !e.isChild && !e.isBeside).length;
  let slot = -1;
  return row.map((exhibit): Placed => {
    if (!exhibit.isChild && !exhibit.isBeside) slot++;
    const x = Number((((slot + 0.5) / own - 0.5) * WIDTH).toFixed(4));
    return { exhibit, plinth: [x, Number((r * STEP_HEIGHT + PLINTH.height).toFixed(4)), -r * STEP_DEPTH + 0] };
  });
});
