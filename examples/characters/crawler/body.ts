/** The crawler's mesh and colours: a shell over a round body, a friendly head, six legs, two feelers. */

import { smoothstep } from '../../../src/math/smoothstep.ts';
import { add, cross, scaled, subtract, type Vec3 } from '../../../src/math/vec3.ts';
import { Atlas, blend, type Colour, colour } from '../paint/atlas.ts';
import {
  along,
  around,
  loft,
  MeshBuilder,
  type MeshPart,
  type Rect,
  type Section,
  type Weights,
} from '../shape/mesh.ts';
import { jointIndex, posedFrames } from '../shape/skeletons.ts';
import { apply, normalise } from '../shape/vectors.ts';
import { chainWeights, placeAlong } from '../shape/weights.ts';
import { BODY_HEIGHT, COXA, CRAWLER_SKELETON, FEMUR, LEGS, type LegPlan, TIBIA } from './skeleton.ts';

const ATLAS_SIZE = 256;
const RECTS = {
  shell: [4, 4, 150, 150],
  head: [162, 4, 88, 88],
  leg: [4, 162, 50, 88],
  feeler: [62, 162, 24, 60],
  eye: [162, 100, 80, 80],
} as const satisfies Record<string, Rect>;

const TEAL = colour('#239a98');
const TEAL_DEEP = colour('#15606c');
const AMBER = colour('#f6b73c');
const CREAM = colour('#fdeccb');
const CORAL = colour('#ef7a57');
const PLUM = colour('#6b3a66');
const PLUM_LIGHT = colour('#a9628c');
const NIGHT = colour('#241626');

const joint = (name: string) => jointIndex(CRAWLER_SKELETON, name);
const frames = posedFrames(CRAWLER_SKELETON);
const only = (name: string): Weights => new Map([[joint(name), 1]]);
const rowsOf = (sections: readonly Section[]) => along(sections.length - 1);

type Shape = Omit<MeshPart, 'rect'> & { readonly name: Exclude<keyof typeof RECTS, 'eye'> };

/** Half width, height of the back and depth of the belly along z. */
const shellSections = [
  [-0.56, 0.001, 0.0, 0.0],
  [-0.545, 0.12, 0.1, 0.05],
  [-0.46, 0.24, 0.215, 0.1],
  [-0.3, 0.33, 0.305, 0.135],
  [-0.1, 0.355, 0.335, 0.15],
  [0.08, 0.325, 0.305, 0.145],
  [0.21, 0.262, 0.245, 0.125],
  [0.3, 0.17, 0.165, 0.09],
  [0.325, 0.001, 0.05, -0.05],
].map(([z, wide, up, down]): Section => {
  const middle = (up - down) / 2;
  return { at: [0, BODY_HEIGHT + middle, z], side: [wide, 0, 0], front: [0, Math.max(0.001, (up + down) / 2), 0] };
});
const shell: Shape = {
  name: 'shell',
  point: loft(shellSections),
  // Denser at the shell's rim.
  angles: [-1, -0.82, -0.68, -0.56, -0.4, -0.25, -0.12, 0, 0.12, 0.25, 0.4, 0.56, 0.68, 0.82].map((a) => a * Math.PI),
  rows: rowsOf(shellSections),
  startPole: true,
  endPole: true,
  weights: (p) => chainWeights(-p[2], joint('body'), [{ joint: joint('abdomen'), from: 0.1, soft: 0.2 }]),
};

const HEAD: Vec3 = [0, BODY_HEIGHT + 0.08, 0.41];
const head: Shape = {
  name: 'head',
  point: (angle, v) => {
    const up = (v - 0.5) * Math.PI;
    const round = Math.cos(up);
    return add(HEAD, [0.2 * Math.sin(angle) * round, 0.17 * Math.sin(up), 0.165 * Math.cos(angle) * round]);
  },
  angles: around(12),
  rows: along(7),
  startPole: true,
  endPole: true,
  weights: (p) => chainWeights(p[2], joint('body'), [{ joint: joint('head'), from: 0.28, soft: 0.05 }]),
};

