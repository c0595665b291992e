/** Pastes copied keys (`keys/clipboard.ts`) and selects them. Refused if one would land in samples. */

import type { Tangents } from '../../model/takes/take.ts';
import { FIXED_TANGENT, TANGENT_KINDS } from '../../model/takes/tangent-kinds.ts';
import { editedChannels, requireKeyable, takeOf } from '../channel-edits.ts';
import { command } from '../command.ts';
import { CommandError } from '../command-error.ts';
import { type CopiedKeys, PASTE_MODES, withKeysPasted } from '../keys/clipboard.ts';
import { bytes, doubles, index, list, number, oneOf, optional, record } from '../schema/shape.ts';
import { indices, NOW, PLACING } from '../schema/shared-shapes.ts';
import { characterIn } from '../step-names.ts';

const tangents = record({ kinds: bytes, slopes: doubles });
const copied = record({
  seconds: number,
  channels: list(
    record({ channel: index, times: doubles, values: doubles, tangentsIn: tangents, tangentsOut: tangents }),
  ),
});

/** Pastes copied keys at a time, into their own channels or those given by `into`, and selects them. */
export const pasteKeys = command({
  id: 'keys.paste',
  args: {
    ...NOW,
    copied,
    into: optional(indices),
    mode: oneOf(PASTE_MODES),
    ...PLACING,
  },
  label(document, { characterId, copied }) {
    const count = copied.channels.reduce((sum, c) => sum + c.times.length, 0);
    return `Paste ${count === 1 ? '1 key' : `${count} keys`} on ${characterIn(document, characterId)}`;
  },
  run(document, { characterId, copied, timeSeconds, into, mode, outsideCycle, bakedRange }) {
    const take = takeOf(document, characterId);
    checkCopied(copied);
    const { channels, keys } = withKeysPasted(take, copied, {
      timeSeconds,
      into,
      mode,
      outsideCycle,
      bakedRange,
    });
    requireKeyable(
      take,
      keys.map((k) => k.channel),
    );
    return editedChannels(document, characterId, channels, keys);
  },
});

/** Data from the console may not be copied keys. */
function checkCopied({ seconds, channels }: CopiedKeys): void {
  if (seconds < 0) throw new CommandError('"copied" must last 0 s or more.');
  if (channels.length === 0) throw new CommandError('There is nothing to paste. Copy keys first.');
  for (const { times, values, tangentsIn, tangentsOut } of channels) {
    const columns = [times, values, tangentsIn.slopes, tangentsOut.slopes];
    const count = times.length;
    const fit =
      count > 0 &&
      columns.every((c) => c.length === count) &&
      [tangentsIn, tangentsOut].every((tangents) => areTangents(tangents, count)) &&
      times.every((t, k) => k === 0 || t >= times[k - 1]);
    if (!fit) throw new CommandError('"copied" must be the result of copying: columns of keys of equal length.');
  }
}

/** Slopes are numbers of fixed tangents only. */
function areTangents({ kinds, slopes }: Tangents, count: number): boolean {
  if (kinds.length !== count) return false;
  return kinds.every((kind, k) => kind < TANGENT_KINDS.length && (kind === FIXED_TANGENT || slopes[k] === 0));
}
