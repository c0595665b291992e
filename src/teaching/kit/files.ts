/**
 * The files of the test kit: as small as they can be while a program that makes a known mistake gets other numbers.
 * What ordinary files let through is what they are made of: angles about all three axes at once, poses beyond their
 * limits, branches, bindings that are turned and scaled, more than four attachments, weights that don't add up to 1,
 * keys at uneven times, a range that isn't that of the keys.
 */

/** Files that belong together, and what to evaluate of them. */
export interface KitSet {
  readonly name: string;
  /** Contents of the set, in a sentence. */
  readonly about: string;
  /** Names of files in the kit. */
  readonly files: readonly string[];
  /** Seconds; undefined is the file pose. Empty if only its channels are asked for. */
  readonly times: readonly (number | undefined)[];
  /** Times at which channels are evaluated; empty if they are not asked for. */
  readonly channelTimes: readonly number[];
}

const TREE = `balljoint trunk {
  offset 0.3 1.1 -0.2
  pose 0.35 -0.6 0.8
  balljoint bough_l {
    offset 0.5 0.9 0.1
    rotylimit -0.2 0.3
    pose -0.7 0.45 1.2
    balljoint twig_l {
      offset 0.2 0.7 -0.3
      pose 1.1 0.5 -0.9
    }
  }
  balljoint bough_r {
    offset -0.6 0.8 0.25
    rotxlimit -0.5 0.5
    pose 0.9 -1.3 0.2
    balljoint twig_r {
      offset -0.3 0.6 0.4
      rotzlimit 0.2 1.5
      pose 0.4 0.9 0.7
    }
    balljoint leaf_r {
      offset 0.1 0.5 -0.6
      pose -1.2 0.3 -0.5
    }
  }
}
`;

const REED_JOINTS = ['root', 'stem_1', 'stem_2', 'stem_3', 'stem_4', 'tip'];
const REED_POSES = ['0.2 -0.3 0.25', '0.35 0.5 -0.2', '-0.3 0.4 0.45', '0.5 -0.6 0.1', '-0.4 0.2 -0.55', '0.6 0.3 0.4'];

function reedSkel(): string {
  const open = REED_JOINTS.map((name, j) => {
    const indent = '  '.repeat(j);
    const offset = j === 0 ? '0.2 0 0.1' : '0.05 0.6 -0.04';
    return `${indent}balljoint ${name} {\n${indent}  offset ${offset}\n${indent}  pose ${REED_POSES[j]}\n`;
  });
  const close = REED_JOINTS.map((_, j) => `${'  '.repeat(REED_JOINTS.length - 1 - j)}}\n`);
  return [...open, ...close].join('');
}

const VERTICES = 14;

/** Around the stem, from its root to its tip. */
function reedPoint(v: number): readonly number[] {
  const angle = 2.4 * v;
  return [0.3 + 0.25 * Math.cos(angle), 0.25 * v, 0.25 * Math.sin(angle) - 0.05];
}

function reedNormal(v: number): readonly number[] {
  const [x, y, z] = [Math.cos(2.4 * v), 0.4 * Math.sin(v), Math.sin(2.4 * v)];
  const length = Math.hypot(x, y, z);
  return [x / length, y / length, z / length];
}

const row = (numbers: readonly number[]) => `  ${numbers.map((n) => Number(n.toFixed(4))).join(' ')}\n`;

/** From none to six, the largest weights not first; sums of 0.8 to 1.1. */
function reedAttachments(v: number): string {
  const count = [1, 2, 6, 3, 5, 4, 0][v % 7];
  const first = v % REED_JOINTS.length;
  const raw = Array.from({ length: count }, (_, i) => 1 + ((3 * i + v) % 5));
  const sum = raw.reduce((a, b) => a + b, 0);
  const total = [1, 0.8, 1.1, 0.9][v % 4];
  const pairs = raw.map((weight, i) => `${(first + i) % REED_JOINTS.length} ${((total * weight) / sum).toFixed(3)}`);
  return `  ${[count, ...pairs].join(' ')}\n`;
}

