/**
 * A new key beyond the ends lengthens a cycle. That may be intended, but shouldn't go unnoticed: any step that does so
 * is reported once, at its end.
 */
import { changedCycles } from '../../../edit/keys/cycle.ts';
import type { ChannelClip } from '../../../model/clip.ts';
import { type Character, findCharacter, shownClip } from '../../../model/document.ts';
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
  // Another take is shown: nothing to compare.
  if (was.shownClip !== now.shownClip || was.clips.length !== now.clips.length) return undefined;
  // With other DOFs, channels move with their keys.
  if (was.skeleton !== now.skeleton || was.morphs !== now.morphs) return undefined;
  const [before, after] = [shownClip(was), shownClip(now)];
  if (!before || !after || before === after) return undefined;
  return periodNote(before, after, (c) => channelName(namedChannel(now, c)));
}

/** A sentence about channels whose period has changed; undefined if there are none. */
export function periodNote(before: ChannelClip, after: ChannelClip, name: (channel: number) => string) {
  const changed = changedCycles(before, after);
  if (!changed.length) return undefined;
  const [{ channel, from, to }] = changed;
  const which =
    changed.length === 1 ? name(channel) : `${plural(changed.length, 'channel')}, including ${name(channel)},`;
  const verb = changed.length === 1 ? 'repeats' : 'repeat';
  return `${which} now ${verb} every ${shown(to)} s instead of every ${shown(from)} s.`;
}
