/** Extrapolation of channels before their first key and after their last. */

import type { Extrapolation } from '../../model/takes/take.ts';
import type { Change } from '../change.ts';
import { checkedChannels, editedChannels, keyable, takeOf } from '../channel-edits.ts';
import { command } from '../command.ts';
import type { TangentSide } from '../keys/tangents.ts';
import { CHANNELS, extrapolation, side } from '../schema/shared-shapes.ts';
import { curvesIn } from '../step-names.ts';

/** Names for labels. */
export const EXTRAPOLATION_NAMES: Readonly<Record<Extrapolation, string>> = {
  constant: 'Constant',
  linear: 'Linear',
  cycle: 'Cycle',
  cycle_offset: 'Cycle with offset',
  bounce: 'Bounce',
};
const WHERE: Readonly<Record<TangentSide, string>> = { in: 'before', out: 'after', both: 'before and after' };

/** Keys and their selection are unchanged. Sampled channels hold their ends and are skipped. */
export const setExtrapolation = command({
  id: 'channels.setExtrapolation',
  args: { ...CHANNELS, side, extrapolation },
  label: (document, { characterId, channels, side, extrapolation }) =>
    `Set ${curvesIn(document, characterId, channels)} to ${EXTRAPOLATION_NAMES[extrapolation].toLowerCase()} ${WHERE[side]}`,
  run(document, { characterId, channels, side, extrapolation }): Change {
    const take = takeOf(document, characterId);
    const changed = [...take.channels];
    for (const index of keyable(take, checkedChannels(take, channels))) {
      const channel = changed[index];
      const extrapolateIn = side === 'out' ? channel.extrapolateIn : extrapolation;
      const extrapolateOut = side === 'in' ? channel.extrapolateOut : extrapolation;
      if (extrapolateIn === channel.extrapolateIn && extrapolateOut === channel.extrapolateOut) continue;
      changed[index] = { ...channel, extrapolateIn, extrapolateOut };
    }
    const { keys: _asBefore, ...change } = editedChannels(document, characterId, changed, []);
    return change;
  },
});
