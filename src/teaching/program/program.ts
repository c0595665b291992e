/**
 * A program that makes joints, vertices and channels of a character's files, as the rules that it goes by. Each rule is
 * a step that a student writes; `RIGHT_PROGRAM` has them as the lecture does, and a mistake is a program with another
 * rule. Two mistakes are the second applied to the program of the first.
 *
 *     channels → DOFs → limits → J → L → W → M = W·B⁻¹ → Σ w·M·v, Σ w·M⁻ᵀ·n
 */
import type { EulerOrder } from '../../model/skeleton/skeleton.ts';
import { type CurveRules, RIGHT_CURVES } from './curve-rules.ts';

/**
 * Which joints a rule is for: balls alone; all with an order of rotations (balls, universal and free joints); all but
 * those that list their DOFs (compounds); all.
 */
export type Breadth = 'balls' | 'ordered' | 'not listed' | 'all';

/** The rules by which a program makes the matrices of joints. */
export interface JointRules {
  /** One for all joints with three angles; absent: each its own. */
  readonly order?: { readonly is: EulerOrder; readonly for: Breadth };
  /** Signs of angles about x, y, z and other axes; in balls, or in all joints. */
  readonly signs: { readonly are: readonly [number, number, number, number]; readonly for: Breadth };
  /** The rotation of each joint is its transpose. */
  readonly transposed: 'none' | Breadth;
  /** Angles are multiplied by it: in the file, before limits, or in the joint, behind them. */
  readonly angles: { readonly factor: number; readonly at: 'file' | 'joint'; readonly for: Breadth };
  /** J·T(offset + t); `inner` with the joint's own translation, too. */
  readonly offset: 'before' | 'after' | 'inner after' | 'none';
  readonly root: 'moves' | 'stays at offset' | 'stays at 0';
  readonly hasLimits: boolean;
  /** At rest, with the root where it is given, at its offset, or at 0. */
  readonly pose: 'given' | 'rest' | 'rest, root at offset' | 'rest, root at 0';
  /** Whose DOFs the values are, or whose matrix a joint's is. */
  readonly breadthFirst: { readonly of: 'none' | 'dofs' | 'joints' | 'both'; readonly isInverse: boolean };
  /** rx and rz swapped. */
  readonly dofOrder: { readonly isReversed: boolean; readonly for: Breadth; readonly withRoot: boolean };
  readonly concatenation: 'parent first' | 'parent last' | 'no parent';
  /** Changes of all world matrices, in order. */
  readonly world: readonly WorldMap[];
  /** Degrees of motion capture used as radians. */
  readonly bvhDegrees: boolean;
  readonly bvhPositions: 'given' | 'added';
  /** The product in another order; or the columns of angles taken for those of other axes. */
  readonly bvhOrder: 'listed' | 'reversed' | `multiplied ${EulerOrder}` | `read ${EulerOrder}`;
}

/** `W⁻¹`; S·W·S with z mirrored, or with y and z swapped; `points`: vertices and bindings as well. */
export type WorldMap = 'inverse' | 'mirror z' | 'mirror z of points' | 'swap y z' | 'swap y z of points';

/** The rules by which a program morphs and skins. */
export interface SkinRules {
  /** M: W·B⁻¹, W, W·B or B⁻¹·W. */
  readonly binding: 'inverse' | 'none' | 'not inverted' | 'before world';
  /** The upper 3×3 of B transposed. */
  readonly bindingRows: boolean;
  readonly attachments:
    | 'all'
    | 'first'
    | 'first as whole'
    | 'first four'
    | 'first four normalised'
    | 'largest'
    | 'largest as whole'
    | 'largest four'
    | 'largest four normalised'
    | 'first four, cut ones normalised';
  readonly weights: 'given' | 'normalised';
  readonly bind: 'moved' | 'bind pose' | 'bind pose without morphs';
  /** `offset`: absolute values added; `after`: differences added behind skinning. */
  readonly morph: 'before' | 'offset' | 'after' | 'after normalising' | 'after, positions only';
  readonly normals: 'inverse transpose' | 'matrix' | 'inverse' | 'as positions' | 'with translation';
  readonly isNormalised: boolean;
  /** Added to the joint of each attachment; joints that are not there are clamped, wrapped around or left out. */
  readonly joint: { readonly shift: number; readonly beyond: 'clamped' | 'wrapped' | 'left out' };
}

/** A program by its rules. */
export interface Program {
  readonly curves: CurveRules;
  readonly joints: JointRules;
  readonly skin: SkinRules;
}

/** Numbers that are computed of a frame. */
export interface Wanted {
  readonly local: boolean;
  readonly vertices: boolean;
  readonly normals: boolean;
}

/** The program without mistakes. */
export const RIGHT_PROGRAM: Program = {
  curves: RIGHT_CURVES,
  joints: {
    signs: { are: [1, 1, 1, 1], for: 'all' },
    transposed: 'none',
    angles: { factor: 1, at: 'joint', for: 'all' },
    offset: 'before',
    root: 'moves',
    hasLimits: true,
    pose: 'given',
    breadthFirst: { of: 'none', isInverse: false },
    dofOrder: { isReversed: false, for: 'balls', withRoot: false },
    concatenation: 'parent first',
    world: [],
    bvhDegrees: false,
    bvhPositions: 'given',
    bvhOrder: 'listed',
  },
  skin: {
    binding: 'inverse',
    bindingRows: false,
    attachments: 'all',
    weights: 'given',
    bind: 'moved',
    morph: 'before',
    normals: 'inverse transpose',
    isNormalised: true,
    joint: { shift: 0, beyond: 'clamped' },
  },
};
