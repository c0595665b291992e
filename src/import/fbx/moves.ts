/**
 * The takes of an FBX file as curves of the scene's nodes. Where one layer drives a property and no pivot comes
 * between, its curves are the channels, with their keys and slopes; elsewhere keys are fitted to where the node is.
 */

import { type Fitted, fitKeys } from '../../evaluate/fitting/fit-keys.ts';
import { KeyList } from '../../evaluate/fitting/key-list.ts';
import { axesOfOrder, writeAnglesNear } from '../../evaluate/rotations/euler-orders.ts';
import { RADIANS_PER_DEGREE } from '../../math/degrees.ts';
import type { Vec3 } from '../../math/vec3.ts';
import type { EulerOrder } from '../../model/skeleton/skeleton.ts';
import { EULER_ORDERS } from '../../model/skeleton/skeleton.ts';
import type { Channel } from '../../model/takes/take.ts';
import type { Budget } from '../budget.ts';
import { NOISE } from '../noise.ts';
import type { AxisCurves, SceneMove } from '../scene.ts';
import type { Driven, FbxTake } from './animation.ts';
import { ascending, channelKeys, channelOf } from './channels.ts';
import type { Beyond, FbxCurve } from './curve.ts';
import { type FbxJoint, Stretches } from './joints.ts';
import { driversOf, NodeMotion } from './motion.ts';
import { hasPivots, writeNodeRotation, writeNodeTranslation } from './nodes.ts';

/** How far fitted keys may be off. */
export interface Tolerances {
  readonly length: number;
  /** Radians. */
  readonly angle: number;
  readonly factor: number;
}

/** Outcome of fitting, for the message about it. */
export interface Fitting {
  readonly nodes: Set<number>;
  keysBefore: number;
  keysAfter: number;
  /** Keys that may still be made beyond a few for each key of the file. */
  spare: number;
}

/** Keys that fitting makes of one of the file's before it needs spare ones. */
const USUAL_KEYS = 4;
/** Numbers that a key of a curve becomes. */
const PER_KEY = 8;

type Drivers = readonly (Driven | undefined)[];

const REST: AxisCurves = [undefined, undefined, undefined];

/** Whether a take moves anything of a kind. */
function isDriven(drivers: Drivers): boolean {
  return drivers.some((driver) => driver !== undefined);
}

/** Curves of the lowest layer, if it is the only one. */
function onlyDriver(drivers: Drivers): Driven | undefined {
  return drivers.slice(1).some((driver) => driver !== undefined) ? undefined : drivers[0];
}

function curvesOf(drivers: Drivers, take: FbxTake): FbxCurve[] {
  const all: FbxCurve[] = [];
  for (const driver of drivers) for (const curve of driver?.curves ?? []) if (curve) all.push(curve);
  // Weights of layers move everything that these drive.
  take.layers.forEach(({ weightCurve }, l) => {
    if (weightCurve && drivers[l]) all.push(weightCurve);
  });
  return all;
}

/** The order that a joint's angles are in: its own, or for angles that are fitted the one furthest from gimbal lock. */
export function orderOf(joint: FbxJoint, takes: readonly FbxTake[]): EulerOrder {
  const { node, kept } = joint;
  if (kept) return kept.order;
  const q = new Float64Array(4);
  const angles = new Float64Array(3);
  const clearances = new Map<EulerOrder, number>(EULER_ORDERS.map((order) => [order, 1]));
  for (const take of takes) {
    const drivers = driversOf(take, node.object.id, 'Lcl Rotation');
    if (!isDriven(drivers)) continue;
    const motion = new NodeMotion(node, take);
    const stops = stopsOf(curvesOf(drivers, take), take.range);
    const step = Math.max(1, Math.floor(stops.length / 200));
    for (let i = 0; i < stops.length; i += step) {
      motion.anglesAt(stops[i]);
      writeNodeRotation(node, motion.angles, q);
      for (const [order, clearance] of clearances) {
        writeAnglesNear(order, q, angles);
        clearances.set(order, Math.min(clearance, Math.abs(Math.cos(angles[axesOfOrder(order)[1]]))));
      }
    }
  }
  const own = clearances.get(node.order) ?? 0;
  const best = Math.max(...clearances.values());
  // Its own, unless that comes near gimbal lock.
  return own > 0.3 || own >= best
    ? node.order
    : (EULER_ORDERS.find((order) => clearances.get(order) === best) ?? 'xyz');
}

