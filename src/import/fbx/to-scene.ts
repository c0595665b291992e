/** An FBX document as a scene: right-handed, y up, in the file's own unit and times. */

import { fitKeys } from '../../evaluate/fitting/fit-keys.ts';
import { writeQuaternion } from '../../evaluate/rotations/euler-orders.ts';
import { quaternionOfRotation } from '../../math/quaternion.ts';
import { ZERO } from '../../math/vec3.ts';
import type { EulerOrder } from '../../model/skeleton/skeleton.ts';
import type { Budget } from '../budget.ts';
import type { Scene, SceneNode, SceneTake, SceneWeight } from '../scene.ts';
import { type FbxTake, takesOf } from './animation.ts';
import { axesOf, type FbxAxes, metresOf } from './axes.ts';
import { channelOf } from './channels.ts';
import { documentOf } from './document.ts';
import type { FbxReport } from './failure.ts';
import { type FbxJoint, jointsOf, Stretches } from './joints.ts';
import { lostOf } from './lost.ts';
import { Materials } from './materials.ts';
import { type BuiltMesh, meshesOf } from './meshes.ts';
import { driversOf, numberInTake, SceneMotion } from './motion.ts';
import {
  constantChannel,
  type Fitting,
  Mover,
  orderOf,
  restAngles,
  restFactors,
  stopsOf,
  type Tolerances,
} from './moves.ts';
import { nodesOf, writeNodeRotation, writeNodeTranslation } from './nodes.ts';
import type { FbxFile } from './records/record.ts';
import { shapeWeight } from './shapes.ts';

/** Fraction of the size, for lengths; an angle that moves the end of a bone of that size by less; a factor likewise. */
const TOLERANCE = 2e-5;
/** Keys that fitting may make beyond the usual, besides one for two bytes of the file. */
const MAX_SPARE = 20_000;
const BONES = new Set(['LimbNode', 'Limb', 'Root', 'Effector']);

/** Undefined, after an error, if the file has no models. */
export function sceneOf(file: FbxFile, name: string, report: FbxReport): Scene | undefined {
  const document = documentOf(file);
  const nodes = nodesOf(document);
  if (nodes.length === 0) {
    report.error('no-models', 'Expected models, found none: the file has nothing to show.', 0);
    return undefined;
  }
  const axes = axesOf(document.settings) ?? upright(report);
  const takes = takesOf(document, report);
  const joints = jointsOf(nodes, takes, axes.isIdentity ? 0 : 1);
  const orders = joints.map((joint) => orderOf(joint, takes));
  const rest = new SceneMotion(nodes, undefined);
  rest.at(0);
  const lost = new Set<string>();
  const materials = new Materials(document);
  const meshes = meshesOf({ document, joints, worlds: rest.worlds, axes: axes.matrix, materials, lost }, report);
  const tolerances = tolerancesOf(rest.worlds, meshes);
  const spare = MAX_SPARE + report.budget.bytes / 2;
  const fitting: Fitting = { nodes: new Set(), keysBefore: 0, keysAfter: 0, spare };
  const metres = metresOf(document.settings) ?? centimetre(report);
  const scene = {
    name,
    metres,
    nodes: sceneNodes(joints, orders, axes),
    meshes: meshes.map(({ mesh }) => mesh),
    materials: materials.materials,
    textures: materials.textures,
    takes: takes.map((take) => takeOf(take, joints, orders, meshes, { tolerances, fitting, budget: report.budget })),
  };
  tellSpace(axes, metres, report);
  tellFitting(fitting, report);
  for (const what of [...materials.lost, ...lostOf(document, nodes)]) lost.add(what);
  if (lost.size > 0) report.info('content-left-out', `Not read: ${[...lost].join(', ')}.`);
  return scene;
}

function upright(report: FbxReport): FbxAxes {
  report.warn('bad-axes', 'The settings name an axis twice.', 0, 'y up, right-handed');
  const matrix = Float64Array.from({ length: 16 }, (_, i) => (i % 5 === 0 ? 1 : 0));
  return { matrix, isIdentity: true, up: 'y', isLeftHanded: false };
}

function centimetre(report: FbxReport): number {
  report.warn('bad-unit', 'The settings state a unit (UnitScaleFactor) that is not a length.', 0, '1 cm');
  return 0.01;
}

function sceneNodes(joints: readonly FbxJoint[], orders: readonly EulerOrder[], axes: FbxAxes): SceneNode[] {
  const nodes: SceneNode[] = [];
  if (!axes.isIdentity) nodes.push(axesNode(axes));
  const stretches = new Stretches(
    joints.map(({ node }) => node),
    undefined,
  );
  const top = axes.isIdentity ? -1 : 0;
  const q = new Float64Array(4);
  const at = new Float64Array(3);
  const angles = new Float64Array(3);
  for (const [i, joint] of joints.entries()) {
    const { node, unscale, source, divisor } = joint;
    const parent = node.parent < 0 ? top : joints[node.parent].at;
    writeNodeRotation(node, node.angles, q);
    writeNodeTranslation(node, node.translation, q, node.scale, at);
    const order = orders[i];
    restAngles(joint, order, angles);
    writeQuaternion(order, angles, q);
    const { name, type } = node.object;
    const translation = [at[0], at[1], at[2]] as const;
    if (unscale >= 0) {
      const scale = restFactors(stretches, -1, divisor);
      nodes.push({ name: `${name}_unscale`, parent, translation, rotation: [0, 0, 0, 1], scale });
    }
    const factors = restFactors(stretches, source, unscale < 0 ? divisor : -1);
    nodes.push({
      name,
      parent: unscale < 0 ? parent : unscale,
      translation: unscale < 0 ? translation : ZERO,
      rotation: [q[0], q[1], q[2], q[3]],
      scale: [node.scale[0] * factors[0], node.scale[1] * factors[1], node.scale[2] * factors[2]],
      euler: { order, angles: [angles[0], angles[1], angles[2]] },
      ...(BONES.has(type) && { isBone: true }),
    });
  }
  return nodes;
}

