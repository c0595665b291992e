/**
 * Writes a character as binary FBX: a bone for each joint, in the hierarchy and in the file's own unit and axes, the skin
 * with its materials, morphs as shapes, and an animation stack for each take.
 *
 * The same character and options give the same bytes.
 */
import { playedTake } from '../../evaluate/bake.ts';
import { compileSkeleton } from '../../evaluate/kinematics.ts';
import { writeAnglesNear } from '../../evaluate/rotations/euler-orders.ts';
import { frameRateOf } from '../../evaluate/samples/frame-rate.ts';
import { metresPerUnit } from '../../evaluate/space/metres.ts';
import { ROTATION_ORDERS } from '../../formats/fbx/constants.ts';
import { RADIANS_PER_DEGREE } from '../../math/degrees.ts';
import { setIdentity } from '../../math/mat4.ts';
import { type Character, DEFAULT_PLACEMENT } from '../../model/document.ts';
import { vertexCount } from '../../model/skin.ts';
import { DEFAULT_SPACE } from '../../model/space.ts';
import { type FileJoints, type FilePose, filePoseOf } from '../shared/file-pose.ts';
import { NODE_WIDTH, nodeWriter, ROTATION, SCALE } from '../shared/joint-nodes.ts';
import { lossesOf } from '../shared/losses.ts';
import type { ExchangeOptions } from '../shared/options.ts';
import { type ExchangeFile, type ExchangeProgress, exchangeFile, type Loss } from '../shared/report.ts';
import { playedTakes, takeMotion } from '../shared/take-motion.ts';
import { FbxDocument, intProperty, numberProperty, properties, property, SCENE } from './document.ts';
import { addGeometry, addMaterials, addShapes, addSkin } from './mesh.ts';
import { type NodeRule, type NodeRules, nodeRules, sumAt } from './node-rules.ts';
import { double, type FbxOut, int, named, record, small, text } from './records.ts';
import { addTake, type Moved, type WrittenTake } from './takes.ts';
import { clearestOrder, morphTarget, type NodeRest, type Target, targetsOf } from './targets.ts';

/**
 * A character as an FBX file, in its own space.
 * @throws TakeError, in a sentence, if a take can't be written or isn't there
 */
export function writeFbx(
  character: Character,
  given: ExchangeOptions,
  onProgress?: (progress: ExchangeProgress) => void,
): ExchangeFile {
  // Bones show by themselves.
  const options = { ...given, body: false };
  const document = new FbxDocument();
  const filePose = filePoseOf(character, options);
  const { joints, skin, size, tolerance } = filePose;
  const played = joints ? playedTakes(character, options.take) : [];
  const rules = joints && rulesOf(joints, played);
  const nodes = joints && rules ? addNodes(document, joints, rules, filePose) : undefined;
  const targets = nodes ? [...nodes.targets] : [];
  const mesh = skin && vertexCount(skin) > 0 ? addMesh(document, character, filePose, nodes) : undefined;
  targets.push(...(mesh?.targets ?? []));
  const takes = joints
    ? takesOf(
        document,
        played,
        { targets, skeleton: compileSkeleton(joints.skeleton), fits: joints.nodes, size, tolerance },
        options,
        onProgress,
      )
    : [];
  const { up } = character.space ?? DEFAULT_SPACE;
  const rates = [...new Set(played.flatMap((one) => rateOf(one, options) ?? []))];
  const pieces = document.file(
    { up, centimetres: 100 * metresPerUnit(character.space ?? DEFAULT_SPACE) },
    takes.map(({ listed }) => listed),
    rates[0],
  );
  const motions = takes.map(({ motion }) => motion);
  const common = { character, options, format: 'FBX', filePose, motions, missing: mesh?.missing ?? [] } as const;
  const losses = [
    ...lossesOf({ ...common, ...(rules && { chained: rules }) }),
    ...repeating(takes),
    ...unlikeRates(rates),
    ...moved(character),
  ];
  return exchangeFile(pieces, character, filePose, { takes: takes.map(({ report }) => report), losses });
}

function rateOf(character: Character, { framesPerSecond }: ExchangeOptions): number | undefined {
  const take = playedTake(character);
  return take && (framesPerSecond ?? frameRateOf(take));
}

/** Moments of all takes from which is seen how fitted rotations turn. */
const MOMENTS = 240;

