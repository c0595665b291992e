/** Text of an empty plot: how to get curves. */
import { activeLayer } from '../../../model/takes/layers.ts';
import { spanOfChannel } from '../../../model/takes/take.ts';
import { currentCharacter } from '../../state/actions/action.ts';
import type { Uses } from '../../state/workbench.ts';
import { shown } from '../../widgets/numbers/number-text.ts';
import { touchWords } from '../../widgets/touch-words.ts';
import { currentTake } from '../timeline/current-take.ts';
import { viewOfAll } from '../timeline/listed-of-all.ts';

export function emptyPlotText(wb: Uses<'store' | 'transport' | 'timeline'>, listed: number): string {
  return touchWords(emptyText(wb, listed));
}

function emptyText(wb: Uses<'store' | 'transport' | 'timeline'>, listed: number): string {
  const character = currentCharacter(wb);
  if (!character) return 'No curves yet. Drop a character and its animation here or choose Open.';
  if (character.driver && !listed) {
    return `${character.name} is retargeted from ${character.driver.source.name}, so its own keys are hidden. Bake the retargeting to edit it here.`;
  }
  const current = currentTake(wb);
  const at = `${shown(wb.transport.get().timeSeconds)} s`;
  const layer = current && activeLayer(current.take);
  if (layer && listed) {
    return `Layer “${layer.name}” has no keys of these channels yet; the motion below is faint. Pose a joint and press K to key it at ${at}.`;
  }
  const keyed = current?.take.channels.some((_, c) => spanOfChannel(current.take, c)) ?? false;
  if (!keyed && !character.skeleton && character.morphs.length === 0) {
    return `${character.name} has no skeleton, so there is nothing to animate. Drop its .skel file here.`;
  }
  if (!keyed) {
    const what = current ? `The take ${current.take.name} has no keys` : `${character.name} has no animation`;
    return `${what}. Rotate a joint and press K to key it at ${at} or Shift+K to key the whole pose, or drop an .anim file.`;
  }
  const { list, filter } = wb.timeline.view.get();
  const { hidden } = viewOfAll(wb);
  if (!listed) {
    if (filter.trim()) return `No channel matches “${filter.trim()}”.`;
    return list === 'pinned'
      ? 'No pinned channels. Click the pin in a channel’s row to keep it listed.'
      : 'No channels listed.';
  }
  if (hidden.length)
    return 'All listed channels are hidden. Click the eye in a channel’s row to show it, or press Alt+H to show all.';
  return `No listed channel has keys yet. Press K to key the selected joint at ${at}.`;
}
