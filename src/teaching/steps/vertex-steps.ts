/**
 * The way of a vertex of a skin from its place in the file to where it is drawn, step by step:
 *
 *     morphs        v = v₀ + Σ φₜ · (vₜ − v₀)                     normals alike
 *     attachments   v′ = Σ w · (W·B⁻¹ · v)                        a row each: B⁻¹·v, W·B⁻¹·v, w·(…), the sum so far
 *                   n′ = normalised Σ w · ((W·B⁻¹)⁻ᵀ · n)
 *
 * Each number is the double that `blendMorphs` and `deform` have on the way; B⁻¹·v only shows where the vertex is in
 * the joint's space, since W·B⁻¹ is multiplied first.
 */
import { type CompiledSkin, compileSkin } from '../../evaluate/skin/deform.ts';
import { inverseTranspose3, multiplyAffine, setIdentity } from '../../math/mat4.ts';
import { normalizeAt, type Vec3 } from '../../math/vec3.ts';
import type { Morph, MorphRows } from '../../model/morph.ts';
import type { Skin } from '../../model/skin.ts';

/** One morph's part of a position or normal. */
export interface MorphTerm {
  /** Into the character's morphs. */
  readonly morph: number;
  /** φ. */
  readonly weight: number;
  /** vₜ − v₀. */
  readonly difference: Vec3;
  /** φ · (vₜ − v₀). */
  readonly term: Vec3;
  /** v₀ and the terms so far. */
  readonly sum: Vec3;
}

/** The contribution of one attachment to a vertex. */
export interface AttachmentStep {
  readonly joint: number;
  /** w. */
  readonly weight: number;
  /** B⁻¹ · v: in the joint's space. */
  readonly inJoint: Vec3;
  /** W · B⁻¹ · v: where the joint alone would take it. */
  readonly moved: Vec3;
  /** w · (…). */
  readonly term: Vec3;
  readonly sum: Vec3;
  /** (W·B⁻¹)⁻ᵀ · n. */
  readonly turned: Vec3;
  readonly normalTerm: Vec3;
  readonly normalSum: Vec3;
}

/** The steps by which a vertex gets its position and normal. */
export interface VertexSteps {
  readonly vertex: number;
  /** v₀ and n₀: in the file, n₀ also as computed from the triangles. */
  readonly base: Vec3;
  readonly baseNormal: Vec3;
  readonly morphs: readonly MorphTerm[];
  readonly normalMorphs: readonly MorphTerm[];
  /** v and n, with morphs. */
  readonly blended: Vec3;
  readonly blendedNormal: Vec3;
  /** Empty: nothing moves the vertex. */
  readonly attachments: readonly AttachmentStep[];
  /** v′ and n′, as drawn. */
  readonly position: Vec3;
  /** Normalised. */
  readonly normal: Vec3;
}

/**
 * Makes a function that follows one vertex repeatedly.
 * @returns takes the character's DOFs, of which the morph weights are the last, and the joints' world matrices, 16 each
 * (undefined without a skeleton)
 */
export function vertexStepper(
  skin: Skin,
  morphs: readonly Morph[],
  vertex: number,
): (dofs: Float64Array, world: Float64Array | undefined) => VertexSteps {
  const compiled = compileSkin(skin);
  const targets = rowsOf(morphs, 'positions', vertex);
  const normalTargets = rowsOf(morphs, 'normals', vertex);
  const base = at(skin.positions, vertex);
  const baseNormal = at(compiled.normals, vertex);
  const attached = attachmentsOf(skin, vertex);
  return (dofs, world) => {
    const weights = dofs.subarray(dofs.length - morphs.length);
    const terms = morphTerms(targets, base, weights);
    const normalTerms = morphTerms(normalTargets, baseNormal, weights);
    const blended = terms.at(-1)?.sum ?? base;
    const blendedNormal = normalTerms.at(-1)?.sum ?? baseNormal;
    const attachments = world ? attachmentSteps(compiled, world, attached, blended, blendedNormal) : [];
    const last = attachments.at(-1);
    return {
      vertex,
      base,
      baseNormal,
      morphs: terms,
      normalMorphs: normalTerms,
      blended,
      blendedNormal,
      attachments,
      position: last?.sum ?? blended,
      normal: normalised(last?.normalSum ?? blendedNormal, blendedNormal),
    };
  };
}

