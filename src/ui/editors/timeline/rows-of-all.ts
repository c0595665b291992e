/**
 * The rows of the dope sheet for all selected characters: a summary of all; then of each, in the order of the document, a
 * row with its name and its own rows.
 */
import { rangeOfSamples } from '../../../model/takes/samples.ts';
import type { TimelineView } from '../../state/timeline.ts';
import { type DopeRow, dopeRows } from './dope-rows.ts';
import { channelViewOf, type TimelinePart, type TimelineTake } from './timeline-take.ts';

export function rowsOfAll({ parts }: TimelineTake, view: TimelineView): DopeRow[] {
  const own = ({ character, take }: TimelinePart) => {
    const { unfolded } = channelViewOf(view, character.id);
    return dopeRows(character, take, { unfolded, all: view.allRows, filter: view.filter });
  };
  if (parts.length === 1) return own(parts[0]);
  const rows = parts.flatMap((part) => own(part).map((row) => rowOf(part, row)));
  if (rows.length === 0) return [];
  const channels = rows.flatMap((row) => (row.kind === 'character' ? row.channels : [])).sort((a, b) => a - b);
  return [{ key: 'summary', kind: 'summary', label: '', depth: 0, channels, expanded: false }, ...rows];
}

/** A row of one character among those of all; its summary has its name. */
function rowOf({ character, take, first }: TimelinePart, row: DopeRow): DopeRow {
  const { samples, channels } = take;
  const isSampled = first > 0 && samples && row.channels.some((c) => channels[c]?.kind === 'samples');
  const [from, to] = isSampled ? rangeOfSamples(samples) : [0, 0];
  const offset = character.timeOffsetSeconds;
  return {
    ...row,
    key: `${character.id}/${row.key}`,
    ...(row.kind === 'summary' && { kind: 'character', label: character.name }),
    channels: row.channels.map((c) => first + c),
    characterId: character.id,
    ...(isSampled && { sampled: [from - offset, to - offset] as const }),
  };
}
