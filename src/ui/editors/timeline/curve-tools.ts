/** Curve tools without a dialog: they apply to the selected channels and report what they did. */
import type { OfChannels } from '../../../edit/channel-edits.ts';
import { eulerFilter, eulerFilterSteps, makeLoop } from '../../../edit/commands/channels.ts';
import { EditPreview } from '../../../edit/edit-preview.ts';
import { period } from '../../../edit/keys/cycle.ts';
import type { Uses } from '../../state/workbench.ts';
import { inSlices } from '../../widgets/in-slices.ts';
import { plural } from '../../widgets/numbers/number-text.ts';
import { dofsFor } from './channels.ts';
import { aboutKeysInHand, currentTake, ownChannelsToEdit } from './current-take.ts';

export function runCurveTool(wb: Uses<'store' | 'timeline' | 'messages'>, tool: 'euler' | 'loop'): void {
  const current = currentTake(wb);
  if (!current) return;
  const { character, take } = current;
  const keyed = ownChannelsToEdit(wb).filter((c) => take.channels[c]?.kind === 'keys');
  if (tool === 'euler') {
    const animated = ownChannelsToEdit(wb).filter((c) => take.channels[c] && take.channels[c].kind !== 'rest');
    // A root's translation needs no message that it isn't an angle.
    const angles = animated.filter((c) => dofsFor(character)[c]?.unit === 'angle');
    const channels = angles.length > 0 ? angles : animated;
    if (channels.length > 0) filterAngles(wb, { characterId: character.id, channels });
    return;
  }
  if (keyed.length === 0) return;
  wb.store.apply(aboutKeysInHand(wb, makeLoop), { characterId: character.id, channels: keyed });
  const after = currentTake(wb)?.take.channels ?? [];
  const count = after.filter((channel, i) => channel !== take.channels[i]).length;
  const pausePlayback = keyed.every((c) => period(take.channels[c]) === 0);
  const nothing = pausePlayback ? 'A loop needs two keys at different times.' : 'These curves already loop.';
  const travelling = after.filter(
    (channel, i) => channel !== take.channels[i] && channel.extrapolateOut === 'cycle_offset',
  );
  const how =
    travelling.length > 0
      ? `; ${plural(travelling.length, 'of them keeps travelling', 'of them keep travelling')}`
      : '';
  wb.messages.note(count ? `${plural(count, 'curve')} now loop${how}.` : nothing);
}

/** Long takes are processed in slices; if anything else changes meanwhile, the result is dropped. */
function filterAngles(wb: Uses<'store' | 'timeline' | 'messages'>, args: OfChannels): void {
  const { store, messages } = wb;
  const label = eulerFilter.label(store.document, args);
  const preview = new EditPreview(store, label, () => {
    messages.note(`${label} was stopped because the document has changed. Try again.`, 'warning');
  });
  inSlices(eulerFilterSteps(preview.base, args), {
    isOver: () => preview.over,
    progress: () => undefined,
    done({ edit, changed, notes }) {
      const { length } = changed;
      if (length > 0) {
        preview.show(aboutKeysInHand(wb, { ...eulerFilter, run: () => edit }).run(preview.base, args));
        preview.keep();
      } else preview.putBack();
      const text = length ? `${plural(length, 'curve')} filtered.` : 'Nothing to filter: no Euler flips.';
      messages.note([text, ...notes].join(' '));
    },
    failed(error) {
      preview.putBack();
      throw error;
    },
  });
}
