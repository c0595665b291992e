/** Characters written as FBX: what is in the file, and where our own reader and three.js see it. */
import { AnimationMixer, type Bone, LoadingManager, type Object3D } from 'three';
import { FBXLoader } from 'three/examples/jsm/loaders/FBXLoader.js';
import { compileSkeleton, worldMatrices } from '../../src/evaluate/kinematics.ts';
import { dofCountOf, poseAt } from '../../src/evaluate/pose.ts';
import { blendMorphs, compileSkin, deform } from '../../src/evaluate/skin/deform.ts';
import { writeFbx } from '../../src/export/fbx/write.ts';
import type { ExchangeOptions } from '../../src/export/shared/options.ts';
import type { ExchangeReport } from '../../src/export/shared/report.ts';
import { TICKS_PER_SECOND } from '../../src/formats/fbx/constants.ts';
import { bytesReader, readWhole } from '../../src/formats/reader.ts';
import { documentOf, type FbxDocument, type FbxObject } from '../../src/import/fbx/document.ts';
import { readFbxFile } from '../../src/import/fbx/records/read-file.ts';
import { childOf, numberAt, numbersOf } from '../../src/import/fbx/records/record.ts';
import { type Character, shownSkin } from '../../src/model/document.ts';
import type { WholeCharacter } from '../../src/model/files.ts';
import { characterOf } from '../import/fbx/read-character.ts';
import { posed } from './posed.ts';

export interface Fbx {
  readonly bytes: Uint8Array<ArrayBuffer>;
  readonly report: ExchangeReport;
}

export function fbxOf(character: Character, options: Partial<ExchangeOptions> = {}): Fbx {
  const { pieces, report } = writeFbx(character, { body: true, ...options });
  const bytes = new Uint8Array(report.bytes);
  let at = 0;
  for (const piece of pieces) {
    bytes.set(piece, at);
    at += piece.length;
  }
  return { bytes, report };
}

/** The objects of a file. */
export function documentIn({ bytes }: Pick<Fbx, 'bytes'>): FbxDocument {
  const reader = bytesReader('x.fbx', (all, report) => documentOf(readFbxFile(all, report).file));
  const { value } = readWhole(reader, bytes);
  if (!value) throw new Error('An FBX file was expected.');
  return value;
}

/** Joints, 3 numbers each, and vertices. */
export interface Places {
  readonly joints: Float64Array;
  readonly vertices: Float64Array;
}

/** Where a character of ours is at a time of one of its takes, by our own doubles; weights that sum to 1. */
export function placesOf(character: Character, take: number, seconds: number): Places {
  const { skeleton, morphs } = character;
  if (!skeleton) throw new Error('A skeleton was expected.');
  const dofs = new Float64Array(dofCountOf(character));
  poseAt({ ...character, shownTake: take, timeOffsetSeconds: 0 }, seconds, dofs);
  const worlds = new Float64Array(16 * skeleton.joints.length);
  worldMatrices(compileSkeleton(skeleton), dofs, worlds);
  const skin = shownSkin(character);
  const vertices = new Float64Array(skin?.positions.length ?? 0);
  if (skin) {
    const compiled = compileSkin(skin);
    const normals = new Float64Array(vertices.length);
    blendMorphs(compiled, morphs, dofs, dofs.length - morphs.length, vertices, normals);
    deform(compiled, worlds, vertices, normals, vertices, normals);
  }
  return { joints: originsOf(worlds), vertices };
}

function originsOf(worlds: Float64Array): Float64Array {
  return Float64Array.from(
    { length: (3 * worlds.length) / 16 },
    (_, i) => worlds[16 * Math.floor(i / 3) + 12 + (i % 3)],
  );
}

/** The joints of a character among those of other names: the first of a name is the first there. */
function namesakes(names: readonly string[], theirs: readonly string[]): readonly number[] {
  const next = new Map<string, number>();
  return names.map((name) => {
    const found = theirs.indexOf(name, next.get(name) ?? 0);
    next.set(name, found + 1);
    return found;
  });
}

export function nameOf(name: string, j: number): string {
  return name || `joint${j}`;
}

/** How another program sees a file: where joints are at a time, by the names that ours have. */
export type Seen = (take: number, seconds: number) => Places;

/** Our own reader. */
export function seenByUs(
  character: Character,
  { bytes }: Fbx,
): { readonly whole: WholeCharacter; readonly seen: Seen } {
  const whole = characterOf(bytes);
  const own = (character.skeleton?.joints ?? []).map(({ name }, j) => nameOf(name, j).replaceAll(/[\s{}]/g, '_'));
  const at = namesakes(
    own,
    whole.skeleton.joints.map(({ name }) => name),
  );
  return {
    whole,
    seen(take, seconds) {
      const { worlds, positions } = posed(whole, take, seconds);
      const joints = at.flatMap((j) => (j < 0 ? [NaN, NaN, NaN] : [...worlds.subarray(16 * j + 12, 16 * j + 15)]));
      return { joints: Float64Array.from(joints), vertices: positions };
    },
  };
}