/** Makes the moves of one take. */
export class Mover {
  private readonly stretches: Stretches;
  private readonly restStretches: Stretches;

  constructor(
    private readonly joints: readonly FbxJoint[],
    private readonly take: FbxTake,
    private readonly tolerances: Tolerances,
    private readonly fitting: Fitting,
    private readonly budget: Budget,
  ) {
    const nodes = joints.map(({ node }) => node);
    this.stretches = new Stretches(nodes, take);
    this.restStretches = new Stretches(nodes, undefined);
  }

  /** One or two for a joint, none if the take leaves it at rest. */
  of(joint: FbxJoint, order: EulerOrder): SceneMove[] {
    const { node, at, unscale } = joint;
    const { id } = node.object;
    const drivers = {
      translation: driversOf(this.take, id, 'Lcl Translation'),
      rotation: driversOf(this.take, id, 'Lcl Rotation'),
      scale: driversOf(this.take, id, 'Lcl Scaling'),
    };
    let keys = 0;
    for (const own of Object.values(drivers)) for (const curve of curvesOf(own, this.take)) keys += channelKeys(curve);
    this.budget.spend(PER_KEY * keys, `The curves of ${node.object.name}`);
    const translation = this.translation(joint, drivers.translation, drivers.rotation, drivers.scale);
    const angles = this.rotation(joint, drivers.rotation, order);
    const scale = this.scale(joint, drivers.scale);
    const moves: SceneMove[] = [];
    if (unscale >= 0) {
      const undone = this.undoing(joint);
      if (translation || undone) {
        moves.push({ node: unscale, ...(translation && { translation }), ...(undone && { scale: undone }) });
      }
    }
    const own = unscale < 0 ? translation : undefined;
    if (own || angles || scale) {
      moves.push({
        node: at,
        ...(own && { translation: own }),
        ...(angles && { rotation: { kind: 'euler', angles } }),
        ...(scale && { scale }),
      });
    }
    return moves;
  }

  private translation(joint: FbxJoint, drivers: Drivers, rotating: Drivers, scaling: Drivers): AxisCurves | undefined {
    const { node } = joint;
    const pivots = hasPivots(node);
    const depends = pivots && (isDriven(rotating) || isDriven(scaling));
    if (!isDriven(drivers) && !depends) return undefined;
    const rest = new Float64Array(3);
    const q = new Float64Array(4);
    writeNodeRotation(node, node.angles, q);
    writeNodeTranslation(node, node.translation, q, node.scale, rest);
    const only = onlyDriver(drivers);
    if (only && !depends) {
      return direct(only, (k) => ({
        tolerance: this.tolerances.length,
        factor: 1,
        offset: rest[k] - node.translation[k],
        rest: rest[k],
      }));
    }
    const curves = [drivers, ...(pivots ? [rotating, scaling] : [])].flatMap((own) => curvesOf(own, this.take));
    const motion = new NodeMotion(node, this.take);
    return this.fitted(joint, curves, rest, this.tolerances.length, (time, _, out) => {
      if (pivots) {
        motion.at(time);
        writeNodeRotation(node, motion.angles, q);
      } else {
        motion.translationAt(time);
      }
      writeNodeTranslation(node, motion.translation, q, motion.scale, out);
    });
  }

  private rotation(joint: FbxJoint, drivers: Drivers, order: EulerOrder): AxisCurves | undefined {
    const { node, kept } = joint;
    if (!isDriven(drivers)) return undefined;
    const only = onlyDriver(drivers);
    if (only && kept) {
      const { turns, follows } = kept;
      const curves = only.curves.map((curve, k) => (follows[k] ? curve : undefined));
      return direct({ ...only, curves }, (k) => ({
        tolerance: this.tolerances.angle / RADIANS_PER_DEGREE,
        factor: follows[k] ? RADIANS_PER_DEGREE : 0,
        offset: turns[k],
        rest: turns[k] + (follows[k] ? node.angles[k] : 0),
      }));
    }
    const motion = new NodeMotion(node, this.take);
    const q = new Float64Array(4);
    const rest = new Float64Array(3);
    restAngles(joint, order, rest);
    return this.fitted(joint, curvesOf(drivers, this.take), rest, this.tolerances.angle, (time, near, out) => {
      motion.anglesAt(time);
      writeNodeRotation(node, motion.angles, q);
      out.set(near);
      writeAnglesNear(order, q, out);
    });
  }

