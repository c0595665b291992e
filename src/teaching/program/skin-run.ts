/** Morphs and skinning by any rules (`SkinRules`), in doubles. */
import { blendMorphs, type CompiledSkin, compileSkin } from '../../evaluate/skin/deform.ts';
import { runToEnd, type Steps } from '../../evaluate/steps.ts';
import { inverseTranspose3, invertAffine, isSingular, multiplyAffine, setIdentity } from '../../math/mat4.ts';
import { normalizeAt } from '../../math/vec3.ts';
import type { Character } from '../../model/document.ts';
import { shownSkin } from '../../model/document.ts';
import type { MorphRows } from '../../model/morph.ts';
import type { Attachments } from '../../model/skin.ts';
import type { SkinRules, Wanted } from './program.ts';

const NONE = new Float64Array(0);
/** Vertices between two yields: about a millisecond of work. */
const STRIDE = 4096;
/** Attachments of a skin without any: every vertex to the root, with weight 1. */
const NO_RULES_FOR_ROOT: Attachments = {
  start: new Uint32Array(0),
  joints: Uint32Array.of(0),
  weights: Float64Array.of(1),
};

/** Runs the skinning of any program on one skin; its arrays are overwritten by the next run. */
export class SkinRun {
  private readonly skin: CompiledSkin;
  private readonly positions: Float64Array;
  private readonly normals: Float64Array;
  private readonly outPositions: Float64Array;
  private readonly outNormals: Float64Array;
  private readonly matrices: Float64Array;
  private readonly normalMatrices: Float64Array;
  /** B and B⁻¹, as read and with their upper 3×3 transposed. */
  private readonly transposed: { readonly bindings: Float64Array; readonly inverses: Float64Array };
  private readonly bindings: Float64Array;
  private readonly attachments = new Map<string, Attachments>();

  constructor(private readonly character: Character) {
    const skin = shownSkin(character);
    if (!skin) throw new Error('SkinRun needs a character with a skin.');
    this.skin = compileSkin(skin);
    const { matrixCount, vertexCount } = this.skin;
    const length = 3 * vertexCount;
    this.positions = new Float64Array(length);
    this.normals = new Float64Array(length);
    this.outPositions = new Float64Array(length);
    this.outNormals = new Float64Array(length);
    this.matrices = new Float64Array(16 * matrixCount);
    this.normalMatrices = new Float64Array(9 * matrixCount);
    this.bindings = new Float64Array(16 * matrixCount);
    const bindings = new Float64Array(16 * matrixCount);
    const inverses = new Float64Array(16 * matrixCount);
    for (let o = 0; o < bindings.length; o += 16) {
      if (o < skin.bindings.length) this.bindings.set(skin.bindings.subarray(o, o + 16), o);
      else setIdentity(this.bindings, o);
      for (let c = 0; c < 4; c++) {
        for (let r = 0; r < 4; r++) {
          const isUpper = c < 3 && r < 3;
          bindings[o + 4 * c + r] = this.bindings[o + (isUpper ? 4 * r + c : 4 * c + r)];
        }
      }
      if (isSingular(bindings, o)) setIdentity(inverses, o);
      else invertAffine(bindings, o, inverses, o);
    }
    this.transposed = { bindings, inverses };
  }

  /**
   * Morphs and skins by these rules; without world matrices, morphs only.
   * @param dofs the character's, of which the morph weights are the last
   */
  run(rules: SkinRules, dofs: Float64Array, world: Float64Array | undefined, wanted: Wanted) {
    const { positions, normals, skin } = this;
    this.blend(rules, dofs);
    const hasMorphsBehind = rules.morph.startsWith('after') && rules.bind === 'moved';
    if (world && rules.bind === 'moved') this.deform(rules, world, wanted);
    else {
      this.outPositions.set(positions);
      this.outNormals.set(normals);
    }
    if (hasMorphsBehind) this.addBehind(rules, dofs);
    if (wanted.normals && rules.isNormalised) {
      for (let v = 0; v < skin.vertexCount; v++) this.normalise(3 * v);
    }
    return {
      vertices: wanted.vertices ? this.outPositions : NONE,
      normals: wanted.normals ? this.outNormals : NONE,
    };
  }

  private normalise(o: number): void {
    const { outNormals, normals } = this;
    if (normalizeAt(outNormals, o)) return;
    outNormals.set(normals.subarray(o, o + 3), o);
    if (normalizeAt(outNormals, o)) return;
    outNormals[o] = outNormals[o + 2] = 0;
    outNormals[o + 1] = 1;
  }

