/** Trees of joints that programs which find people in videos give positions of, by the order of their joints. */

/** A tree of joints, and where each of them is among the points of a file. */
export interface JointTree {
  /** For messages: "Human3.6M". */
  readonly label: string;
  readonly names: readonly string[];
  /** Index of each parent; -1 for the root. */
  readonly parents: readonly number[];
  /** The point of each joint, or the two that it is in the middle of. */
  readonly points: readonly (readonly [number] | readonly [number, number])[];
  /** Whether its names are those of this file. */
  readonly isKnown?: true;
}

/** `child` and its parent, where that is another one than `USUAL` says. */
type Parents = Readonly<Record<string, string>>;

const SIDES = ['left', 'right'] as const;

/** Of all trees, without sides. */
const USUAL: Parents = {
  hip: 'pelvis',
  knee: 'hip',
  ankle: 'knee',
  foot: 'ankle',
  shoulder: 'neck',
  elbow: 'shoulder',
  wrist: 'elbow',
  neck: 'pelvis',
  nose: 'neck',
  eye: 'nose',
  ear: 'eye',
  head: 'neck',
};

function both(...parts: readonly string[]): readonly string[] {
  return parts.flatMap((part) => SIDES.map((side) => `${side}_${part}`));
}

function ofSide(side: string, parts: string): readonly string[] {
  return parts.split(' ').map((part) => `${side}_${part}`);
}

const LEG = 'hip knee ankle';
const ARM = 'shoulder elbow wrist';
const EYE = 'eye_inner eye eye_outer';

/** A tree of named points; `pelvis` and `neck` are between hips and shoulders where they are no points. */
function treeOf(label: string, points: readonly string[], parents: Parents): JointTree {
  const made: [string, readonly [number, number]][] = [];
  const middle = (name: string, part: string) => {
    const [left, right] = SIDES.map((side) => points.indexOf(`${side}_${part}`));
    if (!points.includes(name)) made.push([name, [left, right]]);
  };
  middle('pelvis', 'hip');
  if (!points.includes('thorax') && !points.includes('spine1')) middle('neck', 'shoulder');
  const names = [...made.map(([name]) => name), ...points];
  return {
    label,
    names,
    parents: names.map((name) => names.indexOf(parentOf(name, parents) ?? '')),
    points: [...made.map(([, pair]) => pair), ...points.map((_, i): readonly [number] => [i])],
    isKnown: true,
  };
}

function parentOf(name: string, parents: Parents): string | undefined {
  const [, side, part] = /^(left|right)_(.*)$/.exec(name) ?? [];
  const own = parents[name] ?? parents[part ?? name] ?? USUAL[part ?? name];
  return side && own && isPaired(own) ? `${side}_${own}` : own;
}

/** Whether a person has two of a part. */
function isPaired(part: string): boolean {
  return !MIDDLE.has(part);
}

const MIDDLE = new Set(['pelvis', 'neck', 'nose', 'head', 'spine', 'thorax', 'chest', 'spine1', 'spine2', 'spine3']);

/** The joints of SMPL's body, in its order. */
export const SMPL_BODY: readonly string[] = [
  ...['pelvis', ...both('hip'), 'spine1', ...both('knee'), 'spine2', ...both('ankle'), 'spine3', ...both('foot')],
  ...['neck', ...both('collar'), 'head', ...both('shoulder', 'elbow', 'wrist')],
];

const SMPL: Parents = {
  ...{ spine1: 'pelvis', spine2: 'spine1', spine3: 'spine2', neck: 'spine3', collar: 'spine3', shoulder: 'collar' },
  hand: 'wrist',
};

