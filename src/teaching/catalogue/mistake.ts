import type { CurveRules } from '../program/curve-rules.ts';
import type { JointRules, Program, SkinRules } from '../program/program.ts';

/** The lecture that a mistake is about. */
export type Subject = 'kinematics' | 'skinning' | 'channels';

/** A mistake that programs make: one record for the search, the sentences and the test files. */
export interface Mistake {
  /** Stable: scripts and teachers rely on it. */
  readonly code: string;
  readonly subject: Subject;
  /** A sentence that says what was done and what should be done instead. */
  sentence(detail: string): string;
  /** As in the lecture or the assignment: how it should be. */
  readonly formula: string;
  /** The ways to make it; at least one. */
  readonly variants: readonly Variant[];
}

/** One way to make a mistake. */
export interface Variant {
  /** The exact deviation, for people: "Rx·Ry·Rz instead of Rz·Ry·Rx"; empty if there is only one way. */
  readonly detail: string;
  /** The program with the mistake; how wrong numbers are made. */
  apply(program: Program): Program;
  /** A finer form of a variant before it: not worth naming beside it where both explain the same. */
  readonly isFiner?: true;
}

/** The variant, marked as a finer form of one before it. */
export function finer(variant: Variant): Variant {
  return { ...variant, isFiner: true };
}

/** A variant that changes rules of joints. */
export function inJoints(detail: string, rules: Partial<JointRules>): Variant {
  return { detail, apply: (program) => ({ ...program, joints: { ...program.joints, ...rules } }) };
}

/** A variant that changes rules of skinning. */
export function inSkin(detail: string, rules: Partial<SkinRules>): Variant {
  return { detail, apply: (program) => ({ ...program, skin: { ...program.skin, ...rules } }) };
}

/** A variant that changes rules of channels. */
export function inCurves(detail: string, rules: Partial<CurveRules>): Variant {
  return { detail, apply: (program) => ({ ...program, curves: { ...program.curves, ...rules } }) };
}
