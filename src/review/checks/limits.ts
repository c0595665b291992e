/**
 * Joints beyond what they can do: a DOF more than 1° or 1 mm beyond the limits that its skeleton states; and an elbow
 * or a knee folded by more than 165°, so that its bones pass through each other.
 */
import { characterDofs } from '../../model/skeleton/dofs.ts';
import { perSkeleton } from '../../model/skeleton/per-skeleton.ts';
import { type DofUnit, isUnlimited } from '../../model/skeleton/skeleton.ts';
import type { Flag } from '../flags.ts';
import type { TakeFrames } from '../frames.ts';
import type { Hinge, Survey } from '../survey.ts';
import { type Check, flagOf, largest, Span } from './check.ts';

/** Radians, or lengths in metres. */
const BEYOND_ANGLE = Math.PI / 180;
const BEYOND_LENGTH = 0.001;
const FOLDED = (165 * Math.PI) / 180;
const SHORTEST = 0.03;

interface LimitedDof {
  readonly dof: number;
  readonly joint: number;
  readonly min: number;
  readonly max: number;
  readonly unit: DofUnit;
}

/** Cached. */
const limitedDofs = perSkeleton((skeleton): readonly LimitedDof[] =>
  characterDofs(skeleton, []).flatMap(({ joint, limit, takesLimits, unit }, dof) => {
    const { min, max } = limit;
    return !takesLimits || min > max || isUnlimited(limit) ? [] : [{ dof, joint, min, max, unit }];
  }),
);

interface Limited extends LimitedDof {
  /** How far beyond counts. */
  readonly least: number;
  readonly span: Span;
}

export class Limits implements Check {
  private readonly limited: readonly Limited[];
  private readonly hinges: readonly { readonly hinge: Hinge; readonly span: Span }[];
  private readonly flags: Flag[] = [];

  /** @param metres per unit of the file */
  constructor(
    private readonly frames: TakeFrames,
    { hinges }: Survey,
    metres: number,
  ) {
    this.hinges = hinges.map((hinge) => ({ hinge, span: new Span(1) }));
    this.limited = limitedDofs(frames.skeleton).map((limited) => ({
      ...limited,
      least: limited.unit === 'length' ? BEYOND_LENGTH / metres : BEYOND_ANGLE,
      span: new Span(1),
    }));
  }

  frame(frame: number, points: Float64Array, dofs: Float64Array): void {
    for (const each of this.limited) {
      const beyond = Math.max(each.min - dofs[each.dof], dofs[each.dof] - each.max);
      if (beyond > each.least) each.span.add(frame, beyond);
      else if (each.span.isOver(frame)) this.close(each.span, each.joint, 0);
    }
    for (const { hinge, span } of this.hinges) {
      const folded = foldOf(points, hinge);
      if (folded > FOLDED) span.add(frame, folded);
      else if (span.isOver(frame)) this.close(span, hinge.middle, SHORTEST);
    }
  }

  private close(span: Span, joint: number, shortest: number): void {
    const { frames } = this;
    if (span.isOpen && span.length * frames.frameSeconds >= shortest) {
      this.flags.push(flagOf(frames, 'limit', span.start, span.end, span.amount, joint));
    }
    span.clear();
  }

  end(): readonly Flag[] {
    for (const { span, joint } of this.limited) this.close(span, joint, 0);
    for (const { span, hinge } of this.hinges) this.close(span, hinge.middle, SHORTEST);
    return largest(this.flags);
  }
}

/** The angle between both bones of a hinge: 0 stretched, π folded flat. */
function foldOf(points: Float64Array, { upper, middle, lower }: Hinge): number {
  let dot = 0;
  let aa = 0;
  let bb = 0;
  for (let k = 0; k < 3; k++) {
    const a = points[3 * middle + k] - points[3 * upper + k];
    const b = points[3 * lower + k] - points[3 * middle + k];
    dot += a * b;
    aa += a * a;
    bb += b * b;
  }
  return Math.acos(Math.max(-1, Math.min(1, dot / (Math.sqrt(aa * bb) || 1))));
}
