/** How pins adapt to DOFs set by slider, number or ring: `BesidePins` for the page's current state. */

import { BesidePins } from '../../../evaluate/ik/drag/beside-pins.ts';
import { currentTargets } from '../../../evaluate/ik/drag/current-targets.ts';
import { limbOf } from '../../../evaluate/ik/limb.ts';
import { ikOf, pinTargets } from '../../../evaluate/ik/set-up.ts';
import { findCharacter } from '../../../model/document.ts';
import type { Pin } from '../../../model/ik.ts';
import { jointDofCount, rootDofCount } from '../../../model/skeleton/dofs.ts';
import type { BesideDofs } from '../../state/posing.ts';
import type { Uses } from '../../state/workbench.ts';
import { standStillToPose } from '../posing/pose-edits.ts';
import { reachOfDrag } from './reach.ts';

/** Feet that hold by themselves while the body is moved by a handle. */
export interface Standing {
  readonly characterId: string;
  readonly placement: number;
  readonly feet: readonly Pin[];
}

/**
 * Undefined if nothing that holds constrains those DOFs.
 *
 * @param joint the one whose handle is dragged, if any
 * @param show told the feet that hold by themselves; undefined when that is over
 */
export function besidePins(
  wb: Uses<'store' | 'viewport' | 'transport' | 'timeline' | 'posing' | 'settings'>,
  characterId: string,
  dofs: readonly number[],
  joint?: number,
  show: (standing: Standing | undefined) => void = () => {},
): BesideDofs | undefined {
  const character = findCharacter(wb.store.document, characterId);
  const skeleton = character?.skeleton;
  if (!skeleton) return undefined;
  const carries = joint !== undefined && limbOf(skeleton, joint) === 'body';
  if (ikOf(character).pins.length === 0 && !carries) return undefined;
  const count = rootDofCount(skeleton) + jointDofCount(skeleton);
  if (dofs.length === 0 || dofs.some((dof) => dof >= count)) return undefined;
  const placement = wb.viewport.pickedCopy(character);
  const before = wb.viewport.character(characterId);
  const toWorld = wb.viewport.placementOf(characterId, placement);
  const feet =
    carries && before && toWorld?.length === 16
      ? reachOfDrag(wb, character, skeleton, before.worlds, toWorld, joint).standing
      : [];
  if (ikOf(character).pins.length + feet.length === 0) return undefined;
  // The others change too.
  standStillToPose(wb, character);
  const facts = wb.viewport.character(characterId);
  if (!facts) return undefined;
  const { targets } = wb.posing.ik;
  const setup = ikOf(character);
  const own = currentTargets(targets, characterId, setup, facts.dofs, facts.worlds);
  const held = new Map([...own, ...pinTargets({ pins: feet }, facts.worlds)]);
  const beside = new BesidePins(character, skeleton, dofs, facts.dofs, held, feet);
  show(feet.length > 0 ? { characterId, placement, feet } : undefined);
  return {
    at: (values) => beside.at(values),
    shown() {
      const now = wb.viewport.character(characterId);
      if (now && beside.hindrance) targets.leave(characterId, setup, now.dofs, own, beside.hindrance);
    },
    over: () => show(undefined),
  };
}
