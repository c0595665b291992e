/**
 * The takes of an FBX file: a stack of layers each. A layer drives properties of objects by curve nodes, which have a
 * curve for each axis that moves.
 */

import { rateOfTimes } from '../../evaluate/samples/frame-rate.ts';
import { NOISE } from '../noise.ts';
import { curveOf, evaluateCurve, type FbxCurve, staysAt } from './curve.ts';
import { type FbxDocument, type FbxObject, partsOfKind } from './document.ts';
import type { FbxReport } from './failure.ts';
import { timeModeRate } from './time-mode.ts';

/** An animation stack: a take in seconds. */
export interface FbxTake {
  readonly name: string;
  /** First and last second. */
  readonly range: readonly [number, number];
  /** As the file states, else of its keys; absent if these are uneven. */
  readonly framesPerSecond?: number;
  readonly layers: readonly FbxLayer[];
}

/** A layer of a take, and what it drives. */
export interface FbxLayer {
  readonly object: FbxObject;
  readonly mode: 'add' | 'override' | 'pass through';
  /** 0 to 1, unless it is animated: then percent, by the layer's own values. */
  readonly weight: number;
  readonly weightCurve: FbxCurve | undefined;
  /** How rotations and scales of this layer are combined with those below: as such, or angle by angle. */
  readonly composesRotation: boolean;
  readonly composesScale: boolean;
  /** By object, then by property. */
  readonly driven: ReadonlyMap<number, ReadonlyMap<string, Driven>>;
}

/** A property's value in a layer: its curves, and the values of axes without one. */
export interface Driven {
  readonly curves: readonly (FbxCurve | undefined)[];
  readonly values: readonly number[];
}

const AXES: Readonly<Record<string, number>> = { 'd|X': 0, 'd|Y': 1, 'd|Z': 2 };

/** All takes of a file, in its order. */
export function takesOf(document: FbxDocument, report: FbxReport): FbxTake[] {
  const stacks = document.objects.filter(({ kind }) => kind === 'AnimationStack');
  return stacks.map((stack) => {
    const layers = partsOfKind(document, stack, 'AnimationLayer').map((layer) => layerOf(document, layer, report));
    const framesPerSecond = timeModeRate(document.settings) ?? rateOfTimes(timesOf(layers), false);
    return {
      name: stack.name,
      range: rangeOf(stack, layers, document.ticks),
      ...(framesPerSecond !== undefined && { framesPerSecond }),
      layers,
    };
  });
}

function layerOf(document: FbxDocument, object: FbxObject, report: FbxReport): FbxLayer {
  const driven = new Map<number, Map<string, Driven>>();
  for (const node of partsOfKind(document, object, 'AnimationCurveNode')) {
    const value = drivenBy(document, node, report);
    for (const { object: owner, property } of document.ownersOf(node.id)) {
      if (property === undefined) continue;
      const own = driven.get(owner.id) ?? new Map<string, Driven>();
      driven.set(owner.id, own);
      own.set(property, property === 'Lcl Scaling' ? withoutNoise(value) : value);
    }
  }
  const { properties } = object;
  const mode = properties.number('BlendMode') ?? 0;
  return {
    object,
    mode: mode === 0 ? 'add' : mode === 2 ? 'pass through' : 'override',
    weight: asWeight(properties.number('Weight') ?? 100),
    weightCurve: driven.get(object.id)?.get('Weight')?.curves[0],
    composesRotation: (properties.number('RotationAccumulationMode') ?? 0) === 0,
    composesScale: (properties.number('ScaleAccumulationMode') ?? 0) === 0,
    driven,
  };
}

/**
 * The curves of a scale without noise: those that only tremble by noise are constant. What inherits that scale then
 * keeps its own curves.
 */
function withoutNoise({ curves, values }: Driven): Driven {
  const isSteady = (curve: FbxCurve) => staysAt(curve, curve.values[0], NOISE * Math.abs(curve.values[0]));
  const steady = curves.map((curve) => curve !== undefined && isSteady(curve));
  return {
    curves: curves.map((curve, k) => (steady[k] ? undefined : curve)),
    values: values.map((value, k) => (steady[k] ? (curves[k]?.values[0] ?? value) : value)),
  };
}

function asWeight(percent: number): number {
  return Math.min(1, Math.max(0, percent / 100));
}

/** A layer's weight at a time, 0 to 1. */
export function layerWeight({ mode, weight, weightCurve }: FbxLayer, time: number): number {
  return weightCurve && mode !== 'override' ? asWeight(evaluateCurve(weightCurve, time)) : weight;
}

function drivenBy(document: FbxDocument, node: FbxObject, report: FbxReport): Driven {
  const curves: (FbxCurve | undefined)[] = [undefined, undefined, undefined];
  const { properties } = node;
  const first = properties.number('d|X') ?? firstNumber(node);
  const values = [first, properties.number('d|Y') ?? 0, properties.number('d|Z') ?? 0];
  for (const { object, property } of document.partsOf(node.id)) {
    if (object.kind !== 'AnimationCurve' || property === undefined) continue;
    // Of a property with a single value, it is called after the property.
    const axis = AXES[property] ?? 0;
    curves[axis] ??= curveOf(object.record, document.ticks, document.file, report);
  }
  return { curves, values };
}

/** The value of a curve node for a property with one value, such as `d|DeformPercent`. */
function firstNumber({ record, properties }: FbxObject): number {
  for (const child of record.children) {
    for (const { values } of child.children) {
      const name = values[0];
      if (typeof name === 'string' && name.startsWith('d|')) return properties.number(name) ?? 0;
    }
  }
  return 0;
}

function timesOf(layers: readonly FbxLayer[]): readonly Float64Array[] {
  const all: Float64Array[] = [];
  for (const { driven } of layers) {
    for (const own of driven.values()) {
      for (const { curves } of own.values()) for (const curve of curves) if (curve) all.push(curve.times);
    }
  }
  return all;
}

/** As the stack says; without that, from the first to the last key. */
function rangeOf(stack: FbxObject, layers: readonly FbxLayer[], ticks: number): readonly [number, number] {
  const start = stack.properties.number('LocalStart') ?? 0;
  const stop = stack.properties.number('LocalStop') ?? 0;
  if (stop > start) return [start / ticks, stop / ticks];
  let first = Number.POSITIVE_INFINITY;
  let last = Number.NEGATIVE_INFINITY;
  for (const times of timesOf(layers)) {
    first = Math.min(first, times[0]);
    last = Math.max(last, times[times.length - 1]);
  }
  return first <= last ? [first, last] : [0, 0];
}
