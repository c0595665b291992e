/** Tiny models for tests, with plain defaults. */

import { type Character, DEFAULT_PLACEMENT, type Document, EMPTY_DOCUMENT } from '../../src/model/document.ts';
import type { FileContent, ParsedFile } from '../../src/model/files.ts';
import type { Morph } from '../../src/model/morph.ts';
import { NO_MARKS, type PartMark, type PartMarks, UNMARKED } from '../../src/model/part.ts';
import { filePose } from '../../src/model/skeleton/dofs.ts';
import {
  DEFAULT_BOX,
  DEFAULT_MOTION,
  type Joint,
  type Skeleton,
  UNLIMITED,
} from '../../src/model/skeleton/skeleton.ts';
import { type Material, oneSurface, type Skin } from '../../src/model/skin.ts';
import { type Channel, NO_EXTRAPOLATION, type Take } from '../../src/model/takes/take.ts';
import { withTracks } from '../../src/model/takes/tracked-take.ts';

export function joint(parent: number, more: Partial<Joint> = {}): Joint {
  return {
    name: `joint${parent + 1}`,
    parent,
    offset: [0, 1, 0],
    box: DEFAULT_BOX,
    motion: DEFAULT_MOTION,
    limits: [UNLIMITED, UNLIMITED, UNLIMITED],
    pose: [0, 0, 0],
    ...more,
  };
}

/** A chain of that many joints. */
export function skeleton(joints = 2, name = 'hero'): Skeleton {
  return { name, joints: Array.from({ length: joints }, (_, i) => joint(i - 1)) };
}

const ONE_TRIANGLE = Uint32Array.of(0, 1, 2);

/** One triangle bound to the given joint; bindings for joints 0 up to it, and for those of `skeleton()`. */
export function skin(name = 'hero', onJoint = 0, more: Partial<Skin> = {}): Skin {
  const bindings = new Float64Array(16 * Math.max(2, onJoint + 1));
  for (let b = 0; b < bindings.length; b += 16) bindings[b] = bindings[b + 5] = bindings[b + 10] = bindings[b + 15] = 1;
  return {
    name,
    positions: Float64Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0),
    normals: Float64Array.of(0, 0, 1, 0, 0, 1, 0, 0, 1),
    attachments: {
      start: Uint32Array.of(0, 1, 2, 3),
      joints: Uint32Array.of(onJoint, onJoint, onJoint),
      weights: Float64Array.of(1, 1, 1),
    },
    triangles: ONE_TRIANGLE,
    surfaces: oneSurface(ONE_TRIANGLE),
    bindings,
    ...more,
  };
}

/** A skin as `skin` makes it, with materials: its one triangle is repeated, once for each. */
export function paintedSkin(name: string, ...materials: readonly Material[]): Skin {
  return skin(name, 0, {
    triangles: Uint32Array.from(materials.flatMap(() => [...ONE_TRIANGLE])),
    surfaces: materials.map((material, i) => ({ material, triangleStart: i, triangleCount: 1 })),
  });
}

export function morph(name: string, vertex = 0): Morph {
  const rows = { indices: Uint32Array.of(vertex), values: Float64Array.of(0, 0, 5) };
  return { name, positions: rows, normals: { indices: new Uint32Array(0), values: new Float64Array(0) } };
}

/** A take whose channels are constant. */
export function takeOfValues(name: string, values: readonly number[], range: readonly [number, number] = [0, 1]): Take {
  return {
    name,
    range,
    channels: values.map((value) => ({
      kind: 'keys',
      extrapolateIn: 'constant',
      extrapolateOut: 'constant',
      times: Float64Array.of(0),
      values: Float64Array.of(value),
      tangentsIn: { kinds: Uint8Array.of(0), slopes: Float64Array.of(0) },
      tangentsOut: { kinds: Uint8Array.of(0), slopes: Float64Array.of(0) },
    })),
  };
}

/** A take that moves, whose channels are yet to be made; tells when they are. */
export function trackedTake(name: string, onMade: () => void = () => undefined): Take {
  const still = { kinds: Uint8Array.of(0, 0), slopes: Float64Array.of(0, 0) };
  const moving: Channel = {
    kind: 'keys',
    ...NO_EXTRAPOLATION,
    times: Float64Array.of(0, 1),
    values: Float64Array.of(0, 2),
    tangentsIn: still,
    tangentsOut: still,
  };
  const channels = takeOfValues(name, [0, 0, 0, 0, 0, 0, 0, 0, 0]).channels.map((channel, i) =>
    i === 3 ? moving : channel,
  );
  const track = { times: Float64Array.of(0), values: Float64Array.of(0, 0, 0, 1), interpolation: 'linear' } as const;
  const rotation = { track, form: 'xyz', rest: [0, 0, 0] } as const;
  const tracked = channels.map((_, index) => ({ kind: 'tracked', rotation, index }) as const);
  return withTracks({ name, range: [0, 1], framesPerSecond: 30, tracked, spareKeys: 0 }, () => {
    onMade();
    return channels;
  });
}

export function character(more: Partial<Character> = {}): Character {
  const own = more.skeleton ?? skeleton();
  return {
    id: 'c1',
    name: 'hero',
    skeleton: own,
    skins: [],
    shownSkin: 0,
    morphs: [],
    textures: [],
    takes: [],
    shownTake: -1,
    pose: filePose(own, more.morphs?.length ?? 0),
    clampsToLimits: true,
    placements: [DEFAULT_PLACEMENT],
    timeOffsetSeconds: 0,
    sources: [],
    ...more,
  };
}

export function documentOf(...characters: Character[]): Document {
  return { ...EMPTY_DOCUMENT, characters };
}

export function file(path: string, content: FileContent): ParsedFile {
  return { ...content, source: { path, name: path.slice(path.lastIndexOf('/') + 1), bytes: 1 } };
}

/** Marks of takes read from these files; undefined for one created in the page. */
export function takesFrom(...paths: (string | undefined)[]): PartMarks {
  const markOf = (path: string | undefined): PartMark => {
    if (path === undefined) return UNMARKED;
    const name = path.slice(path.lastIndexOf('/') + 1);
    const kind = name.endsWith('.bvh') ? 'bvh' : 'anim';
    return {
      ...UNMARKED,
      file: { kind, source: { name, path, bytes: 1 }, holds: name.slice(0, name.lastIndexOf('.')) },
    };
  };
  return { ...NO_MARKS, takes: paths.map(markOf) };
}

export const skelFile = (path: string, ...skeletons: Skeleton[]) => file(path, { kind: 'skel', skeletons });
export const skinFile = (path: string, content: Skin) => file(path, { kind: 'skin', skin: content });
export const morphFile = (path: string, content: Morph) => file(path, { kind: 'morph', morph: content });
export const animFile = (path: string, content: Take) => file(path, { kind: 'anim', take: content });