  private blend(rules: SkinRules, dofs: Float64Array): void {
    const { skin, positions, normals, character } = this;
    const { morphs } = character;
    const first = dofs.length - morphs.length;
    if (rules.morph === 'before' && rules.bind !== 'bind pose without morphs') {
      blendMorphs(skin, morphs, dofs, first, positions, normals);
      return;
    }
    positions.set(skin.skin.positions);
    normals.set(skin.normals);
    if (rules.morph !== 'offset' && rules.morph !== 'after, positions only') return;
    morphs.forEach((morph, m) => {
      const weight = dofs[first + m];
      if (rules.morph === 'offset') addRows(morph.positions, undefined, weight, positions);
      addRows(morph.normals, rules.morph === 'offset' ? undefined : skin.normals, weight, normals);
    });
  }

  private addBehind(rules: SkinRules, dofs: Float64Array): void {
    const { skin, outPositions, outNormals, character } = this;
    const first = dofs.length - character.morphs.length;
    if (rules.morph === 'after normalising') for (let o = 0; o < outNormals.length; o += 3) normalizeAt(outNormals, o);
    character.morphs.forEach((morph, m) => {
      addRows(morph.positions, skin.skin.positions, dofs[first + m], outPositions);
      if (rules.morph !== 'after, positions only') addRows(morph.normals, skin.normals, dofs[first + m], outNormals);
    });
  }

  private deform(rules: SkinRules, world: Float64Array, wanted: Wanted): void {
    const { matrices, normalMatrices, skin, positions, normals, outPositions, outNormals } = this;
    this.skinMatrices(rules, world);
    if (wanted.normals && rules.normals !== 'as positions') {
      for (let j = 0; j < skin.matrixCount; j++) writeNormalMatrix(rules, matrices, 16 * j, normalMatrices, 9 * j);
    }
    const attachments = this.attachmentsBy(rules);
    const hangs = attachments === NO_RULES_FOR_ROOT;
    const { start, joints, weights } = attachments;
    for (let v = 0; v < skin.vertexCount; v++) {
      const from = hangs ? 0 : start[v];
      const to = hangs ? 1 : start[v + 1];
      const o = 3 * v;
      if (from === to) {
        for (let i = o; i < o + 3; i++) {
          outPositions[i] = positions[i];
          outNormals[i] = normals[i];
        }
        continue;
      }
      if (wanted.vertices) sumPoint(matrices, joints, weights, from, to, positions, o, outPositions, o);
      if (!wanted.normals) continue;
      if (rules.normals === 'as positions') sumPoint(matrices, joints, weights, from, to, normals, o, outNormals, o);
      else sumNormal(normalMatrices, joints, weights, from, to, normals, o, outNormals);
      if (rules.normals !== 'with translation') continue;
      for (let a = from; a < to; a++) {
        for (let k = 0; k < 3; k++) outNormals[o + k] += weights[a] * matrices[16 * joints[a] + 12 + k];
      }
    }
  }

  private skinMatrices(rules: SkinRules, world: Float64Array): void {
    const { matrices, skin } = this;
    const inverses = rules.bindingRows ? this.transposed.inverses : skin.inverseBindings;
    const bindings = rules.bindingRows ? this.transposed.bindings : this.bindings;
    for (let o = 0; o < matrices.length; o += 16) {
      if (o + 16 > world.length) setIdentity(matrices, o);
      else if (rules.binding === 'none') matrices.set(world.subarray(o, o + 16), o);
      else if (rules.binding === 'inverse') multiplyAffine(world, o, inverses, o, matrices, o);
      else if (rules.binding === 'not inverted') multiplyAffine(world, o, bindings, o, matrices, o);
      else multiplyAffine(inverses, o, world, o, matrices, o);
    }
  }

  private attachmentsBy(rules: SkinRules): Attachments {
    const { attachments: given } = this.skin.skin;
    if (!given) return NO_RULES_FOR_ROOT;
    const { attachments, weights, joint } = rules;
    if (attachments === 'all' && weights === 'given' && joint.shift === 0) return given;
    const key = `${attachments} ${weights} ${joint.shift} ${joint.beyond}`;
    let made = this.attachments.get(key);
    if (!made) {
      made = runToEnd(attachmentsUsed(given, rules, this.skin.matrixCount));
      this.attachments.set(key, made);
    }
    return made;
  }
}

function addRows(
  { indices, values }: MorphRows,
  base: Float64Array | undefined,
  weight: number,
  out: Float64Array,
): void {
  if (weight === 0) return;
  for (let row = 0; row < indices.length; row++) {
    const o = 3 * indices[row];
    for (let k = 0; k < 3; k++) out[o + k] += weight * (values[3 * row + k] - (base ? base[o + k] : 0));
  }
}

