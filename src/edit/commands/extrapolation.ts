/** Extrapolation of channels before their first key and after their last. */
import { EXTRAPOLATIONS, type Extrapolation } from '../../model/clip.ts';
import { oneOf } from '../arguments.ts';
import { checkedChannels, clipOf, keyable, type OfChannels, withClipChannels } from '../channel-edits.ts';
import { TANGENT_SIDES, type TangentSide } from '../keys/tangents.ts';
import { curvesIn } from '../step-names.ts';
import type { Command } from '../store.ts';

/** Names for labels. */
export const EXTRAPOLATION_NAMES: Readonly<Record<Extrapolation, string>> = {
  constant: 'Constant',
  linear: 'Linear',
  cycle: 'Cycle',
  cycle_offset: 'Cycle with offset',
  bounce: 'Bounce',
};
const WHERE: Readonly<Record<TangentSide, string>> = { in: 'before', out: 'after', both: 'before and after' };

export interface SetExtrapolation extends OfChannels {
  readonly side: TangentSide;
  readonly extrapolation: Extrapolation;
}

/** Keys and their selection are unchanged. Sampled channels hold their ends and are skipped. */
export const setExtrapolation: Command<SetExtrapolation> = {
  id: 'channels.setExtrapolation',
  label: (document, { characterId, channels, side, extrapolation }) =>
    `Set ${curvesIn(document, characterId, channels)} to ${EXTRAPOLATION_NAMES[extrapolation].toLowerCase()} ${WHERE[side]}`,
  run(document, { characterId, channels, side, extrapolation }) {
    oneOf(side, TANGENT_SIDES, '"side"');
    oneOf(extrapolation, EXTRAPOLATIONS, '"extrapolation"');
    const clip = clipOf(document, characterId);
    const changed = [...clip.channels];
    for (const index of keyable(clip, checkedChannels(clip, channels))) {
      const channel = changed[index];
      const extrapolateIn = side === 'out' ? channel.extrapolateIn : extrapolation;
      const extrapolateOut = side === 'in' ? channel.extrapolateOut : extrapolation;
      if (extrapolateIn === channel.extrapolateIn && extrapolateOut === channel.extrapolateOut) continue;
      changed[index] = { ...channel, extrapolateIn, extrapolateOut };
    }
    return withClipChannels(document, characterId, changed);
  },
};