  private scale(joint: FbxJoint, drivers: Drivers): AxisCurves | undefined {
    const { node, source, unscale } = joint;
    const divisor = unscale < 0 ? joint.divisor : -1;
    const isInherited = this.isStretched(source) || this.isStretched(divisor);
    if (!isDriven(drivers) && !isInherited) return undefined;
    const factors = restFactors(this.restStretches, source, divisor);
    const rest = node.scale.map((own, k) => own * factors[k]);
    const only = onlyDriver(drivers);
    if (only && !isInherited) {
      return direct(only, (k) => ({ tolerance: this.tolerances.factor, factor: factors[k], offset: 0, rest: rest[k] }));
    }
    const motion = new NodeMotion(node, this.take);
    const curves = [...curvesOf(drivers, this.take), ...this.stretchCurves(source), ...this.stretchCurves(divisor)];
    return this.fitted(joint, curves, rest, this.tolerances.factor, (time, _, out) => {
      motion.scaleAt(time);
      const [from, by] = [this.stretches.of(source, time), this.stretches.of(divisor, time)];
      for (let k = 0; k < 3; k++) out[k] = motion.scale[k] * quotient(from[k], by[k]);
    });
  }

  /** The scale of the node above a joint that takes back its parent's stretch. */
  private undoing(joint: FbxJoint): AxisCurves | undefined {
    if (!this.isStretched(joint.divisor)) return undefined;
    const curves = this.stretchCurves(joint.divisor);
    const rest = restFactors(this.restStretches, -1, joint.divisor);
    return this.fitted(joint, curves, rest, this.tolerances.factor, (time, _, out) => {
      const by = this.stretches.of(joint.divisor, time);
      for (let k = 0; k < 3; k++) out[k] = quotient(1, by[k]);
    });
  }

  /** Whether the take gives a node another stretch than it rests with, at any time. */
  private isStretched(index: number): boolean {
    if (index < 0) return false;
    const { node, source } = this.joints[index];
    const isScaled = driversOf(this.take, node.object.id, 'Lcl Scaling').some(
      (driver, layer) =>
        driver !== undefined &&
        (layer > 0 || driver.curves.some(Boolean) || driver.values.some((value, k) => !isNear(value, node.scale[k]))),
    );
    return isScaled || this.isStretched(source);
  }

  /** All curves that a node's stretch depends on. */
  private stretchCurves(index: number): FbxCurve[] {
    if (index < 0) return [];
    const { node, source } = this.joints[index];
    const own = curvesOf(driversOf(this.take, node.object.id, 'Lcl Scaling'), this.take);
    return [...own, ...this.stretchCurves(source)];
  }

  private fitted(
    { node }: FbxJoint,
    curves: readonly FbxCurve[],
    rest: ArrayLike<number>,
    tolerance: number,
    write: Fitted,
  ): AxisCurves {
    const { fitting } = this;
    const keys = curves.reduce((sum, { times }) => sum + times.length, 0);
    if (curves.every((curve) => curve.isConstant) && isAtRest(write, curves, rest)) {
      fitting.nodes.add(node.object.id);
      fitting.keysBefore += keys;
      return REST;
    }
    const stops = stopsOf(curves, this.take.range, fitting.spare);
    const usual = USUAL_KEYS * keys;
    const most = usual + Math.max(0, fitting.spare);
    const lists = fitKeys(write, stops, rest, [tolerance, tolerance, tolerance], most);
    fitting.spare -= Math.max(0, lists[0].count - usual);
    fitting.nodes.add(node.object.id);
    fitting.keysBefore += keys;
    return asCurves((k) => {
      const list = lists[k];
      const isRest = list.isConstant(REST_NOISE) && Math.abs(list.firstValue - rest[k]) <= REST_NOISE;
      if (isRest) return undefined;
      this.fitting.keysAfter += list.count;
      return list.channel(1, 0, 'constant', 'constant');
    });
  }
}

/** What is off by less is at rest. */
const REST_NOISE = 1e-9;

/** Whether what never changes is as at rest. */
function isAtRest(write: Fitted, [curve]: readonly FbxCurve[], rest: ArrayLike<number>): boolean {
  const value = Float64Array.from(rest);
  write(curve ? curve.times[0] : 0, Float64Array.from(rest), value);
  return value.every((own, k) => Math.abs(own - rest[k]) <= REST_NOISE);
}

