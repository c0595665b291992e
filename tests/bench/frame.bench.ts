/**
 * A frame of 100 characters of 25 joints as the page plays them: channels through the mixer, limits, matrices of bones
 * and skin, bounds, bone textures ready for upload. Goals: at most half the time of plain three.js with a Bezier
 * `KeyframeTrack` per DOF (without limits, extrapolation and bounds), and at most 3 times that of a bare loop with the
 * same arithmetic over typed arrays.
 */
import {
  AnimationClip,
  AnimationMixer,
  Bone,
  BufferGeometry,
  InterpolateBezier,
  Matrix4,
  NumberKeyframeTrack,
  Scene,
  Skeleton,
  SkinnedMesh,
} from 'three';
import { bench, describe } from 'vitest';
import { compileTake } from '../../src/evaluate/compiled-take.ts';
import { compileSkeleton } from '../../src/evaluate/kinematics.ts';
import { compileSkin } from '../../src/evaluate/skin/deform.ts';
import { resolvedSlopes } from '../../src/evaluate/slopes.ts';
import { DEFAULT_DISPLAY } from '../../src/model/session.ts';
import { keysOf, type Take } from '../../src/model/takes/take.ts';
import { SMOOTH } from '../../src/model/takes/tangent-kinds.ts';
import { CharacterView } from '../../src/view/character-view.ts';
import { DrawnSkins } from '../../src/view/skin/drawn-skins.ts';
import { character, joint, skin } from '../helpers/builders.ts';

const CHARACTERS = 100;
const JOINTS = 25;
const KEYS = 30;
const SECONDS = 2;
const CHANNELS = 3 + 3 * JOINTS;

const tangents = { kinds: new Uint8Array(KEYS).fill(SMOOTH), slopes: new Float64Array(KEYS) };
const walk: Take = {
  name: 'walk',
  range: [0, SECONDS],
  channels: Array.from({ length: CHANNELS }, (_, c) => ({
    kind: 'keys',
    extrapolateIn: 'cycle',
    extrapolateOut: 'cycle',
    times: Float64Array.from({ length: KEYS }, (_, k) => (k * SECONDS) / (KEYS - 1)),
    values: Float64Array.from({ length: KEYS }, (_, k) => Math.sin(c + k)),
    tangentsIn: tangents,
    tangentsOut: tangents,
  })),
};
const limit = { min: -0.8, max: 0.9 };
const skeleton = {
  name: 'hero',
  joints: Array.from({ length: JOINTS }, (_, j) => joint(Math.floor((j - 1) / 2), { limits: [limit, limit, limit] })),
};
const body = skin('hero', JOINTS - 1);
const hero = character({ skeleton, skins: [body], takes: [walk], shownTake: 0 });

let frame = 0;
/** Each character is slightly later than the previous one. */
const now = () => ((frame++ % 60) / 60) * (SECONDS - 1);
const LATER = 1 / 100;