/** The node above all others that turns the file's axes; mirrored if the file is left-handed. */
function axesNode({ matrix, isLeftHanded }: FbxAxes): SceneNode {
  const sign = isLeftHanded ? -1 : 1;
  const rotation = Float64Array.from({ length: 9 }, (_, i) => sign * matrix[4 * Math.floor(i / 3) + (i % 3)]);
  const q = new Float64Array(4);
  quaternionOfRotation(rotation, 0, q);
  return {
    name: 'RootNode',
    parent: -1,
    translation: ZERO,
    rotation: [q[0], q[1], q[2], q[3]],
    scale: [sign, sign, sign],
  };
}

/** By the box around nodes and vertices at rest. */
function tolerancesOf(worlds: Float64Array, meshes: readonly BuiltMesh[]): Tolerances {
  const low = [0, 1, 2].map(() => Number.POSITIVE_INFINITY);
  const high = [0, 1, 2].map(() => Number.NEGATIVE_INFINITY);
  const include = (points: Float64Array, stride: number) => {
    for (let k = 0; k < 3; k++) {
      for (let o = k; o < points.length; o += stride) {
        low[k] = Math.min(low[k], points[o]);
        high[k] = Math.max(high[k], points[o]);
      }
    }
  };
  include(worlds.subarray(12), 16);
  for (const { mesh } of meshes) include(mesh.positions, 3);
  const size = Math.hypot(...[0, 1, 2].map((k) => high[k] - low[k])) || 1;
  return { length: TOLERANCE * size, angle: TOLERANCE, factor: TOLERANCE };
}

function takeOf(
  take: FbxTake,
  joints: readonly FbxJoint[],
  orders: readonly EulerOrder[],
  meshes: readonly BuiltMesh[],
  {
    tolerances,
    fitting,
    budget,
  }: { readonly tolerances: Tolerances; readonly fitting: Fitting; readonly budget: Budget },
): SceneTake {
  const targetCount = meshes.reduce((sum, { sources }) => sum + sources.length, 0);
  budget.spendTake(joints.length, targetCount, `The take ${take.name}`);
  const mover = new Mover(joints, take, tolerances, fitting, budget);
  const moves = joints.flatMap((joint, i) => mover.of(joint, orders[i]));
  const weights = meshes.flatMap(({ sources }, mesh) =>
    sources.flatMap((source, target) => weightOf(take, source, mesh, target)),
  );
  const { name, range, framesPerSecond } = take;
  return { name, range, ...(framesPerSecond !== undefined && { framesPerSecond }), moves, weights };
}

/** How a take drives the weight of a shape; nothing if it doesn't. */
function weightOf(
  take: FbxTake,
  { channel, shape }: BuiltMesh['sources'][number],
  mesh: number,
  target: number,
): SceneWeight[] {
  const drivers = driversOf(take, channel.object.id, 'DeformPercent');
  const curves = drivers.flatMap((driver) => driver?.curves ?? []).filter((curve) => curve !== undefined);
  if (drivers.every((driver) => driver === undefined)) return [];
  const percentAt = (time: number) => numberInTake(take, drivers, time, channel.percent);
  if (curves.length === 0) {
    return [{ mesh, target, curve: constantChannel(shapeWeight(channel.shapes, shape, percentAt(take.range[0]))) }];
  }
  if (curves.length === 1 && drivers[0] && channel.shapes.length === 1) {
    const factor = 1 / channel.shapes[shape].full;
    return [{ mesh, target, curve: channelOf(curves[0], TOLERANCE / factor, factor) }];
  }
  const layers = take.layers.flatMap(({ weightCurve }) => weightCurve ?? []);
  const stops = stopsOf([...curves, ...layers], take.range);
  const write = (time: number, _: Float64Array, out: Float64Array) => {
    out[0] = shapeWeight(channel.shapes, shape, percentAt(time));
  };
  const [list] = fitKeys(write, stops, [0], [TOLERANCE]);
  return [{ mesh, target, curve: list.channel(1, 0, 'constant', 'constant') }];
}

function tellSpace({ isIdentity, up, isLeftHanded }: FbxAxes, metres: number, report: FbxReport): void {
  const unit = metres >= 1 ? `${Number(metres.toPrecision(6))} m` : `${Number((100 * metres).toPrecision(6))} cm`;
  const turned = isIdentity ? 'y is up in the file as well' : `${up} is up in the file: it was turned so that y is`;
  const mirrored = isLeftHanded ? ', and mirrored, since its axes are left-handed' : '';
  report.info('fbx-space', `The length unit is ${unit}, as in the file; ${turned}${mirrored}.`);
}

function tellFitting({ nodes, keysBefore, keysAfter, spare }: Fitting, report: FbxReport): void {
  if (nodes.size === 0) return;
  if (spare <= 0) {
    const message = `Curves repeat or bend so often that they would need more than ${keysAfter} keys.`;
    report.warn('curves-too-long', message, 0, 'used fewer keys, outside the tolerance');
  }
  const what = nodes.size === 1 ? 'One node has' : `${nodes.size} nodes have`;
  report.info(
    'curves-fitted',
    `${what} layers, pivots, pre-rotations or inherited scales between curves and motion: ${keysBefore} keys became ${keysAfter}, fitted within ${TOLERANCE} of the size.`,
  );
}
