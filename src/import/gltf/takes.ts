/**
 * Animations. Their samplers become channels with the same keys; glTF's interpolations are these tangents:
 *
 *     STEP          two keys at one time: the value before, and the one from then on
 *     LINEAR        linear; quaternions by slerp
 *     CUBICSPLINE   the slopes of the file, per second
 */
import { rateOfTimes } from '../../evaluate/samples/frame-rate.ts';
import { perObject } from '../../model/per-object.ts';
import { type Channel, type KeyedChannel, NO_EXTRAPOLATION } from '../../model/takes/take.ts';
import { FIXED_TANGENT, FLAT, LINEAR } from '../../model/takes/tangent-kinds.ts';
import type { QuaternionTrack } from '../../model/takes/tracked-take.ts';
import type { Budget } from '../budget.ts';
import { firstNotFinite } from '../finite.ts';
import { ImportError, type Remarks } from '../imported.ts';
import type { SceneMesh, SceneMove, SceneTake, SceneWeight } from '../scene.ts';
import type { Accessors, NumberList, Numbers } from './accessors.ts';
import { countOf, type Document, extensionOf, type Json, listOf, objectOf, shown, textOf } from './json.ts';

/** A sampler: `width` values per key, three times as many of a cubic. */
interface Sampler {
  readonly interpolation: 'step' | 'linear' | 'cubic';
  /** The same list for all samplers of one accessor. */
  readonly times: Float64Array<ArrayBuffer>;
  readonly width: number;
  readonly values: NumberList;
}

type Path = 'translation' | 'rotation' | 'scale' | 'weights';
const WIDTHS = { translation: 3, rotation: 4, scale: 3 } as const;

/** Numbers that a key becomes: for each value a time and tangents, twice those of steps; rotations are fitted by several. */
const PER_VALUE = 8;
const PER_ROTATION = 32;

/**
 * Reads all animations as takes. What can't be held is left out with a remark.
 * @param indexOf index of each node of the file among the scene's
 * @throws ImportError for an index that the file lacks, or if takes exceed the budget
 */
export function readTakes(
  document: Document,
  accessors: Accessors,
  budget: Budget,
  indexOf: ReadonlyMap<number, number>,
  meshes: readonly SceneMesh[],
  remarks: Remarks,
): readonly SceneTake[] {
  const meshesOf = new Map<number, number[]>();
  for (const [m, { node }] of meshes.entries()) meshesOf.set(node, [...(meshesOf.get(node) ?? []), m]);
  const targetCount = meshes.reduce((sum, { targets }) => sum + targets.length, 0);
  return document.all('animations').flatMap((json, a) => {
    const called = `Animation ${a}`;
    budget.spendTake(indexOf.size, targetCount, called);
    const samplers = listOf(json.samplers).map((item) => objectOf(item) ?? {});
    const moves = new Map<number, { -readonly [K in keyof SceneMove]: SceneMove[K] }>();
    const weights: SceneWeight[] = [];
    const weighted = new Set<number>();
    const times: Float64Array[] = [];
    let isStraight = true;
    let range: readonly [number, number] | undefined;
    for (const item of listOf(json.channels)) {
      const channel = objectOf(item) ?? {};
      const target = targetOf(objectOf(channel.target), remarks);
      if (!target) continue;
      const { path } = target;
      document.at('nodes', target.node, called);
      const node = indexOf.get(Number(target.node));
      const own = node === undefined ? [] : (meshesOf.get(node) ?? []);
      const targets = own.reduce((most, m) => Math.max(most, meshes[m].targets.length), 0);
      const width = path === 'weights' ? targets : WIDTHS[path];
      const sampler = samplers[countOf(channel.sampler) ?? -1];
      if (!sampler) throw new ImportError('index-out-of-range', `${called} has no sampler ${shown(channel.sampler)}.`);
      const read = width > 0 ? readSampler(accessors, sampler, width, called, remarks) : undefined;
      if (!read) continue;
      budget.spend((path === 'rotation' ? PER_ROTATION : PER_VALUE * width) * read.times.length, called);
      times.push(read.times);
      isStraight &&= read.interpolation !== 'cubic';
      const [first, last] = [read.times[0], read.times[read.times.length - 1]];
      range = range ? [Math.min(range[0], first), Math.max(range[1], last)] : [first, last];
      if (node === undefined) continue;
      if (path === 'weights') {
        for (const mesh of own) {
          if (weighted.has(mesh)) continue;
          weighted.add(mesh);
          meshes[mesh].targets.forEach((_, t) => {
            weights.push({ mesh, target: t, curve: channelOf(read, t) });
          });
        }
        continue;
      }
      const move = moves.get(node) ?? { node };
      moves.set(node, move);
      if (move[path]) {
        remarks.warn('channel-twice', `${called} moves the ${path} of node ${target.node} twice.`, 'the first is used');
      } else if (path === 'rotation') move.rotation = { kind: 'turns', track: trackOf(read) };
      else move[path] = [channelOf(read, 0), channelOf(read, 1), channelOf(read, 2)];
    }
    if (!range) {
      remarks.leaveOut(`animation ${a}, which moves nothing here`);
      return [];
    }
    const framesPerSecond = rateOfTimes(times, isStraight);
    return [
      {
        name: textOf(json.name) ?? '',
        range,
        ...(framesPerSecond !== undefined && { framesPerSecond }),
        moves: [...moves.values()],
        weights,
      },
    ];
  });
}