/** A tube along the leg's three bones in the binding pose, thick at the knee and pointed at the foot. */
function legShape({ name, side }: LegPlan): Shape {
  const coxa = frames[joint(`coxa_${name}`)];
  const femur = frames[joint(`femur_${name}`)];
  const tibia = frames[joint(`tibia_${name}`)];
  const out = (frame: typeof coxa, far: number): Vec3 => add(frame.at, apply(frame.turn, [side * far, 0, 0]));
  const end = out(tibia, TIBIA);
  const across = apply(coxa.turn, [0, 0, 1]);
  const spots: readonly (readonly [Vec3, number])[] = [
    [out(coxa, -0.05), 0.058],
    [out(coxa, COXA * 0.9), 0.068],
    [out(femur, FEMUR * 0.5), 0.062],
    [out(femur, FEMUR), 0.064],
    [out(tibia, TIBIA * 0.3), 0.054],
    [out(tibia, TIBIA * 0.8), 0.032],
    [end, 0.001],
  ];
  const sections = spots.map(([at, r], i): Section => {
    const before = spots[Math.max(0, i - 1)][0];
    const after = spots[Math.min(spots.length - 1, i + 1)][0];
    const up = normalise(cross(scaled(across, side), subtract(after, before)));
    return { at, side: scaled(across, r), front: scaled(up, r) };
  });
  const bones = [coxa.at, femur.at, tibia.at, end];
  return {
    name: 'leg',
    point: loft(sections),
    angles: around(5),
    rows: rowsOf(sections),
    startPole: false,
    endPole: true,
    weights: (p) => {
      const place = placeAlong(bones, p);
      return chainWeights(place, joint('body'), [
        { joint: joint(`coxa_${name}`), from: 0, soft: 0.4 },
        { joint: joint(`femur_${name}`), from: 1, soft: 0.3 },
        { joint: joint(`tibia_${name}`), from: 2, soft: 0.25 },
      ]);
    },
  };
}

function feelerShape(suffix: '_l' | '_r', side: number): Shape {
  const base = frames[joint(`feeler_1${suffix}`)].at;
  const middle = frames[joint(`feeler_2${suffix}`)].at;
  const section = (at: Vec3, r: number): Section => ({ at, side: [r * side, 0, 0], front: [0, 0, r] });
  const sections = [
    section(add(base, [0, -0.03, 0]), 0.018),
    section(middle, 0.013),
    section(add(middle, [0.05 * side, 0.06, 0.05]), 0.016),
    section(add(middle, [0.07 * side, 0.085, 0.07]), 0.042),
    section(add(middle, [0.085 * side, 0.125, 0.085]), 0.04),
    section(add(middle, [0.09 * side, 0.145, 0.09]), 0.001),
  ];
  return {
    name: 'feeler',
    point: loft(sections),
    angles: around(5),
    rows: rowsOf(sections),
    startPole: false,
    endPole: true,
    weights: (p) =>
      chainWeights(p[1], joint('head'), [
        { joint: joint(`feeler_1${suffix}`), from: base[1], soft: 0.03 },
        { joint: joint(`feeler_2${suffix}`), from: middle[1], soft: 0.06 },
      ]),
  };
}

const SHAPES: readonly Shape[] = [shell, head, ...LEGS.map(legShape), feelerShape('_l', 1), feelerShape('_r', -1)];

/** A dome on the head's front, turned outward. */
function eyePoint(side: number, s: number, t: number): Vec3 {
  const [x, y] = [2 * s - 1, 2 * t - 1];
  const [u, w] = [x * Math.sqrt(1 - (y * y) / 2), y * Math.sqrt(1 - (x * x) / 2)];
  const outward = normalise([0.5 * side, 0.32, 0.8]);
  const right = normalise(cross([0, 1, 0], outward));
  const up = cross(outward, right);
  const centre = add(HEAD, [0.1 * side, 0.06, 0.105]);
  const high = 0.075 * Math.sqrt(Math.max(0, 1 - 0.96 * (u * u + w * w)));
  return add(add(centre, add(scaled(right, 0.088 * u), scaled(up, 0.094 * w))), scaled(outward, high));
}