/** The nodes of all joints; those whose angles are fitted have the order that is furthest from gimbal lock in all takes. */
function rulesOf(joints: FileJoints, played: readonly Character[]): NodeRules {
  const compiled = compileSkeleton(joints.skeleton);
  const { nodes, lastOf } = nodeRules(joints.skeleton, compiled, joints.nodes);
  if (!nodes.some(({ rotation }) => rotation === 'fitted')) return { nodes, lastOf };
  const weightsAt = NODE_WIDTH * joints.nodes.nodes.length;
  const rows = played.flatMap((one) => {
    const motion = takeMotion(one, nodeWriter(compiled, joints.nodes), weightsAt);
    if (!motion) return [];
    const count = Math.max(2, Math.ceil(MOMENTS / played.length));
    return Array.from({ length: count }, (_, i) => {
      const row = new Float64Array(weightsAt + one.morphs.length);
      motion.write(motion.start + ((motion.end - motion.start) * i) / (count - 1), row);
      return row;
    });
  });
  const ordered = nodes.map((node): NodeRule => {
    if (node.rotation !== 'fitted') return node;
    const at = NODE_WIDTH * node.fit + ROTATION;
    return { ...node, order: clearestOrder([joints.rest, ...rows].flatMap((row) => [...row.subarray(at, at + 4)])) };
  });
  return { nodes: ordered, lastOf };
}

interface AddedNodes {
  /** The node of each joint. */
  readonly ids: readonly number[];
  readonly targets: readonly Target[];
}

function addNodes(
  document: FbxDocument,
  joints: FileJoints,
  { nodes, lastOf }: NodeRules,
  filePose: FilePose,
): AddedNodes {
  const ids: number[] = [];
  const targets: Target[] = [];
  nodes.forEach((rule, n) => {
    const { name } = joints.skeleton.joints[rule.joint];
    const own = name || `joint${rule.joint}`;
    const rest = restOf(rule, filePose.restPose, joints.rest);
    const id = addBone(
      document,
      lastOf[rule.joint] === n ? own : `${own}_part${rule.place + 1}`,
      rule,
      rest,
      filePose.size,
    );
    document.connect(id, rule.parent < 0 ? SCENE : ids[rule.parent]);
    ids.push(id);
    targets.push(...targetsOf(rule, id, rest));
  });
  return { ids: Array.from(lastOf, (n) => ids[n]), targets };
}

function restOf(
  { translation, rotation, scale, order, fit }: NodeRule,
  pose: readonly number[],
  row: Float64Array,
): NodeRest {
  const at = NODE_WIDTH * fit;
  const angles = new Float64Array(3);
  if (rotation === 'fitted') writeAnglesNear(order, row.slice(at + ROTATION, at + ROTATION + 4), angles);
  else
    rotation.forEach((sum, k) => {
      angles[k] = sumAt(sum, pose);
    });
  return {
    translation: translation.map((sum) => sumAt(sum, pose)),
    angles: [...angles],
    scale: scale === 'fitted' ? [...row.subarray(at + SCALE, at + SCALE + 3)] : scale.map((sum) => sumAt(sum, pose)),
  };
}

/** Part of a character's size that a bone is drawn with. */
const BONE = 0.02;

function addBone(
  document: FbxDocument,
  name: string,
  rule: Pick<NodeRule, 'order' | 'before' | 'after'>,
  rest: NodeRest,
  size: number,
): number {
  const degrees = (angles: readonly number[]) => angles.map((angle) => angle / RADIANS_PER_DEGREE);
  const id = document.add(
    'Model',
    named(name, 'Model'),
    'LimbNode',
    modelContent(rest.translation, degrees(rest.angles), rest.scale, [
      property('RotationOrder', ['enum', '', ''], int(ROTATION_ORDERS.indexOf(rule.order))),
      property('RotationActive', ['bool', '', ''], int(1)),
      ...turnProperty('PreRotation', rule.before),
      ...turnProperty('PostRotation', rule.after),
    ]),
  );
  const attribute = document.add('NodeAttribute', named(name, 'NodeAttribute'), 'LimbNode', [
    properties(numberProperty('Size', BONE * size)),
    record('TypeFlags', [text('Skeleton')]),
  ]);
  document.connect(attribute, id);
  return id;
}

function turnProperty(name: string, turn: Float64Array | undefined): readonly FbxOut[] {
  if (!turn) return [];
  const angles = new Float64Array(3);
  // Constant rotations are in the plain order, whatever the node's.
  writeAnglesNear('xyz', turn, angles);
  return [
    property(name, ['Vector3D', 'Vector', ''], ...Array.from(angles, (angle) => double(angle / RADIANS_PER_DEGREE))),
  ];
}