describe('100 characters of 25 joints, a frame', () => {
  const scene = new Scene();
  const views = Array.from({ length: CHARACTERS }, (_, i) => {
    const view = new CharacterView(new DrawnSkins());
    view.show({ ...hero, id: `c${i}`, timeOffsetSeconds: i * LATER }, DEFAULT_DISPLAY, undefined);
    scene.add(view.object);
    return view;
  });

  bench('ours', () => {
    const time = now();
    for (const view of views) view.seek(time);
    scene.updateMatrixWorld();
  });

  const plainScene = new Scene();
  const plain = Array.from({ length: CHARACTERS }, () => plainCharacter(plainScene));

  bench('plain three.js, a Bezier track for each DOF', () => {
    const time = now();
    for (let i = 0; i < CHARACTERS; i++) {
      plain[i].action.time = time + i * LATER;
      plain[i].mixer.update(0);
    }
    plainScene.updateMatrixWorld();
    for (const { mesh } of plain) mesh.skeleton.update();
  });

  const { times, cubics } = compileTake(walk);
  const { parent, offsets, lower, upper } = compileSkeleton(skeleton);
  const { inverseBindings } = compileSkin(body);
  const pose = new Float64Array(CHANNELS);
  const world = new Float64Array(16 * JOINTS);
  const palette = new Float32Array(16 * JOINTS * CHARACTERS);

  bench('bare loop', () => {
    const time = now();
    for (let i = 0; i < CHARACTERS; i++) bareCharacter(time + i * LATER, 16 * JOINTS * i);
  });

  function bareCharacter(t: number, out: number): void {
    for (let c = 0; c < CHANNELS; c++) {
      let low = KEYS * c;
      let high = low + KEYS - 1;
      while (high - low > 1) {
        const middle = (low + high) >>> 1;
        if (times[middle] <= t) low = middle;
        else high = middle;
      }
      const d = t - times[low];
      const o = 4 * low;
      const value = ((cubics[o + 3] * d + cubics[o + 2]) * d + cubics[o + 1]) * d + cubics[o];
      pose[c] = c < 3 ? value : Math.min(upper[c - 3], Math.max(lower[c - 3], value));
    }
    for (let j = 0; j < JOINTS; j++) {
      const sx = Math.sin(pose[3 + 3 * j]);
      const cx = Math.cos(pose[3 + 3 * j]);
      const sy = Math.sin(pose[4 + 3 * j]);
      const cy = Math.cos(pose[4 + 3 * j]);
      const sz = Math.sin(pose[5 + 3 * j]);
      const cz = Math.cos(pose[5 + 3 * j]);
      bareLocal[0] = cy * cz;
      bareLocal[1] = cy * sz;
      bareLocal[2] = -sy;
      bareLocal[4] = sx * sy * cz - cx * sz;
      bareLocal[5] = sx * sy * sz + cx * cz;
      bareLocal[6] = sx * cy;
      bareLocal[8] = cx * sy * cz + sx * sz;
      bareLocal[9] = cx * sy * sz - sx * cz;
      bareLocal[10] = cx * cy;
      for (let k = 0; k < 3; k++) bareLocal[12 + k] = offsets[3 * j + k] + (j === 0 ? pose[k] : 0);
      if (j === 0) world.set(bareLocal, 0);
      else bareProduct(world, 16 * parent[j], bareLocal, 0, world, 16 * j);
      bareProduct(world, 16 * j, inverseBindings, 16 * j, palette, out + 16 * j);
    }
  }
});

const bareLocal = new Float64Array(16);
bareLocal[15] = 1;

function bareProduct(
  a: Float64Array,
  p: number,
  b: Float64Array,
  q: number,
  out: Float64Array | Float32Array,
  o: number,
): void {
  for (let c = 0; c < 4; c++) {
    for (let r = 0; r < 3; r++) {
      out[o + 4 * c + r] = a[p + r] * b[q + 4 * c] + a[p + 4 + r] * b[q + 4 * c + 1] + a[p + 8 + r] * b[q + 4 * c + 2];
    }
    out[o + 4 * c + 3] = c === 3 ? 1 : 0;
  }
  out[o + 12] += a[p + 12];
  out[o + 13] += a[p + 13];
  out[o + 14] += a[p + 14];
}

/** The same character with three.js's own classes. */
function plainCharacter(scene: Scene) {
  const bones = skeleton.joints.map((j, index) => {
    const bone = new Bone();
    bone.name = `b${index}`;
    bone.rotation.order = 'ZYX';
    bone.position.set(...j.offset);
    return bone;
  });
  skeleton.joints.forEach((j, index) => {
    bones[j.parent]?.add(bones[index]);
  });
  const mesh = new SkinnedMesh(new BufferGeometry());
  mesh.add(bones[0]);
  const inverse = compileSkin(body).inverseBindings;
  mesh.bind(
    new Skeleton(
      bones,
      bones.map((_, j) => new Matrix4().fromArray(inverse, 16 * j)),
    ),
    new Matrix4(),
  );
  scene.add(mesh);
  const mixer = new AnimationMixer(mesh);
  const tracks = walk.channels.map((_, c) => plainTrack(c));
  const action = mixer.clipAction(new AnimationClip('walk', SECONDS, tracks)).play();
  return { mesh, mixer, action };
}

/** Hermite slopes as Bezier handles: a third of the way to the neighbouring key. */
function plainTrack(c: number): NumberKeyframeTrack {
  const keys = keysOf(walk.channels[c]);
  const { times, values } = keys;
  const slopes = resolvedSlopes(keys);
  const axis = 'xyz'[c % 3];
  const name = c < 3 ? `.bones[b0].position[${axis}]` : `.bones[b${Math.floor((c - 3) / 3)}].rotation[${axis}]`;
  const track = new NumberKeyframeTrack(name, Array.from(times), Array.from(values), InterpolateBezier);
  const third = SECONDS / (KEYS - 1) / 3;
  const handles = (side: number, slope: Float64Array) =>
    Float32Array.from({ length: 2 * KEYS }, (_, i) =>
      i % 2 === 0 ? times[i / 2] + side * third : values[(i - 1) / 2] + side * third * slope[(i - 1) / 2],
    );
  track.settings = { inTangents: handles(-1, slopes.in), outTangents: handles(1, slopes.out) };
  return track;
}
