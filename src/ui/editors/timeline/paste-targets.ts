/**
 * The channels that copied keys are pasted into. Keys are never pasted into unlisted channels: if the channels they
 * were copied from aren't listed, listed ones with the same DOFs get them, whether or not they have keys.
 */
import type { CopiedKeys } from '../../../edit/keys/clipboard.ts';
import type { Character } from '../../../model/document.ts';
import type { Uses } from '../../state/workbench.ts';
import { namedChannel } from './channels.ts';
import { listedOfAll, viewOfAll } from './listed-of-all.ts';

/**
 * The listed channels that aren't hidden, including those without keys, in the numbers of all. Everything in the dope
 * sheet, which lists them all.
 */
export function pastableChannels(wb: Uses<'store' | 'timeline'>): readonly number[] {
  const { tab, list } = wb.timeline.view.get();
  const listed = listedOfAll(wb, tab === 'dope' ? 'all' : list).map(({ channel }) => channel);
  if (tab === 'dope') return listed;
  const { isolated, hidden } = viewOfAll(wb);
  const shown = isolated ? listed.filter((channel) => isolated.includes(channel)) : [];
  return shown.length ? shown : listed.filter((channel) => !hidden.includes(channel));
}

/**
 * One channel for each that keys were copied from, in their order; undefined if some have none.
 * @param listed as `pastableChannels` returns them
 */
export function pasteTargets(
  character: Character,
  { channels }: CopiedKeys,
  listed: readonly number[],
): readonly number[] | undefined {
  const from = channels.map(({ channel }) => channel);
  if (from.every((channel) => listed.includes(channel))) return from;
  const nameOf = (channel: number) => namedChannel(character, channel).dof;
  const targets = from.flatMap((channel) => {
    const alike = listed.filter((one) => nameOf(one) === nameOf(channel));
    return alike.length === 1 ? alike : [];
  });
  if (targets.length !== from.length || new Set(targets).size !== from.length) return undefined;
  return targets;
}
