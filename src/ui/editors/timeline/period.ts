/**
 * A new key past the ends lengthens what repeats. That is no mistake, but nobody should have to find it out: whatever
 * step does it, by whichever key, drag, field or dialog, it is said once, at the end of it.
 */
import { changedCycles } from '../../../edit/keys/cycle.ts';
import type { ChannelClip } from '../../../model/clip.ts';
import { type Character, findCharacter, shownClip } from '../../../model/document.ts';
import { plural, shown } from '../../kit/number-text.ts';
import type { Uses } from '../../state/workbench.ts';
import { channelName, namedChannel } from './channels.ts';

/** Watches the steps that are made until it is ended. What undo brings is what was there before: nothing is said of it. */
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

/** What a step did to the take that is shown before and after it. */
function changedPeriods(was: Character, now: Character): string | undefined {
  // Another take than before is none that was changed.
  if (was.shownClip !== now.shownClip || was.clips.length !== now.clips.length) return undefined;
  // Of other DOFs the channels stand elsewhere, and move there with their keys as they are.
  if (was.skeleton !== now.skeleton || was.morphs !== now.morphs) return undefined;
  const [before, after] = [shownClip(was), shownClip(now)];
  if (!before || !after || before === after) return undefined;
  return periodNote(before, after, (c) => channelName(namedChannel(now, c)));
}

/** A sentence about the channels whose repetition takes longer or shorter than before; undefined where none does. */
export function periodNote(before: ChannelClip, after: ChannelClip, name: (channel: number) => string) {
  const changed = changedCycles(before, after);
  if (!changed.length) return undefined;
  const [{ channel, from, to }] = changed;
  const which =
    changed.length === 1 ? name(channel) : `${plural(changed.length, 'channel')}, including ${name(channel)},`;
  const verb = changed.length === 1 ? 'repeats' : 'repeat';
  return `${which} now ${verb} every ${shown(to)} s instead of every ${shown(from)} s.`;
}