/**
 * The property that a channel moves, named as such or by a pointer: `/nodes/2/rotation`. Undefined if it is nothing of
 * a node.
 */
function targetOf(
  target: Json | undefined,
  remarks: Remarks,
): { readonly node: unknown; readonly path: Path } | undefined {
  const pointer = textOf(extensionOf(target, 'KHR_animation_pointer')?.pointer);
  const [, pointed, property] = /^\/nodes\/(\d+)\/(\w+)$/.exec(pointer ?? '') ?? [];
  const node = pointed === undefined ? target?.node : Number(pointed);
  const path = property ?? textOf(target?.path);
  if (path === 'translation' || path === 'rotation' || path === 'scale' || path === 'weights') {
    return node === undefined ? undefined : { node, path };
  }
  if (pointer !== undefined) {
    remarks.leaveOut(`the animation of ${pointer.split('/')[1] || 'nothing'} (KHR_animation_pointer)`);
  } else remarks.leaveOut(`the animation of ${path === undefined ? 'nothing' : `"${path}"`}`);
  return undefined;
}

/** Undefined if it has no keys. */
function readSampler(
  accessors: Accessors,
  json: Json,
  width: number,
  called: string,
  remarks: Remarks,
): Sampler | undefined {
  const stated = textOf(json.interpolation) ?? 'LINEAR';
  const interpolation = stated === 'STEP' ? 'step' : stated === 'CUBICSPLINE' ? 'cubic' : 'linear';
  if (interpolation === 'linear' && stated !== 'LINEAR') {
    remarks.warn('interpolation-unknown', `${called} has the interpolation "${stated}".`, 'LINEAR');
  }
  const input = accessors.numbers(json.input, 1, called);
  // Weights are listed one number an element, whatever their count.
  const output = accessors.numbers(
    json.output,
    width === 3 || width === 4 ? widthOf(accessors, json, width, called) : 1,
    called,
  );
  const perKey = interpolation === 'cubic' ? 3 * width : width;
  const keys = Math.min(input.count, Math.floor(output.values.length / perKey));
  if (keys < input.count || output.values.length > keys * perKey) {
    const found = `${called} has ${input.count} times and ${output.values.length} values, where ${perKey} belong to each time.`;
    remarks.warn('count-mismatch', found, `${keys} keys`);
  }
  if (keys === 0) return undefined;
  const { times: all, areFinite, isSorted } = timesOf(input);
  const values = output.values.subarray(0, keys * perKey);
  const times = keys === all.length ? all : all.subarray(0, keys);
  if (!areFinite || firstNotFinite(values) >= 0) {
    throw new ImportError('number-not-finite', `${called} has a key that is not a finite number.`);
  }
  const sampler = { interpolation, times, width, values } as const;
  return isSorted ? sampler : sorted(sampler, called, remarks);
}