/**
 * Factors that a joint's own scale is multiplied by at rest: the stretch of one node by that of another; -1 for none.
 */
export function restFactors(stretches: Stretches, source: number, divisor: number): Vec3 {
  const [from, by] = [stretches.of(source, 0), stretches.of(divisor, 0)];
  return [quotient(from[0], by[0]), quotient(from[1], by[1]), quotient(from[2], by[2])];
}

function isNear(a: number, b: number): boolean {
  return Math.abs(a - b) <= NOISE * Math.abs(b);
}

/** A stretch of 0 can't be undone: what is flat stays so. */
function quotient(a: number, b: number): number {
  return b === 0 ? a : a / b;
}

/** The angles of a joint at rest, in an order. */
export function restAngles({ node, kept }: FbxJoint, order: EulerOrder, out: Float64Array): void {
  if (kept) {
    for (let k = 0; k < 3; k++) out[k] = kept.turns[k] + (kept.follows[k] ? node.angles[k] : 0);
    return;
  }
  const q = new Float64Array(4);
  writeNodeRotation(node, node.angles, q);
  out.fill(0);
  writeAnglesNear(order, q, out);
}

interface AxisTerms {
  readonly tolerance: number;
  readonly factor: number;
  readonly offset: number;
  /** The value of the joint at rest. */
  readonly rest: number;
}

/** The curves of a driver as channels; an axis without a curve has a key only if it is not at rest. */
function direct({ curves, values }: Driven, terms: (k: number) => AxisTerms): AxisCurves {
  return asCurves((k) => {
    const { tolerance, factor, offset, rest } = terms(k);
    const curve = curves[k];
    if (curve) return channelOf(curve, tolerance, factor, offset);
    const value = values[k] * factor + offset;
    return Math.abs(value - rest) <= 1e-9 * Math.max(1, Math.abs(rest)) ? undefined : constantChannel(value);
  });
}

/** One key. */
export function constantChannel(value: number): Channel {
  const list = new KeyList();
  list.add(0, value, 0, 0);
  return list.channel(1, 0, 'constant', 'constant');
}

function asCurves(of: (k: number) => Channel | undefined): AxisCurves {
  const curves: AxisCurves = [of(0), of(1), of(2)];
  return curves.every((curve) => curve === undefined) ? REST : curves;
}

/** Keys of repetitions that fitted keys follow, of one curve. */
const MAX_REPEATED = 20000;

/**
 * Where curves may bend: their keys; within the range also those repeated, and its ends, where something continues
 * beyond keys. At least one.
 * @param spare how many may be repeated ones
 */
export function stopsOf(
  curves: readonly FbxCurve[],
  [start, end]: readonly [number, number],
  spare = MAX_REPEATED,
): number[] {
  const mostRepeated = Math.max(0, Math.min(MAX_REPEATED, spare / Math.max(1, curves.length)));
  const stops: number[] = [];
  for (const { times, before, after } of curves) {
    for (const time of times) stops.push(time);
    const [first, last] = [times[0], times[times.length - 1]];
    const goesOn = (beyond: Beyond) => beyond.mode !== 'constant' && times.length > 1;
    if (start < first && goesOn(before)) {
      stops.push(start);
      addRepeated(stops, times, before, Math.ceil((first - start) / (last - first)), -1, mostRepeated);
    }
    if (end > last && goesOn(after)) {
      stops.push(end);
      addRepeated(stops, times, after, Math.ceil((end - last) / (last - first)), 1, mostRepeated);
    }
  }
  return stops.length > 0 ? ascending(stops) : [start];
}

function addRepeated(
  stops: number[],
  times: Float64Array,
  beyond: Beyond,
  turns: number,
  direction: 1 | -1,
  mostRepeated: number,
): void {
  const { mode, count } = beyond;
  if (mode === 'slope') return;
  const [first, last] = [times[0], times[times.length - 1]];
  const most = Math.min(turns, count, Math.floor(mostRepeated / times.length));
  for (let turn = 1; turn <= most; turn++) {
    const runsBack = mode === 'mirror' && turn % 2 === 1;
    for (const time of times) stops.push((runsBack ? first + last - time : time) + direction * turn * (last - first));
  }
}