/** Columns of a binding: turned, scaled by another factor along each axis, and placed beside the stem. */
function reedBinding(j: number): string {
  const [c, s] = [Math.cos(0.3 + 0.2 * j), Math.sin(0.3 + 0.2 * j)];
  const scale = [1.1 + 0.1 * j, 0.9 - 0.05 * j, 1.25];
  const columns = [
    [c * scale[0], s * scale[0], 0],
    [-s * scale[1], c * scale[1], 0.1 * scale[1]],
    [0.15 * scale[2], -0.05 * scale[2], scale[2]],
    [0.2 + 0.05 * j, 0.6 * j, 0.1 - 0.04 * j],
  ];
  return `  matrix {\n${columns.map((column) => `  ${row(column)}`).join('')}  }\n`;
}

function reedSkin(): string {
  const all = Array.from({ length: VERTICES }, (_, v) => v);
  const triangles = all.slice(2).map((v) => [v - 2, v - 1, v]);
  return [
    `positions ${VERTICES} {\n${all.map((v) => row(reedPoint(v))).join('')}}\n`,
    `normals ${VERTICES} {\n${all.map((v) => row(reedNormal(v))).join('')}}\n`,
    `skinweights ${VERTICES} {\n${all.map(reedAttachments).join('')}}\n`,
    `triangles ${triangles.length} {\n${triangles.map(row).join('')}}\n`,
    `bindings ${REED_JOINTS.length} {\n${REED_JOINTS.map((_, j) => reedBinding(j)).join('')}}\n`,
  ].join('\n');
}

/** Every second or third vertex moved, and its normal turned. */
function reedMorph(step: number, by: readonly number[]): string {
  const moved = Array.from({ length: VERTICES }, (_, v) => v).filter((v) => v % step === 0);
  const place = (v: number) => [v, ...reedPoint(v).map((x, k) => x + by[k])];
  const turned = (v: number) => {
    const [x, y, z] = reedNormal(v);
    const length = Math.hypot(x + by[1], y - by[0], z + by[2]);
    return [v, (x + by[1]) / length, (y - by[0]) / length, (z + by[2]) / length];
  };
  return `positions ${moved.length} {\n${moved.map((v) => row(place(v))).join('')}}\n\nnormals ${moved.length} {\n${moved.map((v) => row(turned(v))).join('')}}\n`;
}

type Key = readonly [time: number, value: number, tangentIn: string | number, tangentOut: string | number];

function channel(extrapolate: string, keys: readonly Key[]): string {
  const lines = keys.map((key) => `      ${key.join(' ')}\n`).join('');
  return `  channel {\n    extrapolate ${extrapolate}\n    keys ${keys.length} {\n${lines}    }\n  }\n`;
}

function anim(range: readonly [number, number], channels: readonly string[]): string {
  return `animation {\n  range ${range.join(' ')}\n  numchannels ${channels.length}\n${channels.join('')}}\n`;
}

const EXTRAPOLATIONS = ['constant', 'linear', 'cycle', 'cycle_offset', 'bounce'];
const TANGENTS = ['smooth', 'linear', 'flat'];

/** Three uneven keys about a value, with all tangents in turn. */
function moving(c: number, middle: number, reach: number): string {
  const tangent = (i: number) => TANGENTS[(c + i) % TANGENTS.length];
  const keys: readonly Key[] = [
    [0.1, middle - reach, tangent(0), tangent(0)],
    [0.5, middle + reach, tangent(0), tangent(1)],
    [1.4, middle + 0.3 * reach, tangent(2), tangent(0)],
  ];
  return channel(`${EXTRAPOLATIONS[c % 5]} ${EXTRAPOLATIONS[(c + 2) % 5]}`, keys);
}

