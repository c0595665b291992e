/**
 * Targets of pins. The document does not store them: a pin's target is its point's position in the pose shown. Only if
 * a drag leaves a gap is the target elsewhere, and it is kept as long as the pose is unchanged; once time, a slider or
 * undo changes the pose, pins hold where they are.
 */
import { sameNumbers } from '../../../math/same-numbers.ts';
import type { IkSetup, Pin } from '../../../model/ik.ts';
import type { PinTarget } from '../set-up.ts';
import type { Hindrance } from './hindrance.ts';

/** State left by a drag. */
export interface Left {
  /** The character's DOFs as shown then. */
  readonly dofs: Float64Array;
  /** By pin id. */
  readonly targets: ReadonlyMap<number, LeftTarget>;
  /** Causes that kept the pins from their targets. */
  readonly hindrance: Hindrance;
}

/** The target that a drag left a pin with, where its point did not get. */
export interface LeftTarget {
  /** The pin at that time. */
  readonly pin: Pin;
  readonly target: PinTarget;
}

/** Targets of pins that differ from their points' positions, by character, until its pose changes. */
export class HeldTargets {
  /** By character id. */
  private readonly left = new Map<string, Left>();

  /** Targets that a drag left, if the pose is still the same. Called every frame; allocates nothing. */
  leftOf(characterId: string, dofs: Float64Array): Left | undefined {
    const left = this.left.get(characterId);
    return left && sameNumbers(left.dofs, dofs) ? left : undefined;
  }

  /** Records the end of a drag. @param dofs as shown after it; copied */
  leave(
    characterId: string,
    { pins }: Pick<IkSetup, 'pins'>,
    dofs: Float64Array,
    targets: ReadonlyMap<number, PinTarget>,
    hindrance: Hindrance,
  ): void {
    const kept = new Map<number, LeftTarget>();
    for (const pin of pins) {
      const target = targets.get(pin.id);
      if (target) kept.set(pin.id, { pin, target });
    }
    this.left.set(characterId, { dofs: dofs.slice(), targets: kept, hindrance });
  }

  /** The target that a drag left for a pin, if pose and pin are unchanged. */
  leftTarget(left: Left | undefined, pin: Pin): PinTarget | undefined {
    const before = left?.targets.get(pin.id);
    return before && isSamePoint(before.pin, pin) ? before.target : undefined;
  }

  /** Forgets removed characters. */
  keepOnly(characterIds: ReadonlySet<string>): void {
    for (const id of this.left.keys()) if (!characterIds.has(id)) this.left.delete(id);
  }
}

/** Whether both hold the same thing, whatever their weights. */
function isSamePoint(a: Pin, b: Pin): boolean {
  return (
    a === b ||
    (a.joint === b.joint &&
      a.holdsOrientation === b.holdsOrientation &&
      a.point.every((part, k) => part === b.point[k]))
  );
}