/** Σ w·M·p of the attachments `from` up to (excluding) `to`, for the point at `points[o]`, into `out[oo]`. */
export function sumPoint(
  matrices: Float64Array,
  joints: Uint32Array,
  weights: Float64Array,
  from: number,
  to: number,
  points: Float64Array,
  o: number,
  out: Float64Array,
  oo: number,
): void {
  const px = points[o];
  const py = points[o + 1];
  const pz = points[o + 2];
  let x = 0;
  let y = 0;
  let z = 0;
  for (let a = from; a < to; a++) {
    const w = weights[a];
    const m = 16 * joints[a];
    x += w * (matrices[m] * px + matrices[m + 4] * py + matrices[m + 8] * pz + matrices[m + 12]);
    y += w * (matrices[m + 1] * px + matrices[m + 5] * py + matrices[m + 9] * pz + matrices[m + 13]);
    z += w * (matrices[m + 2] * px + matrices[m + 6] * py + matrices[m + 10] * pz + matrices[m + 14]);
  }
  out[oo] = x;
  out[oo + 1] = y;
  out[oo + 2] = z;
}

function sumNormal(
  matrices: Float64Array,
  joints: Uint32Array,
  weights: Float64Array,
  from: number,
  to: number,
  normals: Float64Array,
  o: number,
  out: Float64Array,
): void {
  const [nx, ny, nz] = [normals[o], normals[o + 1], normals[o + 2]];
  let x = 0;
  let y = 0;
  let z = 0;
  for (let a = from; a < to; a++) {
    const w = weights[a];
    const m = 9 * joints[a];
    x += w * (matrices[m] * nx + matrices[m + 3] * ny + matrices[m + 6] * nz);
    y += w * (matrices[m + 1] * nx + matrices[m + 4] * ny + matrices[m + 7] * nz);
    z += w * (matrices[m + 2] * nx + matrices[m + 5] * ny + matrices[m + 8] * nz);
  }
  out[o] = x;
  out[o + 1] = y;
  out[o + 2] = z;
}

/** 9 numbers, column-major. */
function writeNormalMatrix({ normals }: SkinRules, m: Float64Array, mo: number, out: Float64Array, o: number): void {
  if (normals === 'matrix') {
    for (let c = 0; c < 3; c++) for (let r = 0; r < 3; r++) out[o + 3 * c + r] = m[mo + 4 * c + r];
    return;
  }
  inverseTranspose3(m, mo, out, o);
  if (normals !== 'inverse') return;
  for (const [a, b] of [
    [1, 3],
    [2, 6],
    [5, 7],
  ]) {
    const value = out[o + a];
    out[o + a] = out[o + b];
    out[o + b] = value;
  }
}

/** The attachments that a program uses. */
export function* attachmentsUsed(given: Attachments, rules: SkinRules, jointCount: number): Steps<Attachments> {
  const start = new Uint32Array(given.start.length);
  const joints: number[] = [];
  const weights: number[] = [];
  for (let v = 0; v + 1 < start.length; v++) {
    if (v % STRIDE === STRIDE - 1) yield v / start.length;
    let own: number[] = [];
    for (let a = given.start[v]; a < given.start[v + 1]; a++) own.push(a);
    if (rules.attachments.startsWith('largest')) own.sort((a, b) => given.weights[b] - given.weights[a]);
    if (rules.attachments.includes('four')) own = own.slice(0, 4);
    else if (rules.attachments !== 'all') own = own.slice(0, 1);
    let sum = 0;
    for (const a of own) sum += given.weights[a];
    const isWhole =
      rules.weights === 'normalised' ||
      rules.attachments.endsWith('as whole') ||
      rules.attachments.endsWith('four normalised') ||
      (rules.attachments.endsWith('cut ones normalised') && given.start[v + 1] - given.start[v] > 4);
    const scale = isWhole && sum !== 0 ? 1 / sum : 1;
    for (const a of own) {
      let joint = given.joints[a] + rules.joint.shift;
      if (joint < 0 || joint >= jointCount) {
        if (rules.joint.beyond === 'left out') continue;
        joint =
          rules.joint.beyond === 'clamped'
            ? Math.min(jointCount - 1, Math.max(0, joint))
            : (joint + jointCount) % jointCount;
      }
      joints.push(joint);
      weights.push(scale * given.weights[a]);
    }
    start[v + 1] = joints.length;
  }
  return { start, joints: Uint32Array.from(joints), weights: Float64Array.from(weights) };
}
