/** How pins adapt to a DOF set by slider or number: `BesidePins` for the page's current state. */
import { BesidePins } from '../../../evaluate/ik/drag/beside-pins.ts';
import { ikOf } from '../../../evaluate/ik/set-up.ts';
import { findCharacter } from '../../../model/document.ts';
import { jointDofCount, rootDofCount } from '../../../model/dofs.ts';
import type { BesideDof } from '../../state/posing.ts';
import type { Uses } from '../../state/workbench.ts';
import { standStillToPose } from '../posing/pose-edits.ts';

/** Undefined if no pin constrains that DOF. */
export function besidePins(
  wb: Uses<'store' | 'viewport' | 'transport' | 'timeline' | 'posing' | 'settings'>,
  characterId: string,
  dof: number,
): BesideDof | undefined {
  const character = findCharacter(wb.store.document, characterId);
  if (!character?.skeleton || ikOf(character).pins.length === 0) return undefined;
  if (dof >= rootDofCount(character.skeleton) + jointDofCount(character.skeleton)) return undefined;
  // The others change too.
  standStillToPose(wb, character);
  const facts = wb.viewport.character(characterId);
  if (!facts) return undefined;
  const { targets } = wb.posing.ik;
  const setup = ikOf(character);
  const held = targets.targetsOf(characterId, setup, facts.dofs, facts.worlds);
  const beside = new BesidePins(character, character.skeleton, dof, facts.dofs, held);
  return {
    at: (value) => beside.at(value),
    shown() {
      const now = wb.viewport.character(characterId);
      if (now && beside.hindrance) targets.leave(characterId, setup, now.dofs, held, beside.hindrance);
    },
  };
}
