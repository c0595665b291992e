/** The walker's mesh: its parts, their shapes, and the joints they follow. */

import { smoothstep } from '../../../src/math/smoothstep.ts';
import { add, cross, dot, scaled, subtract, type Vec3 } from '../../../src/math/vec3.ts';
import { along, around, loft, MeshBuilder, type Section, type Span } from '../shape/mesh.ts';
import { apply, mixVec, normalise } from '../shape/vectors.ts';
import { chainWeights, mixWeights, placeAlong } from '../shape/weights.ts';
import {
  ATLAS_SIZE,
  at,
  bend,
  bentTube,
  frames,
  joint,
  level,
  only,
  RECTS,
  rowsOf,
  type WalkerShape,
} from './body-parts.ts';
import { GEAR } from './gear.ts';
import { eyePoint, headPoint, mouthPoint, nosePoint } from './head.ts';
import { FOREARM, UPPER_ARM } from './skeleton.ts';

const head: WalkerShape = {
  name: 'head',
  point: headPoint,
  angles: around(26, 0.3),
  rows: along(16),
  startPole: true,
  endPole: true,
  weights: (p) => chainWeights(p[1], joint('neck'), [bend('head', 1.17, 0.03)]),
};

const torsoSections = [
  level(0.64, 0.001, 0.001),
  level(0.6, 0.14, 0.12),
  level(0.555, 0.228, 0.208),
  level(0.565, 0.25, 0.228),
  level(0.64, 0.238, 0.218, 0.004),
  level(0.72, 0.224, 0.205, 0.012),
  level(0.8, 0.218, 0.208, 0.02),
  level(0.88, 0.208, 0.198, 0.018),
  level(0.96, 0.195, 0.178, 0.008),
  level(1.03, 0.172, 0.15, 0),
  level(1.09, 0.13, 0.115, -0.004),
  level(1.14, 0.1, 0.092, -0.004),
  level(1.21, 0.08, 0.075, 0),
  level(1.215, 0.001, 0.001),
];

const torso: WalkerShape = {
  name: 'torso',
  point: loft(torsoSections),
  angles: around(18),
  rows: rowsOf(torsoSections),
  startPole: true,
  endPole: true,
  weights: (p) => {
    const upright = chainWeights(p[1], joint('hips'), [
      bend('spine', 0.79, 0.08),
      bend('chest', 0.93, 0.08),
      bend('neck', 1.12, 0.05),
    ]);
    // The hem follows the legs slightly, so that thighs don't come through it.
    const hem = 0.78 * smoothstep(0.76, 0.57, p[1]);
    const left = smoothstep(-0.12, 0.12, p[0]);
    return mixWeights(upright, mixWeights(only('thigh_r'), only('thigh_l'), left), hem);
  },
};

/** Both arms, mirrored: sections along the arm's axis in the binding pose. */
function armShape(suffix: '_l' | '_r', side: number): WalkerShape {
  const { turn, at: shoulder } = frames[joint(`upper_arm${suffix}`)];
  const axis = apply(turn, [side, 0, 0]);
  const up = apply(turn, [0, 1, 0]);
  const section = (s: number, thick: number, wide = thick): Section => ({
    at: add(shoulder, scaled(axis, s)),
    side: scaled(up, thick * side),
    front: [0, 0, wide],
  });
  const sections = [
    section(-0.06, 0.001),
    section(-0.035, 0.065),
    section(0.03, 0.09),
    section(0.11, 0.083),
    section(UPPER_ARM - 0.02, 0.077),
    section(UPPER_ARM + 0.05, 0.077),
    section(0.315, 0.083),
    section(0.345, 0.084),
    section(0.352, 0.062),
    section(UPPER_ARM + FOREARM + 0.02, 0.064, 0.072),
    section(UPPER_ARM + FOREARM + 0.08, 0.062, 0.082),
    section(UPPER_ARM + FOREARM + 0.13, 0.044, 0.058),
    section(UPPER_ARM + FOREARM + 0.148, 0.001),
  ];
  return {
    name: 'arm',
    point: loft(sections),
    angles: around(10),
    rows: rowsOf(sections),
    startPole: true,
    endPole: true,
    weights: (p) =>
      chainWeights(dot(subtract(p, shoulder), axis), joint('chest'), [
        bend(`upper_arm${suffix}`, 0.01, 0.06),
        bend(`forearm${suffix}`, UPPER_ARM, 0.06),
        bend(`hand${suffix}`, UPPER_ARM + FOREARM, 0.04),
      ]),
  };
}

