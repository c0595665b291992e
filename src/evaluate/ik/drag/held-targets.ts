/**
 * Where pins hold. The document does not say: a pin holds where its point is in the pose that is shown. Only where a drag
 * has left a gap is its target elsewhere, and it stays there for as long as the pose is as the drag left it; once time,
 * a slider or undo has changed the pose, pins hold where they are.
 */
import type { Vec3 } from '../../../math/vec3.ts';
import type { IkSetup, Pin } from '../../../model/ik.ts';
import { type PinTarget, pinTarget } from '../set-up.ts';
import type { Hindrance } from './hindrance.ts';

/** What a drag has left. */
export interface Left {
  /** The character's DOFs as they were shown then. */
  readonly dofs: Float64Array;
  /** By the pin's id. */
  readonly targets: ReadonlyMap<number, LeftTarget>;
  /** What kept the pins from where they should be. */
  readonly hindrance: Hindrance;
}

export interface LeftTarget {
  /** The pin as it was. */
  readonly pin: Pin;
  readonly target: PinTarget;
}

export class HeldTargets {
  /** By the character's id. */
  private readonly left = new Map<string, Left>();

  /** What a drag left, if the pose is still that. Allocates nothing: it is asked before every picture. */
  leftOf(characterId: string, dofs: Float64Array): Left | undefined {
    const left = this.left.get(characterId);
    return left && sameNumbers(left.dofs, dofs) ? left : undefined;
  }

  /** A drag is over. @param dofs as they are shown after it; copied */
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

  /** Where each pin is to hold from now on, by id. @param world as of `worldMatrices`, of the pose of `dofs` */
  targetsOf(
    characterId: string,
    { pins }: Pick<IkSetup, 'pins'>,
    dofs: Float64Array,
    world: Float64Array,
  ): Map<number, PinTarget> {
    const left = this.leftOf(characterId, dofs);
    return new Map(
      pins.map((pin) => {
        const before = left?.targets.get(pin.id);
        return [pin.id, before && isSamePoint(before.pin, pin) ? before.target : pinTarget(pin, world)];
      }),
    );
  }

  /** Where a drag has left a pin's target, if the pose and the pin are still as it left them. */
  leftTarget(left: Left | undefined, pin: Pin): Vec3 | undefined {
    const before = left?.targets.get(pin.id);
    return before && isSamePoint(before.pin, pin) ? before.target.position : undefined;
  }

  /** Of characters that are gone. */
  keepOnly(characterIds: ReadonlySet<string>): void {
    for (const id of this.left.keys()) if (!characterIds.has(id)) this.left.delete(id);
  }
}

/** Whether it holds the same thing, whatever its weight. */
function isSamePoint(a: Pin, b: Pin): boolean {
  return (
    a === b ||
    (a.joint === b.joint &&
      a.holdsOrientation === b.holdsOrientation &&
      a.point.every((part, k) => part === b.point[k]))
  );
}

function sameNumbers(a: Float64Array, b: Float64Array): boolean {
  if (a.length !== b.length) return false;
  for (let i = 0; i < a.length; i++) if (a[i] !== b[i]) return false;
  return true;
}