/** A morph's value for a vertex. */
interface Target {
  readonly morph: number;
  readonly value: Vec3;
}

function rowsOf(morphs: readonly Morph[], what: 'positions' | 'normals', vertex: number): readonly Target[] {
  return morphs.flatMap((each, morph) => {
    const rows: MorphRows = each[what];
    const found: Target[] = [];
    for (let row = rows.indices.indexOf(vertex); row >= 0; row = rows.indices.indexOf(vertex, row + 1)) {
      found.push({ morph, value: at(rows.values, row) });
    }
    return found;
  });
}

function morphTerms(targets: readonly Target[], base: Vec3, weights: Float64Array): readonly MorphTerm[] {
  let sum = base;
  return targets.map(({ morph, value }) => {
    const weight = weights[morph];
    const difference = each((k) => value[k] - base[k]);
    const term = each((k) => weight * difference[k]);
    const before = sum;
    // As `blendMorphs`, which skips those of weight 0.
    if (weight !== 0) sum = each((k) => before[k] + term[k]);
    return { morph, weight, difference, term, sum };
  });
}

function attachmentsOf({ attachments }: Skin, vertex: number): readonly { joint: number; weight: number }[] {
  if (!attachments) return [{ joint: 0, weight: 1 }];
  const { start, joints, weights } = attachments;
  return Array.from({ length: start[vertex + 1] - start[vertex] }, (_, i) => {
    const a = start[vertex] + i;
    return { joint: joints[a], weight: weights[a] };
  });
}

/** W·B⁻¹ and its inverse transpose. Scratch; never escape. */
const matrix = new Float64Array(16);
const normalMatrix = new Float64Array(9);

function attachmentSteps(
  { inverseBindings }: CompiledSkin,
  world: Float64Array,
  attached: readonly { readonly joint: number; readonly weight: number }[],
  v: Vec3,
  n: Vec3,
): readonly AttachmentStep[] {
  let sum: Vec3 = [0, 0, 0];
  let normalSum: Vec3 = [0, 0, 0];
  return attached.map(({ joint, weight }) => {
    const o = 16 * joint;
    if (o + 16 <= world.length) multiplyAffine(world, o, inverseBindings, o, matrix, 0);
    else setIdentity(matrix);
    inverseTranspose3(matrix, 0, normalMatrix, 0);
    const moved = transformed(matrix, 0, v);
    const turned = each((r) => normalMatrix[r] * n[0] + normalMatrix[r + 3] * n[1] + normalMatrix[r + 6] * n[2]);
    const [before, normalBefore] = [sum, normalSum];
    const term = each((k) => weight * moved[k]);
    const normalTerm = each((k) => weight * turned[k]);
    sum = each((k) => before[k] + term[k]);
    normalSum = each((k) => normalBefore[k] + normalTerm[k]);
    const inJoint = transformed(inverseBindings, o, v);
    return { joint, weight, inJoint, moved, term, sum, turned, normalTerm, normalSum };
  });
}

function transformed(m: Float64Array, o: number, [x, y, z]: Vec3): Vec3 {
  return each((r) => m[o + r] * x + m[o + r + 4] * y + m[o + r + 8] * z + m[o + r + 12]);
}

/** As `deform`: without a direction that before skinning, or else up. */
function normalised(n: Vec3, before: Vec3): Vec3 {
  for (const candidate of [n, before]) {
    const out = Float64Array.from(candidate);
    if (normalizeAt(out, 0)) return at(out, 0);
  }
  return [0, 1, 0];
}

function at(column: Float64Array, row: number): Vec3 {
  return [column[3 * row], column[3 * row + 1], column[3 * row + 2]];
}

function each(value: (k: number) => number): Vec3 {
  return [value(0), value(1), value(2)];
}