function thumbShape(suffix: '_l' | '_r', side: number): WalkerShape {
  const { turn, at: shoulder } = frames[joint(`upper_arm${suffix}`)];
  const axis = apply(turn, [side, 0, 0]);
  const up = apply(turn, [0, 1, 0]);
  const along = normalise(add(scaled(axis, 0.7), [0, 0, 0.7]));
  const across = normalise(cross(up, along));
  const section = (s: number, r: number): Section => ({
    at: add(add(shoulder, scaled(axis, UPPER_ARM + FOREARM + 0.03)), add([0, 0, 0.04], scaled(along, s))),
    side: scaled(up, r),
    front: scaled(across, -r * side),
  });
  const sections = [section(-0.02, 0.03), section(0.025, 0.031), section(0.05, 0.024), section(0.065, 0.001)];
  return {
    name: 'thumb',
    point: loft(sections),
    angles: around(7),
    rows: rowsOf(sections),
    startPole: false,
    endPole: true,
    weights: () => only(`hand${suffix}`),
  };
}

function legShape(suffix: '_l' | '_r', side: number): WalkerShape {
  const x = at(`thigh${suffix}`)[0];
  const section = (y: number, r: number, z = 0): Section => ({ ...level(y, r * side, r * 1.05), at: [x, y, z] });
  const sections = [
    section(0.67, 0.001),
    section(0.6, 0.104),
    section(0.53, 0.106),
    section(0.44, 0.1, 0.004),
    section(0.37, 0.096, 0.006),
    section(0.31, 0.097, 0.002),
    section(0.275, 0.102),
    section(0.262, 0.096),
    section(0.255, 0.079),
    section(0.18, 0.076),
    section(0.11, 0.076),
    section(0.05, 0.06),
  ];
  return {
    name: 'leg',
    point: loft(sections),
    angles: around(10),
    rows: rowsOf(sections),
    startPole: true,
    endPole: false,
    weights: (p) =>
      chainWeights(-p[1], joint('hips'), [
        bend(`thigh${suffix}`, -0.63, 0.06),
        bend(`shin${suffix}`, -0.37, 0.07),
        bend(`foot${suffix}`, -0.13, 0.05),
      ]),
  };
}

/** Rows of vertices follow both edges of the sole, so that its painted edge is straight. */
const FOOT_ANGLES = [-1, ...[-0.8, -0.65, -0.53, -0.38, -0.2], 0, 0.2, 0.38, 0.53, 0.65, 0.8].map((a) => a * Math.PI);

function footShape(suffix: '_l' | '_r', side: number): WalkerShape {
  const x = at(`foot${suffix}`)[0];
  /** Half width and height at z; the toes bend inwards slightly, to tell left from right. */
  const section = (z: number, wide: number, high: number): Section => ({
    at: [x - side * 0.25 * Math.max(0, z) * Math.max(0, z), high * 0.46, z],
    side: [wide * side, 0, 0],
    front: [0, high * 0.54, 0],
    squareness: 2.5,
  });
  const sections = [
    section(-0.108, 0.012, 0.06),
    section(-0.098, 0.055, 0.12),
    section(-0.055, 0.08, 0.165),
    section(0.0, 0.083, 0.17),
    section(0.06, 0.088, 0.145),
    section(0.12, 0.095, 0.125),
    section(0.175, 0.085, 0.11),
    section(0.21, 0.055, 0.08),
    section(0.218, 0.02, 0.03),
  ];
  const tube = loft(sections);
  return {
    name: 'foot',
    // Flat below: the sole is on the ground.
    point: (angle, v) => {
      const p = tube(angle, v);
      return [p[0], Math.max(0, p[1]), p[2]];
    },
    angles: FOOT_ANGLES,
    rows: rowsOf(sections),
    startPole: true,
    endPole: true,
    weights: (p) => chainWeights(p[2], joint(`foot${suffix}`), [bend(`toe${suffix}`, 0.11, 0.035)]),
  };
}

const tailJoints = [1, 2, 3, 4].map((i) => at(`tail_${i}`));
const tailPoints: Vec3[] = [
  [0, 0.66, -0.12],
  tailJoints[0],
  mixVec(tailJoints[0], tailJoints[1], 0.6),
  add(tailJoints[1], [0, -0.015, -0.04]),
  mixVec(tailJoints[1], tailJoints[2], 0.6),
  add(tailJoints[2], [0, 0, -0.02]),
  mixVec(tailJoints[2], tailJoints[3], 0.55),
  tailJoints[3],
  add(tailJoints[3], [0, 0.08, -0.03]),
  add(tailJoints[3], [0, 0.16, -0.03]),
  add(tailJoints[3], [0, 0.22, -0.015]),
  add(tailJoints[3], [0, 0.245, -0.008]),
];
const tailSizes = [0.03, 0.055, 0.075, 0.1, 0.12, 0.132, 0.138, 0.136, 0.122, 0.092, 0.046, 0.001];
const tailSections = bentTube(
  tailPoints,
  tailSizes.map((r) => [r, r] as const),
);
const tail: WalkerShape = {
  name: 'tail',
  point: loft(tailSections),
  angles: around(12),
  rows: rowsOf(tailSections),
  startPole: false,
  endPole: true,
  weights: (p) => {
    const best = placeAlong([...tailJoints, add(tailJoints[3], [0, 0.24, -0.02])], p);
    return chainWeights(best, joint('hips'), [
      bend('tail_1', 0, 0.3),
      bend('tail_2', 1, 0.4),
      bend('tail_3', 2, 0.45),
      bend('tail_4', 3, 0.45),
    ]);
  },
};