export function buildCrawlerMesh(): MeshBuilder {
  const mesh = new MeshBuilder(ATLAS_SIZE);
  for (const shape of SHAPES) mesh.addPart({ ...shape, rect: RECTS[shape.name] });
  for (const side of [1, -1]) {
    mesh.addPatch({
      columns: 5,
      rows: 5,
      point: (s, t) => eyePoint(side, s, t),
      rect: RECTS.eye,
      weights: () => only('head'),
    });
  }
  return mesh;
}

type Painter = (p: Vec3, v: number, fold: number) => Colour;

/** Centres of the spots on one wing case, x (sideways) and z, with their radius. */
const SPOTS = [
  [0.14, 0.08, 0.055],
  [0.17, -0.13, 0.075],
  [0.1, -0.33, 0.06],
  [0.27, -0.3, 0.045],
  [0.28, 0.0, 0.04],
] as const;

const painters: Record<Shape['name'], Painter> = {
  shell: (p, _v, fold) => {
    if (fold > 0.66) return blend(CORAL, PLUM, 0.5 * smoothstep(0.9, 0.66, fold));
    if (fold > 0.57) return CREAM;
    if (p[2] > 0.19) return blend(PLUM_LIGHT, PLUM, smoothstep(0.2, 0.3, p[2]));
    if (p[2] > 0.165 || Math.abs(p[0]) < 0.011) return TEAL_DEEP;
    const spot = Math.min(...SPOTS.map(([x, z, r]) => Math.hypot(Math.abs(p[0]) - x, p[2] - z) / r));
    if (spot < 1) return spot > 0.72 ? CREAM : AMBER;
    return blend(TEAL, TEAL_DEEP, 0.8 * smoothstep(0.3, 0.57, fold) + 0.35 * smoothstep(-0.3, -0.55, p[2]));
  },
  head: (p) => {
    const [x, y, z] = subtract(p, HEAD);
    const side = Math.abs(x);
    if (z > 0) {
      const smile = Math.abs(y + 0.08 - 5 * side * side);
      if (smile < 0.008 && side < 0.075) return NIGHT;
      if (Math.hypot((side - 0.115) / 0.035, (y + 0.045) / 0.025) < 1) return CORAL;
    }
    return blend(PLUM_LIGHT, PLUM, smoothstep(0.02, 0.15, y) + 0.4 * smoothstep(-0.05, -0.15, y));
  },
  leg: (_p, v) => {
    if (v > 0.86) return NIGHT;
    if (Math.abs(v - 0.5) < 0.05) return AMBER;
    return blend(PLUM_LIGHT, PLUM, smoothstep(0.45, 0.85, v));
  },
  feeler: (_p, v) => (v > 0.5 ? AMBER : PLUM),
};

function eyeColour(u: number, v: number): Colour {
  const [x, y] = [2 * u - 1, 2 * v - 1];
  const [s, t] = [x * Math.sqrt(1 - (y * y) / 2), y * Math.sqrt(1 - (x * x) / 2)];
  if (Math.hypot(s + 0.18, t - 0.28) < 0.17) return [255, 255, 255];
  if (Math.hypot(s, t + 0.02) < 0.5) return NIGHT;
  return Math.hypot(s, t) < 0.9 ? CREAM : PLUM;
}

export function paintCrawler(): Atlas {
  const atlas = new Atlas(ATLAS_SIZE, PLUM);
  for (const name of ['shell', 'head', 'leg', 'feeler'] as const) {
    const shape = SHAPES.find((s) => s.name === name) ?? shell;
    atlas.paint(RECTS[name], (u, v) => painters[name](shape.point(u * Math.PI, v), v, u));
  }
  atlas.paint(RECTS.eye, eyeColour);
  return atlas;
}