/** The times of an accessor, in doubles; most samplers of an animation have the same. */
const timesOf = perObject(({ values }: Numbers) => {
  const times = new Float64Array(values);
  const isSorted = times.every((t, i) => i === 0 || t >= times[i - 1]);
  return { times, areFinite: firstNotFinite(times) < 0, isSorted };
});

/** Three or four targets have weights that are single numbers all the same. */
function widthOf(accessors: Accessors, json: Json, width: number, called: string): number {
  return accessors.width(json.output, called) === 1 ? 1 : width;
}

function sorted(sampler: Sampler, called: string, remarks: Remarks): Sampler {
  const { times, values } = sampler;
  remarks.warn('keys-unsorted', `${called} has keys out of order.`, 'sorted by time');
  const order = [...times.keys()].sort((a, b) => times[a] - times[b] || a - b);
  const perKey = values.length / times.length;
  const moved = new Float64Array(values.length);
  order.forEach((from, to) => {
    moved.set(values.subarray(from * perKey, (from + 1) * perKey), to * perKey);
  });
  return { ...sampler, times: Float64Array.from(order, (i) => times[i]), values: moved };
}

/** One of a sampler's values as a channel. */
function channelOf(sampler: Sampler, at: number): Channel {
  const { interpolation, times, width, values } = sampler;
  const n = times.length;
  const constant = { kind: 'keys', ...NO_EXTRAPOLATION } as const;
  if (interpolation === 'step') {
    const stepTimes = new Float64Array(2 * n - 1);
    const stepValues = new Float64Array(2 * n - 1);
    for (let k = 0; k < n; k++) {
      stepTimes[2 * k] = times[k];
      stepValues[2 * k] = values[k * width + at];
      if (k === 0) continue;
      stepTimes[2 * k - 1] = times[k];
      stepValues[2 * k - 1] = values[(k - 1) * width + at];
    }
    return { ...constant, times: stepTimes, values: stepValues, ...tangents(sampler) };
  }
  if (interpolation === 'linear') {
    return { ...constant, times, values: column(values, n, width, at), ...tangents(sampler) };
  }
  const part = (p: number) => column(values, n, 3 * width, p * width + at);
  const fixed = new Uint8Array(n).fill(FIXED_TANGENT);
  const keyed: KeyedChannel = {
    ...constant,
    times,
    values: part(1),
    tangentsIn: { kinds: fixed, slopes: part(0) },
    tangentsOut: { kinds: fixed, slopes: part(2) },
  };
  return keyed;
}

/** The number at an index of each of `count` rows. */
function column(values: NumberList, count: number, width: number, at: number): Float64Array {
  const out = new Float64Array(count);
  for (let k = 0, o = at; k < count; k++, o += width) out[k] = values[o];
  return out;
}

/** Of all values of a sampler that has no slopes of its own. */
const slopeless = perObject(({ interpolation, times }: Sampler) => {
  const count = interpolation === 'step' ? 2 * times.length - 1 : times.length;
  return {
    kinds: new Uint8Array(count).fill(interpolation === 'step' ? FLAT : LINEAR),
    slopes: new Float64Array(count),
  };
});

/** An object for each side: which of a key's tangents one is, is told by its identity. */
function tangents(sampler: Sampler): Pick<KeyedChannel, 'tangentsIn' | 'tangentsOut'> {
  return { tangentsIn: { ...slopeless(sampler) }, tangentsOut: { ...slopeless(sampler) } };
}

function trackOf({ interpolation, times, values }: Sampler): QuaternionTrack {
  const isFloat = values instanceof Float32Array || values instanceof Float64Array;
  return { times, values: isFloat ? values : new Float64Array(values), interpolation };
}