function earShape(suffix: '_l' | '_r', side: number): WalkerShape {
  const base = at(`ear${suffix}`);
  const lean = normalise([0.36 * side, 1, -0.02]);
  const across = normalise(cross(lean, [0, 0, 1]));
  const section = (s: number, wide: number, thick: number, z = 0): Section => ({
    at: add(add(base, scaled(lean, s)), [0, 0, z]),
    side: scaled(across, wide * side),
    front: [0, 0, thick],
  });
  const sections = [
    section(-0.06, 0.1, 0.06),
    section(0.02, 0.128, 0.062),
    section(0.1, 0.126, 0.05, -0.004),
    section(0.17, 0.1, 0.04, -0.006),
    section(0.225, 0.055, 0.026, -0.004),
    section(0.245, 0.001, 0.001),
  ];
  const tube = loft(sections);
  return {
    name: 'ear',
    // The front is hollow.
    point: (angle, v) => {
      const p = tube(angle, v);
      const hollow = Math.max(0, Math.cos(angle)) ** 2 * 0.055 * smoothstep(1, 0.35, v) * smoothstep(-0.1, 0.25, v);
      return [p[0], p[1], p[2] - hollow];
    },
    angles: around(12),
    rows: rowsOf(sections),
    startPole: false,
    endPole: true,
    weights: (p) => chainWeights(p[1], joint('head'), [bend(`ear${suffix}`, base[1] + 0.01, 0.05)]),
  };
}

/** Three locks on the crown. */
const TUFTS: readonly { readonly lean: Vec3; readonly foot: Vec3; readonly tall: number }[] = [
  { lean: [-0.35, 0.75, 0.42], foot: [-0.04, 1.925, 0.03], tall: 0.13 },
  { lean: [0.1, 0.8, 0.55], foot: [0.0, 1.93, 0.05], tall: 0.17 },
  { lean: [0.5, 0.7, 0.2], foot: [0.045, 1.925, 0.0], tall: 0.12 },
];
const tufts = TUFTS.map(({ lean, foot, tall }): WalkerShape => {
  const up = normalise(lean);
  const across = normalise(cross(up, [0, 0, 1]));
  const front = cross(across, up);
  const section = (s: number, r: number): Section => ({
    at: add(add(foot, scaled(up, s * tall)), [0, -0.03 * s * s, 0.04 * s * s]),
    side: scaled(across, r),
    front: scaled(front, r),
  });
  const sections = [section(-0.2, 0.055), section(0.35, 0.042), section(0.78, 0.024), section(1, 0.001)];
  return {
    name: 'tuft',
    point: loft(sections),
    angles: around(7),
    rows: rowsOf(sections),
    startPole: false,
    endPole: true,
    weights: () => only('head'),
  };
});

/** One shape per rectangle to be painted; right limbs share the left ones'. */
export const SHAPES: readonly WalkerShape[] = [
  head,
  torso,
  armShape('_l', 1),
  thumbShape('_l', 1),
  armShape('_r', -1),
  thumbShape('_r', -1),
  legShape('_l', 1),
  footShape('_l', 1),
  legShape('_r', -1),
  footShape('_r', -1),
  tail,
  ...GEAR,
  earShape('_l', 1),
  earShape('_r', -1),
  ...tufts,
];

export interface WalkerMesh {
  readonly mesh: MeshBuilder;
  readonly spans: { readonly head: Span; readonly torso: Span; readonly eyes: readonly Span[]; readonly mouth: Span };
}

export const EYE_GRID = 5;
export const MOUTH_GRID = [10, 2] as const;
const NOSE_GRID = 4;

export function buildWalkerMesh(): WalkerMesh {
  const mesh = new MeshBuilder(ATLAS_SIZE);
  const spans = SHAPES.map((shape) => mesh.addPart({ ...shape, rect: RECTS[shape.name] }));
  const weights = () => only('head');
  const eyes = [1, -1].map((side) =>
    mesh.addPatch({
      columns: EYE_GRID,
      rows: EYE_GRID,
      point: (s, t) => eyePoint(side, s, t, 0, 0),
      rect: RECTS.eye,
      weights,
    }),
  );
  mesh.addPatch({ columns: NOSE_GRID, rows: NOSE_GRID, point: nosePoint, rect: RECTS.nose, weights });
  const mouth = mesh.addPatch({
    columns: MOUTH_GRID[0],
    rows: MOUTH_GRID[1],
    point: (s, t) => mouthPoint(s, t, 0),
    rect: RECTS.mouth,
    weights,
  });
  return { mesh, spans: { head: spans[0], torso: spans[1], eyes, mouth } };
}
