/** Re-solves all pins with restarts, on request. */

import { currentTargets } from '../../../evaluate/ik/drag/current-targets.ts';
import { resolvePins } from '../../../evaluate/ik/drag/re-solve.ts';
import { ikOf } from '../../../evaluate/ik/set-up.ts';
import type { Character } from '../../../model/document.ts';
import { jointName } from '../../../model/skeleton/joint-name.ts';
import { attempt } from '../../state/actions/attempt.ts';
import { addKeyed } from '../../state/add-keys.ts';
import { pausePlayback } from '../../state/pause-playback.ts';
import type { Workbench } from '../../state/workbench.ts';
import { autoKey, posingCommand } from '../posing/pose-edits.ts';
import { gapText } from './gap-text.ts';

/** One undo step; reports if nothing better was found. */
export function solvePins(wb: Workbench, character: Character): void {
  const { id, skeleton } = character;
  const setup = ikOf(character);
  pausePlayback(wb);
  const facts = wb.viewport.character(id);
  if (!skeleton || !facts || setup.pins.length === 0) return;
  const { targets } = wb.posing.ik;
  const held = currentTargets(targets, id, setup, facts.dofs, facts.worlds);
  const { changes, missed, hindrance } = resolvePins(character, skeleton, facts.dofs, held);
  const { timeSeconds } = wb.transport.get();
  if (changes.length) {
    const command = { ...posingCommand(wb), label: () => `Re-solve pins of ${character.name}` };
    attempt(wb.messages, () => {
      addKeyed(wb, command, { characterId: id, dofs: changes, timeSeconds, key: autoKey(wb) });
      const after = wb.viewport.character(id);
      if (after) targets.leave(id, setup, after.dofs, held, hindrance);
    });
  }
  if (missed !== undefined) {
    wb.messages.note(
      `${jointName(character.skeleton, missed)} is as close as possible: ${gapText(character, missed, hindrance)}.`,
    );
  } else if (!changes.length) wb.messages.note('All pins are reached.');
  wb.viewport.requestRender();
}
