/** Text of an empty dope sheet: how to get keys. */

import { spanOfChannel } from '../../../model/takes/take.ts';
import { currentCharacter } from '../../state/actions/action.ts';
import type { Uses } from '../../state/workbench.ts';
import { touchWords } from '../../widgets/touch-words.ts';
import type { CurrentTake } from '../timeline/current-take.ts';

export function emptyText(wb: Uses<'store' | 'timeline'>, current: CurrentTake | undefined): string {
  if (!wb.store.document.characters.length)
    return 'No keys yet. Drop a character and its animation here or choose Open.';
  const driven = current?.character.driver ?? currentCharacter(wb)?.driver;
  if (driven)
    return `Retargeted from ${driven.source.name}, so its own keys are hidden. Bake the retargeting to edit it here.`;
  const keyed = current?.take.channels.some((_, c) => spanOfChannel(current.take, c)) ?? false;
  const { filter } = wb.timeline.view.get();
  if (current && filter.trim() && keyed) return `No row with keys matches “${filter.trim()}”.`;
  return touchWords(
    'No keys yet. Rotate a joint and press K to key it or Shift+K to key the whole pose, or drop an .anim file.',
  );
}
