/**
 * Picture that a program with four attachments per vertex would draw: how far each vertex is from where all attachments
 * move it.
 *
 *     |v′ − v₄|          v′ = Σ wᵢ · Wᵢ·Bᵢ⁻¹ · v          v₄: the same with the four that are kept
 *
 * glTF's usual layout and many engines have four, mostly the largest, normalised; a reader of skins may stop at the
 * fourth in the file instead. What is kept are the rules that `first-four-attachments` tries.
 */
import { blendMorphs, type CompiledSkin, compileSkin, skinMatrices } from '../../evaluate/skin/deform.ts';
import { type Steps, within } from '../../evaluate/steps.ts';
import type { Morph } from '../../model/morph.ts';
import { type Attachments, type Skin, vertexCount } from '../../model/skin.ts';
import { diagonalOf } from '../compare/errors.ts';
import { RIGHT_PROGRAM, type SkinRules } from './program.ts';
import { attachmentsUsed, sumPoint } from './skin-run.ts';

/** Ways to keep four attachments per vertex. */
export const KEPT_FOUR = [
  'largest four normalised',
  'largest four',
  'first four normalised',
  'first four',
] as const satisfies readonly SkinRules['attachments'][];
/** A way to keep four attachments; see `KEPT_FOUR`. */
export type KeptFour = (typeof KEPT_FOUR)[number];

const FOUR = 4;
/** Sums of weights, which files write with six digits or so, are 1 within this. */
const SUM_TOLERANCE = 1e-5;
/** Vertices between two yields: about a millisecond of work. */
const STRIDE = 8192;

/** Facts about a pose. */
export interface FourFacts {
  /** The diagonal of the box around the skin as it is drawn. */
  readonly size: number;
  /** Largest of the displacements, in the character's units. */
  readonly largest: number;
  /** The vertex with the largest one; undefined if none is displaced. */
  readonly vertex: number | undefined;
}

/** The skin with all attachments, and with four. */
export class FourAttachments {
  /** Number of vertices with more than four attachments. */
  readonly beyondFour: number;
  readonly mostAttachments: number;
  /** Number of the other vertices that normalising displaces, since their weights don't sum to 1. */
  readonly unevenSums: number;
  /** Per vertex, in the character's units, of the last pose. */
  readonly displacements: Float64Array;
  private readonly compiled: CompiledSkin;
  /** Made with the first pose, since it takes as long as measuring a few. */
  private kept: Attachments | undefined;
  private readonly matrices: Float64Array;
  private readonly blended: Float64Array;
  private readonly blendedNormals: Float64Array;
  private readonly moved: Float64Array;
  private readonly movedByFour = new Float64Array(3);

  constructor(
    private readonly skin: Skin,
    private readonly morphs: readonly Morph[],
    private readonly rule: KeptFour,
  ) {
    this.compiled = compileSkin(skin);
    const { matrixCount } = this.compiled;
    const count = vertexCount(skin);
    const { attachments } = skin;
    this.matrices = new Float64Array(16 * matrixCount);
    this.displacements = new Float64Array(count);
    this.moved = new Float64Array(3 * count);
    const isBlended = morphs.length > 0;
    this.blended = isBlended ? new Float64Array(3 * count) : skin.positions;
    this.blendedNormals = new Float64Array(isBlended ? 3 * count : 0);
    let beyondFour = 0;
    let mostAttachments = 0;
    let unevenSums = 0;
    for (let v = 0; attachments && v < count; v++) {
      const from = attachments.start[v];
      const to = attachments.start[v + 1];
      mostAttachments = Math.max(mostAttachments, to - from);
      if (to - from > FOUR) beyondFour++;
      else if (to > from && rule.endsWith('normalised') && !sumsToOne(attachments.weights, from, to)) unevenSums++;
    }
    this.beyondFour = beyondFour;
    this.mostAttachments = mostAttachments;
    this.unevenSums = unevenSums;
  }

  /**
   * Measures a pose into `displacements`. Both arguments are read before the first yield.
   * @param dofs the character's, of which the morph weights are the last
   * @param world 16 per joint; undefined without a skeleton
   */
  *follow(dofs: Float64Array, world: Float64Array | undefined): Steps<FourFacts> {
    const { compiled, matrices, morphs, blended, blendedNormals, moved, movedByFour, displacements } = this;
    const { attachments } = this.skin;
    if (morphs.length > 0) blendMorphs(compiled, morphs, dofs, dofs.length - morphs.length, blended, blendedNormals);
    if (world) skinMatrices(compiled, world, matrices);
    if (attachments && world) {
      const rules: SkinRules = { ...RIGHT_PROGRAM.skin, attachments: this.rule };
      this.kept ??= yield* within(attachmentsUsed(attachments, rules, compiled.matrixCount), 0, 0.5);
    }
    const { kept } = this;
    const isPosed = world !== undefined && attachments !== undefined && kept !== undefined;
    let largest = 0;
    let vertex: number | undefined;
    for (let v = 0; v < displacements.length; v++) {
      if (v % STRIDE === STRIDE - 1) yield 0.5 + (0.5 * v) / displacements.length;
      const o = 3 * v;
      const from = isPosed ? attachments.start[v] : 0;
      const to = isPosed ? attachments.start[v + 1] : 0;
      displacements[v] = 0;
      if (!isPosed || from === to) {
        moved.set(blended.subarray(o, o + 3), o);
        continue;
      }
      sumPoint(matrices, attachments.joints, attachments.weights, from, to, blended, o, moved, o);
      sumPoint(matrices, kept.joints, kept.weights, kept.start[v], kept.start[v + 1], blended, o, movedByFour, 0);
      const distance = Math.hypot(
        moved[o] - movedByFour[0],
        moved[o + 1] - movedByFour[1],
        moved[o + 2] - movedByFour[2],
      );
      displacements[v] = distance;
      if (!(distance > largest)) continue;
      largest = distance;
      vertex = v;
    }
    return { size: diagonalOf(moved, 3, 0), largest, vertex };
  }
}

function sumsToOne(weights: Float64Array, from: number, to: number): boolean {
  let sum = 0;
  for (let a = from; a < to; a++) sum += weights[a];
  return Math.abs(sum - 1) <= SUM_TOLERANCE;
}