/** The same places with y up, as readers turn those of a file with z up. */
export function upright({ joints, vertices }: Places): Places {
  const turned = (points: Float64Array) =>
    points.map((value, i) => (i % 3 === 0 ? value : i % 3 === 1 ? points[i + 1] : 0 - points[i - 1]));
  return { joints: turned(joints), vertices: turned(vertices) };
}

/** three.js, whose curves are straight between keys. */
export function seenByThree(character: Character, { bytes }: Fbx): Seen {
  const group = new FBXLoader(new LoadingManager()).parse(bytes.buffer, '');
  const mixer = new AnimationMixer(group);
  const bones: Object3D[] = [];
  group.traverse((each) => {
    if ((each as Bone).isBone) bones.push(each);
  });
  const own = (character.skeleton?.joints ?? []).map(({ name }, j) =>
    nameOf(name, j).replaceAll(/[\s[\]./:]/g, (c) => (/\s/.test(c) ? '_' : '')),
  );
  const at = namesakes(
    own,
    bones.map(({ name }) => name),
  );
  return (take, seconds) => {
    mixer.stopAllAction();
    mixer.clipAction(group.animations[take]).play();
    mixer.setTime(seconds);
    group.updateMatrixWorld(true);
    const joints = at.flatMap((b) => (b < 0 ? [NaN, NaN, NaN] : bones[b].matrixWorld.elements.slice(12, 15)));
    return { joints: Float64Array.from(joints), vertices: new Float64Array(0) };
  };
}

/**
 * The largest distance of vertices, whatever their order: a reader lists them as triangles name them. Each of theirs is
 * one of ours, the same at all times.
 */
export function farthestVertex(ours: readonly Float64Array[], theirs: readonly Float64Array[]): number {
  let most = 0;
  for (let b = 0; b < theirs[0].length; b += 3) {
    let nearest = Number.POSITIVE_INFINITY;
    for (let a = 0; a < ours[0].length && nearest > 0; a += 3) {
      let off = 0;
      for (let f = 0; f < ours.length && off < nearest; f++) {
        off = Math.max(off, Math.hypot(...[0, 1, 2].map((k) => ours[f][a + k] - theirs[f][b + k])));
      }
      nearest = Math.min(nearest, off);
    }
    most = Math.max(most, nearest);
  }
  return most;
}

/** The largest distance of points that are there in both; infinite if one is missing. */
export function farthestOf(a: Float64Array, b: Float64Array): number {
  if (a.length !== b.length) return Number.POSITIVE_INFINITY;
  let most = 0;
  for (let o = 0; o < a.length; o += 3) {
    const d = Math.hypot(a[o] - b[o], a[o + 1] - b[o + 1], a[o + 2] - b[o + 2]);
    if (!(d <= most)) most = Number.isNaN(d) ? Number.POSITIVE_INFINITY : d;
  }
  return most;
}

/** A curve as the file has it. */
export interface CurveIn {
  readonly seconds: readonly number[];
  readonly values: readonly number[];
  readonly flags: readonly number[];
  /** Slopes on the right of each key, and on the left of the next one, as far as the keys are not alike. */
  readonly data: readonly number[];
  readonly before: number | undefined;
  readonly after: number | undefined;
}

/** The curves of a property of an object, by axis: `d|X`. */
export function curvesIn(
  document: FbxDocument,
  name: string,
  property: string,
  take = 0,
): ReadonlyMap<string, CurveIn> {
  const layers = document.objects.filter(({ kind }) => kind === 'AnimationLayer');
  const nodes = document.partsOf(layers[take].id).map(({ object }) => object);
  const node = nodes.find(({ id }) =>
    document.ownersOf(id).some((owner) => owner.property === property && owner.object.name === name),
  );
  const parts = node ? document.partsOf(node.id) : [];
  return new Map(
    parts.map(({ object: { record }, property: axis }) => {
      const numbers = (child: string) => [...numbersOf(childOf(record, child))];
      const letter = (end: string) => numberAt(childOf(childOf(record, end), 'Type'));
      return [
        axis ?? '',
        {
          seconds: numbers('KeyTime').map((ticks) => ticks / TICKS_PER_SECOND),
          values: numbers('KeyValueFloat'),
          flags: numbers('KeyAttrFlags'),
          data: numbers('KeyAttrDataFloat'),
          before: letter('Pre-Extrapolation'),
          after: letter('Post-Extrapolation'),
        },
      ];
    }),
  );
}

/** The only object of a kind and type, and of a name if several have that. */
export function objectIn(document: FbxDocument, kind: string, type: string, name?: string): FbxObject {
  const found = document.objects.find(
    (object) => object.kind === kind && object.type === type && (name === undefined || object.name === name),
  );
  if (!found) throw new Error(`${kind} ${type} ${name ?? ''} was expected.`);
  return found;
}