function modelContent(
  translation: readonly number[],
  degrees: readonly number[],
  scale: readonly number[],
  more: readonly FbxOut[],
): readonly FbxOut[] {
  const local = (name: string, values: readonly number[]) => property(name, [name, '', 'A'], ...values.map(double));
  return [
    record('Version', [int(232)]),
    properties(
      ...more,
      intProperty('DefaultAttributeIndex', 0),
      property('InheritType', ['enum', '', ''], int(1)),
      local('Lcl Translation', translation),
      local('Lcl Rotation', degrees),
      local('Lcl Scaling', scale),
    ),
    record('Shading', [small(1)]),
    record('Culling', [text('CullingOff')]),
  ];
}

const NOWHERE = [0, 0, 0];
const UNSCALED = [1, 1, 1];

interface AddedMesh {
  readonly missing: readonly string[];
  readonly targets: readonly Target[];
}

function addMesh(
  document: FbxDocument,
  character: Character,
  filePose: FilePose,
  nodes: AddedNodes | undefined,
): AddedMesh {
  const { skin, joints, sets, restPose } = filePose;
  if (!skin) return { missing: [], targets: [] };
  const model = document.add('Model', named(skin.name, 'Model'), 'Mesh', modelContent(NOWHERE, NOWHERE, UNSCALED, []));
  document.connect(model, SCENE);
  const geometry = addGeometry(document, skin, model);
  const missing = addMaterials(document, skin, character.textures, model);
  const firstWeight = restPose.length - character.morphs.length;
  const weights = restPose.slice(firstWeight);
  const channels = addShapes(document, skin, character.morphs, geometry, weights);
  if (joints && sets && nodes) {
    const count = nodes.ids.length;
    const worlds = new Float64Array(16 * (count + 1));
    joints.nodes.lastOf.forEach((node, joint) => {
      worlds.set(joints.worlds.subarray(16 * node, 16 * node + 16), 16 * joint);
    });
    setIdentity(worlds, 16 * count);
    const ids = [...nodes.ids, sets.hasStatic ? addResting(document, filePose.size) : -1];
    const names = [...joints.skeleton.joints.map(({ name }) => name), RESTING];
    addSkin(document, skin, { sets, geometry, model }, { ids, names, worlds });
  }
  return { missing, targets: channels.map((id, m) => morphTarget(id, firstWeight + m, weights[m])) };
}

/** The name of the bone that never moves. */
const RESTING = 'resting';

function addResting(document: FbxDocument, size: number): number {
  const rest = { translation: NOWHERE, angles: NOWHERE, scale: UNSCALED };
  const id = addBone(document, RESTING, { order: 'xyz' }, rest, size);
  document.connect(id, SCENE);
  return id;
}

function takesOf(
  document: FbxDocument,
  played: readonly Character[],
  moved: Moved,
  options: ExchangeOptions,
  onProgress?: (progress: ExchangeProgress) => void,
): readonly WrittenTake[] {
  return played.flatMap((one, i) => {
    onProgress?.({ label: playedTake(one)?.name ?? '', fraction: i / played.length });
    return addTake(document, one, moved, options) ?? [];
  });
}

function repeating(takes: readonly WrittenTake[]): readonly Loss[] {
  const count = takes.reduce((sum, take) => sum + take.repeating, 0);
  if (count === 0) return [];
  const curves = count === 1 ? 'One curve repeats its keys' : `${count} curves repeat their keys`;
  const message = `${curves} so often that the file says it instead of writing them out. Blender and three.js ignore that: for them, write a key per frame.`;
  return [{ code: 'curves-repeat', severity: 'info', message }];
}

function unlikeRates(rates: readonly number[]): readonly Loss[] {
  if (rates.length < 2) return [];
  const message = `A file has one rate: ${Number(rates[0].toPrecision(6))} frames per second, as the first take; other takes keep the times of their keys.`;
  return [{ code: 'rates-differ', severity: 'info', message }];
}

function moved({ placements }: Character): readonly Loss[] {
  const { position, turn, scale } = placements[0] ?? DEFAULT_PLACEMENT;
  const isHome = [...position, ...turn].every((value) => value === 0) && scale === 1;
  if (isHome) return [];
  const message = 'The character is in its own space in the file, not where it is in the scene.';
  return [{ code: 'placement-left-out', severity: 'info', message }];
}