function treeAnim(): string {
  return anim(
    [0, 1.5],
    Array.from({ length: 3 + 18 }, (_, c) =>
      moving(c, c < 3 ? 0.8 - 0.5 * c : 0.3 * ((c % 4) - 1.4), c < 3 ? 0.6 : 0.5),
    ),
  );
}

function reedAnim(): string {
  const joints = 3 * REED_JOINTS.length;
  const isWeight = (c: number) => c >= 3 + joints;
  return anim(
    [0, 1.5],
    Array.from({ length: 3 + joints + 2 }, (_, c) =>
      moving(c, isWeight(c) ? 0.6 : c < 3 ? 0.4 - 0.3 * c : 0.2 * ((c % 3) - 0.8), isWeight(c) ? 0.3 : 0.4),
    ),
  );
}

/** Keys of the curves: uneven in time, with slopes that each mean something else. */
const SMOOTH: readonly Key[] = [
  [-0.4, 0.5, 'smooth', 'smooth'],
  [0.3, -0.8, 'smooth', 'smooth'],
  [0.55, 1.3, 'smooth', 'smooth'],
  [1.9, 0.2, 'smooth', 'smooth'],
];
const LINEAR = SMOOTH.map(([time, value]): Key => [time, value, 'linear', 'linear']);
const FLAT = SMOOTH.map(([time, value]): Key => [time, value, 'flat', 'flat']);
const FIXED = SMOOTH.map(([time, value], i): Key => [time, value, 1.5 - i, 0.6 * i - 2]);
const MIXED: readonly Key[] = [
  [-0.4, 0.5, 'flat', 'linear'],
  [0.3, -0.8, 'linear', 'smooth'],
  [0.55, 1.3, 3, 'flat'],
  [1.9, 0.2, 'smooth', -1.2],
];

function curves(): string {
  const pairs = ['cycle cycle', 'cycle_offset cycle_offset', 'bounce bounce', 'cycle_offset bounce', 'bounce cycle'];
  return anim(
    [0.1, 1.45],
    [
      channel('constant constant', SMOOTH),
      channel('linear linear', SMOOTH),
      channel('constant constant', LINEAR),
      channel('linear linear', FLAT),
      channel('linear linear', FIXED),
      ...pairs.map((pair) => channel(pair, MIXED)),
      ...pairs.map((pair) => channel(pair, FIXED)),
      // A lone key follows its slope; two keys at one time are a step; no keys are 0.
      channel('linear linear', [[0.7, 0.25, 2, -3]]),
      channel('constant cycle', [
        [0, 0.4, 'flat', 'linear'],
        [0.6, 1.1, 'linear', 'linear'],
        [0.6, -0.5, 'smooth', 'smooth'],
        [1.3, 0.4, 'linear', 'flat'],
      ]),
      channel('constant constant', []),
    ],
  );
}

const MARCH = `HIERARCHY
ROOT hips
{
  OFFSET 0.5 0.9 -0.3
  CHANNELS 6 Yposition Xposition Zposition Yrotation Zrotation Xrotation
  JOINT thigh
  {
    OFFSET 0.4 -0.2 0.1
    CHANNELS 3 Zrotation Xrotation Yrotation
    JOINT shin
    {
      OFFSET 0.1 -1.1 0.2
      CHANNELS 6 Xposition Yposition Zposition Xrotation Yrotation Zrotation
      End Site
      {
        OFFSET 0 -1 0.1
      }
    }
  }
  JOINT chest
  {
    OFFSET -0.1 0.8 0.15
    CHANNELS 2 Yrotation Xrotation
    End Site
    {
      OFFSET 0 0.5 0
    }
  }
}
MOTION
Frames: 3
Frame Time: 0.25
1.4 0.2 0.6 25 -40 15 35 50 -20 0.3 -1.4 0.5 -30 20 45 60 -25
1.5 0.4 0.9 40 -15 35 -25 30 40 0.2 -1.2 0.3 20 -50 30 -35 45
1.3 0.7 1.1 -20 30 50 45 -35 25 0.4 -1.3 0.1 -45 35 -25 20 55
`;

