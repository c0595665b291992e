/**
 * Where the nodes of an FBX scene are at a time of a take: the reference for what takes become as curves of joints, and
 * what they are computed from where pivots or layers stand between the two.
 */

import { multiplyQuaternions, writeAnglesNear, writeQuaternion } from '../../evaluate/rotations/euler-orders.ts';
import { RADIANS_PER_DEGREE } from '../../math/degrees.ts';
import { writeRotation } from '../../math/quaternion.ts';
import { slerp } from '../../math/slerp.ts';
import { type Driven, type FbxLayer, type FbxTake, layerWeight } from './animation.ts';
import { evaluateCurve } from './curve.ts';
import { type FbxNode, writeNodeRotation, writeNodeTranslation } from './nodes.ts';

/** The properties of a node that takes move. */
export type MovedProperty = 'Lcl Translation' | 'Lcl Rotation' | 'Lcl Scaling';

const IDENTITY = Float64Array.of(0, 0, 0, 1);
/** Scratch: the values of a layer, and rotations. */
const layerValue = new Float64Array(3);
const a = new Float64Array(4);
const b = new Float64Array(4);

/** Curves of each layer of a take for one property of one object; the lowest layer first. */
export function driversOf(take: FbxTake | undefined, objectId: number, property: string): (Driven | undefined)[] {
  return take?.layers.map(({ driven }) => driven.get(objectId)?.get(property)) ?? [];
}

/** The own values of a node at a time, before pivots. Angles are in radians. */
export class NodeMotion {
  readonly translation = new Float64Array(3);
  readonly angles = new Float64Array(3);
  readonly scale = new Float64Array(3);
  private readonly layers: readonly FbxLayer[];
  private readonly translating: (Driven | undefined)[];
  private readonly rotating: (Driven | undefined)[];
  private readonly scaling: (Driven | undefined)[];
  private readonly isScaled: boolean;

  constructor(
    private readonly node: FbxNode,
    take: FbxTake | undefined,
  ) {
    this.layers = take?.layers ?? [];
    const { id } = node.object;
    this.translating = driversOf(take, id, 'Lcl Translation');
    this.rotating = driversOf(take, id, 'Lcl Rotation');
    this.scaling = driversOf(take, id, 'Lcl Scaling');
    this.isScaled = this.scaling.some((driver) => driver !== undefined);
    this.scale.set(node.scale);
  }

  /** Computes all three. */
  at(time: number): void {
    this.translationAt(time);
    this.anglesAt(time);
    this.scaleAt(time);
  }

  /** Computes the translation alone. */
  translationAt(time: number): void {
    copy(this.node.translation, this.translation);
    for (let l = 0; l < this.layers.length; l++) {
      const translating = this.translating[l];
      if (!translating) continue;
      this.read(translating, time, layerValue);
      this.blend(this.translation, layerValue, this.modeOf(l), this.weightOf(l, time));
    }
  }

  /** Computes the angles alone. */
  anglesAt(time: number): void {
    copy(this.node.angles, this.angles);
    for (let l = 0; l < this.layers.length; l++) {
      const rotating = this.rotating[l];
      if (!rotating) continue;
      const mode = this.modeOf(l);
      this.read(rotating, time, layerValue);
      for (let k = 0; k < 3; k++) layerValue[k] *= RADIANS_PER_DEGREE;
      if (mode !== 'override' && this.layers[l].composesRotation) this.turn(mode, this.weightOf(l, time));
      else this.blend(this.angles, layerValue, mode, this.weightOf(l, time));
    }
  }

  /** The lowest layer is what others add to. */
  private modeOf(l: number): FbxLayer['mode'] {
    return l === 0 ? 'override' : this.layers[l].mode;
  }

  private weightOf(l: number, time: number): number {
    return l === 0 ? 1 : layerWeight(this.layers[l], time);
  }

  /** Computes the scale alone. */
  scaleAt(time: number): void {
    if (!this.isScaled) return;
    copy(this.node.scale, this.scale);
    for (let l = 0; l < this.layers.length; l++) {
      const layer = this.layers[l];
      const scaling = this.scaling[l];
      if (!scaling) continue;
      if (l === 0 || layer.mode === 'override') {
        this.read(scaling, time, this.scale);
        continue;
      }
      const weight = layerWeight(layer, time);
      this.read(scaling, time, layerValue);
      if (layer.composesScale) this.stretch(layer.mode, weight);
      else this.blend(this.scale, layerValue, layer.mode, weight);
    }
  }

  private read({ curves, values }: Driven, time: number, out: Float64Array): void {
    for (let k = 0; k < 3; k++) {
      const curve = curves[k];
      out[k] = curve ? evaluateCurve(curve, time) : values[k];
    }
  }

  private blend(out: Float64Array, value: Float64Array, mode: string, weight: number): void {
    for (let k = 0; k < 3; k++) out[k] = blended(out[k], value[k], mode, weight);
  }

  private turn(mode: string, weight: number): void {
    const { order } = this.node;
    writeQuaternion(order, this.angles, a);
    writeQuaternion(order, layerValue, b);
    if (mode === 'add') {
      slerp(IDENTITY, b, weight, b);
      multiplyQuaternions(a, b, a);
    } else {
      slerp(a, b, weight, a);
    }
    writeAnglesNear(order, a, this.angles);
  }

