/**
 * A new key beyond the ends lengthens a cycle. That may be intended, but shouldn't go unnoticed: any step that does so
 * is reported once, at its end.
 */
import { changedCyclesOf } from '../../../edit/keys/cycle.ts';
import { type Character, findCharacter } from '../../../model/document.ts';
import { plural, shown } from '../../kit/number-text.ts';
import type { Uses } from '../../state/workbench.ts';
import { channelName, namedChannel } from './channels.ts';

/** Watches steps until ended. Undo isn't reported: it restores what was there. */
export function followPeriods({ store, messages }: Uses<'store' | 'messages'>): () => void {
  return store.onStep(({ document }, { document: before }) => {
    for (const character of document.characters) {
      const was = findCharacter(before, character.id);
      const text = was && was !== character && changedPeriods(was, character);
      if (!text) continue;
      messages.note(text);
      return;
    }
  });
}

/** Changes of the shown take by a step. */
function changedPeriods(was: Character, now: Character): string | undefined {
  const changed = changedCyclesOf(was, now);
  if (!changed.length) return undefined;
  const [{ channel, from, to }] = changed;
  const name = channelName(namedChannel(now, channel));
  const which = changed.length === 1 ? name : `${plural(changed.length, 'channel')}, including ${name},`;
  const verb = changed.length === 1 ? 'repeats' : 'repeat';
  return `${which} now ${verb} every ${shown(to)} s instead of every ${shown(from)} s.`;
}