/** By the number of points; those of one number are told apart by how much their bones vary. */
const TREES: readonly JointTree[] = [
  treeOf('SMPL', SMPL_BODY, SMPL),
  treeOf('SMPL', [...SMPL_BODY, ...both('hand')], SMPL),
  treeOf('COCO', ['nose', ...both('eye', 'ear', 'shoulder', 'elbow', 'wrist', 'hip', 'knee', 'ankle')], {}),
  treeOf(
    'Human3.6M',
    [
      ...['pelvis', ...ofSide('right', LEG), ...ofSide('left', LEG), 'spine', 'thorax', 'neck', 'head'],
      ...[...ofSide('left', ARM), ...ofSide('right', ARM)],
    ],
    { spine: 'pelvis', thorax: 'spine', neck: 'thorax', shoulder: 'thorax' },
  ),
  treeOf(
    'BODY_25',
    [
      ...['nose', 'neck', ...ofSide('right', ARM), ...ofSide('left', ARM), 'pelvis'],
      ...[...ofSide('right', LEG), ...ofSide('left', LEG), 'right_eye', 'left_eye', 'right_ear', 'left_ear'],
      ...[...ofSide('left', 'big_toe small_toe heel'), ...ofSide('right', 'big_toe small_toe heel')],
    ],
    { big_toe: 'ankle', small_toe: 'ankle', heel: 'ankle' },
  ),
  treeOf(
    'Kinect v2',
    [
      ...['pelvis', 'spine', 'neck', 'head', ...ofSide('left', `${ARM} hand`), ...ofSide('right', `${ARM} hand`)],
      ...[...ofSide('left', `${LEG} foot`), ...ofSide('right', `${LEG} foot`), 'chest'],
      ...[...ofSide('left', 'hand_tip thumb'), ...ofSide('right', 'hand_tip thumb')],
    ],
    {
      ...{ spine: 'pelvis', chest: 'spine', neck: 'chest', shoulder: 'chest' },
      ...{ hand: 'wrist', thumb: 'wrist', hand_tip: 'hand' },
    },
  ),
  treeOf(
    'MediaPipe',
    [
      ...['nose', ...ofSide('left', EYE), ...ofSide('right', EYE), ...both('ear'), 'mouth_left', 'mouth_right'],
      ...both('shoulder', 'elbow', 'wrist', 'pinky', 'index', 'thumb', 'hip', 'knee', 'ankle', 'heel', 'foot_index'),
    ],
    {
      ...{ eye_inner: 'eye', eye_outer: 'eye', ear: 'eye_outer', mouth_left: 'nose', mouth_right: 'nose' },
      ...{ pinky: 'wrist', index: 'wrist', thumb: 'wrist', heel: 'ankle', foot_index: 'ankle' },
    },
  ),
];

/** The known trees of so many points. */
export function treesOf(pointCount: number): readonly JointTree[] {
  return TREES.filter((tree) => pointCountOf(tree) === pointCount);
}

/** How many points the known trees have, each number once, the smallest first. */
export function knownCounts(): readonly number[] {
  return [...new Set(TREES.map(pointCountOf))].sort((a, b) => a - b);
}

/** The known tree with the most points that all have one of these labels, by those; undefined if there is none. */
export function treeOfLabels(labels: readonly string[]): JointTree | undefined {
  const at = new Map(labels.map((label, p) => [plain(label), p]));
  const found = LARGEST_FIRST.find(({ names, points }) =>
    points.every(([, other], j) => other !== undefined || at.has(plain(names[j]))),
  );
  if (!found) return undefined;
  const { names, points } = found;
  const own = new Map(
    points.flatMap(([p, other], j) => (other === undefined ? [[p, at.get(plain(names[j])) ?? 0]] : [])),
  );
  const of = (p: number) => own.get(p) ?? 0;
  return { ...found, points: points.map(([a, b]) => (b === undefined ? [of(a)] : [of(a), of(b)])) };
}

const LARGEST_FIRST = TREES.toSorted((a, b) => pointCountOf(b) - pointCountOf(a));

/** Case, blanks, `_` and `-` are not meant. */
function plain(label: string): string {
  return label.toLowerCase().replace(/[\s_-]/g, '');
}

function pointCountOf({ points }: JointTree): number {
  return Math.max(...points.flat()) + 1;
}
