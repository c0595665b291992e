/**
 * How far what another program makes of a GLB file is from our own doubles: joints, their axes, and vertices, which are
 * skinned here from the joints that the program shows.
 */

import { compileSkeleton, worldMatrices } from '../../src/evaluate/kinematics.ts';
import { dofCountOf, poseAt } from '../../src/evaluate/pose.ts';
import { blendMorphs, compileSkin, deform } from '../../src/evaluate/skin/deform.ts';
import { type Character, shownSkin } from '../../src/model/document.ts';
import type { Skin } from '../../src/model/skin.ts';
import { type Glb, numbersOf, type Player } from './glb.ts';

/** Largest differences from ours, over times of a take. */
export interface Off {
  /** Distance of a joint. */
  readonly joints: number;
  /** Distance of a vertex, by all its attachments. */
  readonly vertices: number;
  /** Distance of a vertex from where the same attachments are with our joints: all that the file has. */
  readonly asWritten: number;
  /** The same for programs that read the first four only. */
  readonly firstFour: number;
  /** Degrees between axes of a joint in the world, of those that have a length in ours. */
  readonly degrees: number;
}

/**
 * Compares what another program shows with our doubles.
 * @param times since the start of the take
 */
export function offBy(character: Character, glb: Glb, player: Player, take: number, times: readonly number[]): Off {
  const { skeleton, driver, morphs } = character;
  if (!skeleton) throw new Error('A skeleton was expected.');
  const played = { ...character, shownTake: take };
  const start = (driver?.source.take ?? character.takes[take])?.range[0] ?? 0;
  const compiled = compileSkeleton(skeleton);
  const dofs = new Float64Array(dofCountOf(character));
  const world = new Float64Array(16 * skeleton.joints.length);
  const skin = shownSkin(character);
  const mesh = skin && new WrittenMesh(glb);
  const own = skin && compileSkin(normalised(skin));
  const [ours, theirs, normals] = [0, 1, 2].map(() => new Float64Array(skin?.positions.length ?? 0));
  const off = { joints: 0, vertices: 0, asWritten: 0, firstFour: 0, degrees: 0 };
  const see = (what: 'vertices' | 'asWritten' | 'firstFour') => {
    for (let o = 0; o < ours.length; o += 3) off[what] = Math.max(off[what], distance(theirs, o, ours, o));
  };
  for (const time of times) {
    const { matrices, weights } = player(take, time);
    poseAt(played, start + time, dofs);
    worldMatrices(compiled, dofs, world);
    for (let o = 0; o < world.length; o += 16) {
      off.joints = Math.max(off.joints, distance(matrices, o + 12, world, o + 12));
      for (const c of [0, 4, 8]) off.degrees = Math.max(off.degrees, degreesBetween(matrices, world, o + c));
    }
    if (!mesh || !own) continue;
    blendMorphs(own, morphs, dofs, dofs.length - morphs.length, ours, normals);
    deform(own, world, ours, normals, ours, normals);
    mesh.write(matrices, weights, mesh.setCount, theirs);
    see('vertices');
    const ownWeights = dofs.subarray(dofs.length - morphs.length);
    mesh.write(world, ownWeights, mesh.setCount, ours);
    see('asWritten');
    if (mesh.setCount === 1) continue;
    mesh.write(matrices, weights, 1, theirs);
    mesh.write(world, ownWeights, 1, ours);
    see('firstFour');
  }
  return mesh?.setCount === 1 ? { ...off, firstFour: off.asWritten } : off;
}

const withSums = new WeakMap<Skin, Skin>();

/** The skin with weights that sum to 1, as glTF needs them. */
function normalised(skin: Skin): Skin {
  const known = withSums.get(skin);
  if (known || !skin.attachments) return known ?? skin;
  const { start } = skin.attachments;
  const weights = skin.attachments.weights.slice();
  for (let v = 0; v + 1 < start.length; v++) {
    const own = weights.subarray(start[v], start[v + 1]);
    const sum = own.reduce((total, w) => total + w, 0);
    own.forEach((w, a) => {
      own[a] = w / sum;
    });
  }
  const made = { ...skin, attachments: { ...skin.attachments, weights } };
  withSums.set(skin, made);
  return made;
}

