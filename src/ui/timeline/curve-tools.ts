/** Tools for whole curves that need nothing asked: they act on the channels in hand, and say what they did. */
import { eulerFilter, eulerFilterPreview, makeLoop } from '../../edit/commands/channels.ts';
import { plural } from '../number-text.ts';
import type { Workbench } from '../workbench.ts';
import { aboutKeysInHand, channelsInHand, takeInHand } from './in-hand.ts';
import { period } from './period.ts';

export function runCurveTool(wb: Workbench, tool: 'euler' | 'loop'): void {
  const take = takeInHand(wb);
  const channels = channelsInHand(wb).filter((c) => take?.clip.channels[c]?.times.length);
  if (!take || !channels.length) return;
  const args = { characterId: take.character.id, channels };
  if (tool === 'loop') {
    // What goes on from where it ends, as a root that travels does, shall still do so.
    const keepOffset = channels.filter((c) => {
      const { extrapolateIn, extrapolateOut } = take.clip.channels[c];
      return extrapolateIn === 'cycle_offset' || extrapolateOut === 'cycle_offset';
    });
    wb.store.apply(aboutKeysInHand(wb, makeLoop), { ...args, keepOffset });
    const standStill = channels.every((c) => period(take.clip.channels[c]) === 0);
    const nothing = standStill ? 'A loop takes two keys, at two times.' : 'These curves loop already.';
    wb.messages.note(changedText(wb, take.clip.channels, 'now loop', nothing));
    return;
  }
  const { notes } = eulerFilterPreview(wb.store.document, args);
  wb.store.apply(aboutKeysInHand(wb, eulerFilter), args);
  const text = changedText(wb, take.clip.channels, 'filtered', 'Nothing to filter: no angle jumps.');
  wb.messages.note([text, ...notes].join(' '));
}

function changedText(wb: Workbench, before: readonly unknown[], done: string, nothing: string): string {
  const after = takeInHand(wb)?.clip.channels ?? [];
  const count = after.filter((channel, i) => channel !== before[i]).length;
  return count ? `${plural(count, 'curve')} ${done}.` : nothing;
}
