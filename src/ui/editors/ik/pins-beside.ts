/** How pins adapt to DOFs set by slider, number or ring: `BesidePins` for the page's current state. */

import { BesidePins } from '../../../evaluate/ik/drag/beside-pins.ts';
import { currentTargets } from '../../../evaluate/ik/drag/current-targets.ts';
import { ikOf } from '../../../evaluate/ik/set-up.ts';
import { findCharacter } from '../../../model/document.ts';
import { jointDofCount, rootDofCount } from '../../../model/skeleton/dofs.ts';
import type { BesideDofs } from '../../state/posing.ts';
import type { Uses } from '../../state/workbench.ts';
import { standStillToPose } from '../posing/pose-edits.ts';

/** Undefined if no pin constrains those DOFs. */
export function besidePins(
  wb: Uses<'store' | 'viewport' | 'transport' | 'timeline' | 'posing' | 'settings'>,
  characterId: string,
  dofs: readonly number[],
): BesideDofs | undefined {
  const character = findCharacter(wb.store.document, characterId);
  if (!character?.skeleton || ikOf(character).pins.length === 0) return undefined;
  const count = rootDofCount(character.skeleton) + jointDofCount(character.skeleton);
  if (dofs.length === 0 || dofs.some((dof) => dof >= count)) return undefined;
  // The others change too.
  standStillToPose(wb, character);
  const facts = wb.viewport.character(characterId);
  if (!facts) return undefined;
  const { targets } = wb.posing.ik;
  const setup = ikOf(character);
  const held = currentTargets(targets, characterId, setup, facts.dofs, facts.worlds);
  const beside = new BesidePins(character, character.skeleton, dofs, facts.dofs, held);
  return {
    at: (values) => beside.at(values),
    shown() {
      const now = wb.viewport.character(characterId);
      if (now && beside.hindrance) targets.leave(characterId, setup, now.dofs, held, beside.hindrance);
    },
  };
}
