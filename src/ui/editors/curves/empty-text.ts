/** What stands in the plot while there is no curve in it: what would make one. */
import { spanOfChannel } from '../../../model/clip.ts';
import { shown } from '../../kit/number-text.ts';
import { currentCharacter } from '../../state/action.ts';
import type { Workbench } from '../../state/workbench.ts';
import { takeInHand } from '../timeline/in-hand.ts';

export function emptyPlotText(wb: Workbench, listed: number): string {
  const character = currentCharacter(wb);
  if (!character)
    return 'Curves will stand here. Drop a character and its animation anywhere on the page, or choose Open.';
  if (character.driver && !listed) {
    return `The keys of ${character.name} stand aside. What moves it has its own: those of ${character.driver.source.name}.`;
  }
  const take = takeInHand(wb);
  const at = `${shown(wb.transport.get().timeSeconds, 3)} s`;
  const keyed = take?.clip.channels.some((_, c) => spanOfChannel(take.clip, c)) ?? false;
  if (!keyed) {
    return `${character.name} has no animation. K keys the whole pose at ${at}, Shift+K the selected joint; or drop an .anim file.`;
  }
  const { list, hidden, filter } = wb.timeline.view.get();
  if (!listed) {
    if (filter.trim()) return `No channel is called “${filter.trim()}”.`;
    return list === 'pinned' ? 'Nothing is pinned. The pin in a channel’s row keeps it here.' : 'No channel is listed.';
  }
  if (hidden.length)
    return 'What is listed is hidden. The eye in a channel’s row shows it again, Alt+H shows everything.';
  return `Nothing listed has keys yet. Shift+K keys the selected joint at ${at}.`;
}
