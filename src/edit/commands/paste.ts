/** Pastes copied keys (`keys/clipboard.ts`) and selects them. Refused if one would land in samples. */
import { FIXED_TANGENT, TANGENT_KINDS, type Tangents } from '../../model/clip.ts';
import { finiteNumber, listOf, oneOf } from '../arguments.ts';
import { clipOf, requireKeyable, withClipChannels } from '../channel-edits.ts';
import { checkPlacing } from '../check-placing.ts';
import { type CopiedKeys, PASTE_MODES, type Paste, withKeysPasted } from '../keys/clipboard.ts';
import { characterIn } from '../step-names.ts';
import { type Command, CommandError, type Edit } from '../store.ts';

export interface PasteKeys extends Paste {
  readonly characterId: string;
  readonly copied: CopiedKeys;
}

export const pasteKeys: Command<PasteKeys, Edit> = {
  id: 'keys.paste',
  label(document, { characterId, copied }) {
    const count = copied.channels.reduce((sum, c) => sum + c.times.length, 0);
    return `Paste ${count === 1 ? '1 key' : `${count} keys`} on ${characterIn(document, characterId)}`;
  },
  run(document, { characterId, copied, timeSeconds, into, mode, outsideCycle, bakedRange }) {
    const clip = clipOf(document, characterId);
    checkCopied(copied);
    finiteNumber(timeSeconds, '"timeSeconds"');
    oneOf(mode, PASTE_MODES, '"mode"');
    checkPlacing({ outsideCycle, bakedRange });
    if (into !== undefined) listOf(into, '"into"');
    const { channels, keys } = withKeysPasted(clip, copied, {
      timeSeconds,
      into,
      mode,
      outsideCycle,
      bakedRange,
    });
    requireKeyable(
      clip,
      keys.map((k) => k.channel),
    );
    return { document: withClipChannels(document, characterId, channels), keys };
  },
};

/** Data from the console may not be copied keys. */
function checkCopied(copied: CopiedKeys): void {
  // Deliberately looser than its type.
  const given: { seconds?: unknown; channels?: unknown } = copied ?? {};
  if (finiteNumber(given.seconds, 'The length of "copied"') < 0)
    throw new CommandError('"copied" must last 0 s or more.');
  const channels = listOf(given.channels, 'The channels of "copied"');
  if (channels.length === 0) throw new CommandError('There is nothing to paste. Copy keys first.');
  for (const { times, values, tangentsIn, tangentsOut } of copied.channels) {
    const columns = [times, values, tangentsIn?.slopes, tangentsOut?.slopes];
    const count = times?.length;
    const fit =
      count > 0 &&
      columns.every((c) => c instanceof Float64Array && c.length === count && c.every(Number.isFinite)) &&
      [tangentsIn, tangentsOut].every((tangents) => areTangents(tangents, count)) &&
      times.every((t, k) => k === 0 || t >= times[k - 1]);
    if (!fit) throw new CommandError('"copied" must be the result of copying: columns of keys of equal length.');
  }
}

/** Slopes are numbers of fixed tangents only. */
function areTangents({ kinds, slopes }: Tangents, count: number): boolean {
  if (!(kinds instanceof Uint8Array) || kinds.length !== count) return false;
  return kinds.every((kind, k) => kind < TANGENT_KINDS.length && (kind === FIXED_TANGENT || slopes[k] === 0));
}
