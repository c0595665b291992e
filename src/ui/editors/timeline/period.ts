/**
 * A new key beyond the ends lengthens a cycle, and one at an end of a closed cycle changes its other end too. That may
 * be intended, but shouldn't go unnoticed: any step that does so is reported once, at its end.
 */
import { cutName, SHORT_NAME } from '../../../edit/cut-name.ts';
import { changedCyclesOf, keyedEndsOf } from '../../../edit/keys/cycle.ts';
import { type Character, findCharacter } from '../../../model/document.ts';
import type { Uses } from '../../state/workbench.ts';
import { plural, shown } from '../../widgets/numbers/number-text.ts';
import { channelName, namedChannel } from './channels.ts';

/** Watches steps until ended. Undo isn't reported: it restores what was there. */
export function followPeriods({ store, messages }: Uses<'store' | 'messages'>): () => void {
  return store.onStep(({ document }, { document: before }, { done }) => {
    const all = document.characters.flatMap((character) => {
      const was = findCharacter(before, character.id);
      const text =
        was && was !== character && [changedPeriods(was, character), keyedEnds(was, character)].join(' ').trim();
      return text ? { name: character.name, text } : [];
    });
    const texts = all.map(({ name, text }) => (all.length > 1 ? `${cutName(name, SHORT_NAME)}: ${text}` : text));
    if (texts.length > 0) messages.note([...(done ? [done] : []), ...texts].join(' '));
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

/** Of cycles that stay closed. */
function keyedEnds(was: Character, now: Character): string | undefined {
  const ends = keyedEndsOf(was, now);
  if (!ends.length) return undefined;
  const name = channelName(namedChannel(now, ends[0]));
  if (ends.length === 1) return `First and last key of the cycle of ${name} changed together.`;
  return `First and last key of ${ends.length} cycles, including ${name}, changed together.`;
}