/** Beyond the course's format: `order` is the order in which the axes' rotations are applied. */
const ORDERS = `balljoint root {
  offset 0.2 -0.3 0.4
  order zyx
  pose 0.5 -0.8 1.1
  balljoint left {
    offset 0.6 0.7 -0.2
    order yxz
    pose -0.9 0.6 0.4
    balljoint left_tip {
      offset 0.1 0.8 0.3
      pose 0.7 -0.5 0.9
    }
  }
  universaljoint right {
    offset -0.5 0.6 0.3
    order yx
    pose 0.8 -1.2
    freejoint right_tip {
      offset -0.2 0.7 0.1
      order xzy
      pose 0.3 -0.1 0.2 -0.6 0.9 0.5
    }
  }
}
`;

/** Length, axis, angle in degrees, children; axes of any length. */
const ARM = `1.2  0 0 2  35  2
0.8  1 1 0  -50  1
0.5  0.3 -0.4 1  70  0
0.9  -1 0.5 0.5  25  0
`;

/** All files by name. */
export function kitFiles(): ReadonlyMap<string, string> {
  return new Map([
    ['tree.skel', TREE],
    ['tree_sway.anim', treeAnim()],
    ['reed.skel', reedSkel()],
    ['reed.skin', reedSkin()],
    ['reed_bulge.morph', reedMorph(2, [0.15, 0.1, -0.2])],
    ['reed_twist.morph', reedMorph(3, [-0.1, 0.25, 0.15])],
    ['reed_move.anim', reedAnim()],
    ['curves.anim', curves()],
    ['orders.skel', ORDERS],
    ['march.bvh', MARCH],
    ['arm.axskel', ARM],
  ]);
}

/** From −5.2 to 6.3 s, beside the keys and at the first and the last of them. */
const CURVE_TIMES = [...Array.from({ length: 37 }, (_, i) => Number((-5.2 + 0.32 * i).toFixed(2))), -0.4, 0.3, 1.9];

/** The sets of the test kit: which files belong together, and when they are evaluated. */
export const KIT_SETS: readonly KitSet[] = [
  {
    name: 'tree',
    about: 'A skeleton with two branches, angles about three axes, and a pose beyond its limits.',
    files: ['tree.skel'],
    times: [undefined],
    channelTimes: [],
  },
  {
    name: 'sway',
    about: 'The same skeleton in motion, including its root.',
    files: ['tree.skel', 'tree_sway.anim'],
    times: [0.35, 1.2, 2.6],
    channelTimes: [],
  },
  {
    name: 'reed',
    about:
      'A skin with zero to six attachments per vertex, rotated and scaled bindings, and weights that do not sum to 1.',
    files: ['reed.skel', 'reed.skin'],
    times: [undefined],
    channelTimes: [],
  },
  {
    name: 'morphs',
    about: 'The same skin in motion, with two morphs; the last two channels are their weights.',
    files: ['reed.skel', 'reed.skin', 'reed_bulge.morph', 'reed_twist.morph', 'reed_move.anim'],
    times: [0.35, 1.2],
    channelTimes: [],
  },
  {
    name: 'curves',
    about: 'Every tangent and extrapolation, keys at uneven times, and a range that differs from that of the keys.',
    files: ['curves.anim'],
    times: [],
    channelTimes: CURVE_TIMES,
  },
  {
    name: 'march',
    about: 'Motion capture with channels in several orders, and positions of a joint that is not the root.',
    files: ['march.bvh'],
    times: [0, 0.25, 0.5],
    channelTimes: [],
  },
  {
    name: 'orders',
    about:
      "Joints with their own rotation orders, an extension of the course's format: skip this one if you don't read them.",
    files: ['orders.skel'],
    times: [undefined],
    channelTimes: [],
  },
  {
    name: 'arm',
    about: 'A skeleton in the axis-angle form: degrees, axes of any length, children at the tips.',
    files: ['arm.axskel'],
    times: [undefined],
    channelTimes: [],
  },
];