  private stretch(mode: string, weight: number): void {
    for (let k = 0; k < 3; k++) {
      const own = mode === 'add' ? this.scale[k] : power(this.scale[k], 1 - weight);
      this.scale[k] = own * power(layerValue[k], weight);
    }
  }
}

function copy(from: readonly number[], to: Float64Array): void {
  for (let k = 0; k < 3; k++) to[k] = from[k];
}

/** Keeps the sign. */
function power(value: number, exponent: number): number {
  if (exponent <= 0) return 1;
  return exponent >= 1 ? value : Math.sign(value) * Math.abs(value) ** exponent;
}

/** A number of a layer combined with that of the layers below it. */
export function blended(below: number, value: number, mode: string, weight: number): number {
  if (mode === 'add') return below + value * weight;
  return mode === 'override' ? value : below * (1 - weight) + value * weight;
}

/** A single number, such as a blend shape's percentage, at a time. */
export function numberInTake(
  take: FbxTake | undefined,
  drivers: readonly (Driven | undefined)[],
  time: number,
  rest: number,
): number {
  let number = rest;
  for (const [l, driver] of drivers.entries()) {
    const layer = take?.layers[l];
    if (!driver || !layer) continue;
    const curve = driver.curves[0];
    const value = curve ? evaluateCurve(curve, time) : driver.values[0];
    number = l === 0 ? value : blended(number, value, layer.mode, layerWeight(layer, time));
  }
  return number;
}

/**
 * All nodes of a scene at a time.
 *
 *     world = frame · diag(stretch)        frame: what children that don't inherit scales are placed in
 */
export class SceneMotion {
  /** 16 numbers per node, in the file's own axes. */
  readonly worlds: Float64Array;
  /** Three numbers per node. */
  readonly stretches: Float64Array;
  private readonly motions: readonly NodeMotion[];
  private readonly frames: Float64Array;
  private readonly rotation = new Float64Array(4);
  private readonly place = new Float64Array(3);
  private readonly local = new Float64Array(16);

  constructor(
    private readonly nodes: readonly FbxNode[],
    take: FbxTake | undefined,
  ) {
    this.worlds = new Float64Array(16 * nodes.length);
    this.frames = new Float64Array(16 * nodes.length);
    this.stretches = new Float64Array(3 * nodes.length);
    this.motions = nodes.map((node) => new NodeMotion(node, take));
  }

  /** Evaluates all nodes at a time of the take, in seconds. */
  at(time: number): void {
    for (const [i, node] of this.nodes.entries()) {
      const motion = this.motions[i];
      motion.at(time);
      this.write(i, node, motion);
    }
  }

  private write(i: number, node: FbxNode, { translation, angles, scale }: NodeMotion): void {
    const { rotation, place, local, worlds, frames, stretches } = this;
    writeNodeRotation(node, angles, rotation);
    writeNodeTranslation(node, translation, rotation, scale, place);
    const p = node.parent;
    const inherited = inheritedStretch(this.nodes, stretches, i);
    local[15] = 1;
    writeRotation(rotation[0], rotation[1], rotation[2], rotation[3], local, 0, 4);
    const isNormal = node.inherits === 'normal' || p < 0;
    for (let k = 0; k < 3; k++) {
      local[12 + k] = isNormal ? place[k] : place[k] * stretches[3 * p + k];
      stretches[3 * i + k] = isNormal ? scale[k] : scale[k] * inherited[k];
    }
    if (p < 0) frames.set(local, 16 * i);
    else multiply(isNormal ? worlds : frames, 16 * p, local, frames, 16 * i);
    for (let c = 0; c < 4; c++) {
      const by = c < 3 ? stretches[3 * i + c] : 1;
      for (let r = 0; r < 4; r++) worlds[16 * i + 4 * c + r] = frames[16 * i + 4 * c + r] * by;
    }
  }
}

const ONE: readonly number[] = [1, 1, 1];
const inheritedScratch = new Float64Array(3);

/** The stretch that a node's own scale is multiplied by, axis by axis; 1 for those placed like everything else. */
function inheritedStretch(nodes: readonly FbxNode[], stretches: Float64Array, i: number): ArrayLike<number> {
  const from = stretchSource(nodes, i);
  if (from < 0) return ONE;
  inheritedScratch.set(stretches.subarray(3 * from, 3 * from + 3));
  return inheritedScratch;
}

/** The node whose stretch another one inherits axis by axis; -1 for none. */
export function stretchSource(nodes: readonly FbxNode[], i: number): number {
  const { parent, inherits } = nodes[i];
  if (parent < 0 || inherits === 'normal') return -1;
  return inherits === 'by axis' ? parent : stretchSource(nodes, parent);
}

function multiply(a: Float64Array, ao: number, b: Float64Array, out: Float64Array, o: number): void {
  for (let c = 0; c < 4; c++) {
    const [x, y, z] = [b[4 * c], b[4 * c + 1], b[4 * c + 2]];
    for (let r = 0; r < 3; r++) {
      out[o + 4 * c + r] = a[ao + r] * x + a[ao + 4 + r] * y + a[ao + 8 + r] * z + (c === 3 ? a[ao + 12 + r] : 0);
    }
    out[o + 4 * c + 3] = c === 3 ? 1 : 0;
  }
}