function distance(a: Float64Array, i: number, b: Float64Array, j: number): number {
  return lengthOf(a[i] - b[j], a[i + 1] - b[j + 1], a[i + 2] - b[j + 2]);
}

/** As `Math.hypot`, which takes most of the time of tests that compare by the million. */
function lengthOf(x: number, y: number, z: number): number {
  return Math.sqrt(x * x + y * y + z * z);
}

/** Degrees between the vectors at `o`; 0 where the second one has no length. */
function degreesBetween(a: Float64Array, b: Float64Array, o: number): number {
  const ax = a[o];
  const ay = a[o + 1];
  const az = a[o + 2];
  const bx = b[o];
  const by = b[o + 1];
  const bz = b[o + 2];
  if (lengthOf(bx, by, bz) < 1e-3) return 0;
  const across = lengthOf(ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx);
  return (Math.atan2(across, ax * bx + ay * by + az * bz) * 180) / Math.PI;
}

/** The first mesh of a file. */
class WrittenMesh {
  readonly setCount: number;
  private readonly base: Float64Array;
  private readonly inverse: Float64Array;
  private readonly sets: readonly { readonly joints: Float64Array; readonly weights: Float64Array }[];
  private readonly targets: readonly Float64Array[];

  constructor(glb: Glb) {
    const [skin] = glb.json.skins ?? [];
    const [primitive] = glb.json.meshes?.[0].primitives ?? [];
    const { attributes } = primitive;
    this.base = numbersOf(glb, attributes.POSITION);
    this.inverse = numbersOf(glb, skin.inverseBindMatrices);
    const count = Object.keys(attributes).filter((name) => name.startsWith('JOINTS_')).length;
    this.setCount = count;
    this.sets = Array.from({ length: count }, (_, set) => ({
      joints: numbersOf(glb, attributes[`JOINTS_${set}`]),
      weights: numbersOf(glb, attributes[`WEIGHTS_${set}`]),
    }));
    this.targets = (primitive.targets ?? []).map((target) => numbersOf(glb, target.POSITION));
  }

  /**
   * Writes where the vertices are by the first attachments, normalised.
   * @param matrices of the skin's joints; those beyond never move
   * @param sets how many sets of four are read
   */
  write(matrices: Float64Array, morphWeights: ArrayLike<number>, sets: number, out: Float64Array): void {
    const { base, inverse, targets } = this;
    const moving = new Float64Array(inverse.length);
    for (let o = 0; o < moving.length; o += 16) {
      if (o >= matrices.length) moving.set(inverse.subarray(o, o + 16), o);
      else multiply(matrices, inverse, o, moving);
    }
    const point = new Float64Array(3);
    for (let v = 0; 3 * v < base.length; v++) {
      for (let k = 0; k < 3; k++) {
        point[k] = base[3 * v + k];
        for (let m = 0; m < targets.length; m++) point[k] += (morphWeights[m] ?? 0) * targets[m][3 * v + k];
      }
      let sum = 0;
      let [x, y, z] = [0, 0, 0];
      for (let set = 0; set < sets; set++) {
        const { joints, weights } = this.sets[set];
        for (let k = 4 * v; k < 4 * v + 4; k++) {
          const w = weights[k];
          if (w === 0) continue;
          const m = 16 * joints[k];
          sum += w;
          x += w * (moving[m] * point[0] + moving[m + 4] * point[1] + moving[m + 8] * point[2] + moving[m + 12]);
          y += w * (moving[m + 1] * point[0] + moving[m + 5] * point[1] + moving[m + 9] * point[2] + moving[m + 13]);
          z += w * (moving[m + 2] * point[0] + moving[m + 6] * point[1] + moving[m + 10] * point[2] + moving[m + 14]);
        }
      }
      out[3 * v] = x / sum;
      out[3 * v + 1] = y / sum;
      out[3 * v + 2] = z / sum;
    }
  }
}

/** The product of the affine matrices at `o`. */
function multiply(a: Float64Array, b: Float64Array, o: number, out: Float64Array): void {
  for (let c = o; c < o + 16; c += 4) {
    for (let r = 0; r < 4; r++) {
      out[c + r] = a[o + r] * b[c] + a[o + 4 + r] * b[c + 1] + a[o + 8 + r] * b[c + 2] + a[o + 12 + r] * b[c + 3];
    }
  }
}
