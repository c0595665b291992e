/** Sample tools without a dialog: at the playhead, or for the playback range. */
import {
  cropSamples,
  reverseSamples,
  reverseSteps,
  splitSamples,
  trimSamples,
} from '../../../edit/commands/samples.ts';
import { EditPreview } from '../../../edit/edit-preview.ts';
import { rangeOfSamples } from '../../../model/takes/samples.ts';
import type { Uses } from '../../state/workbench.ts';
import { inSlices } from '../../widgets/in-slices.ts';
import { count, plural, shown } from '../../widgets/numbers/number-text.ts';
import { type CurrentTake, currentTake, takeTime } from './current-take.ts';

export type SampleTool = 'crop' | 'trimStart' | 'trimEnd' | 'split' | 'reverse';

/** Reports the result as a message. */
export function runSampleTool(wb: Uses<'store' | 'transport' | 'messages'>, tool: SampleTool): void {
  const current = currentTake(wb);
  if (!current) return;
  const { character } = current;
  const characterId = character.id;
  if (tool === 'reverse') {
    reverse(wb, characterId);
    return;
  }
  const timeSeconds = takeTime(wb, character);
  if (tool === 'crop') {
    const [from, to] = wb.transport.get().range;
    const offset = character.timeOffsetSeconds;
    wb.store.apply(cropSamples, { characterId, from: from + offset, to: to + offset });
  } else if (tool === 'split') wb.store.apply(splitSamples, { characterId, timeSeconds });
  else wb.store.apply(trimSamples, { characterId, side: tool === 'trimStart' ? 'start' : 'end', timeSeconds });
  const now = currentTake(wb);
  if (now) wb.messages.note(tool === 'split' ? splitText(now, character.shownTake) : cutText(tool, current, now));
}

/** `Split: jump has 60 frames, jump_2 has 61.` */
export function splitText({ character, take }: CurrentTake, first: number): string {
  const said = [character.takes[first], take].map(
    ({ name, samples }) => `${name} has ${plural(samples?.frameCount ?? 0, 'frame')}`,
  );
  return `Split: ${said.join(', ')}.`;
}

/** `Cropped jump to 61 of 121 frames, 0.5 – 1.5 s.` */
export function cutText(
  tool: 'crop' | 'trimStart' | 'trimEnd',
  before: CurrentTake,
  { character, take }: CurrentTake,
): string {
  const { samples } = take;
  if (!samples) return '';
  if (take === before.take) return `${take.name} has no frames to cut there.`;
  const had = before.take.samples?.frameCount ?? 0;
  const [from, to] = rangeOfSamples(samples).map((time) => shown(time - character.timeOffsetSeconds));
  const now =
    had === samples.frameCount ? plural(had, 'frame') : `${count(samples.frameCount)} of ${count(had)} frames`;
  return `${tool === 'crop' ? 'Cropped' : 'Trimmed'} ${take.name} to ${now}, ${from} – ${to} s.`;
}

/** Long takes are reversed in slices; if anything else changes meanwhile, the result is dropped. */
function reverse(wb: Uses<'store' | 'messages'>, characterId: string): void {
  const { store, messages } = wb;
  const label = reverseSamples.label(store.document, { characterId });
  const preview = new EditPreview(store, label, () => {
    messages.note(`${label} was stopped because the document has changed. Try again.`, 'warning');
  });
  inSlices(reverseSteps(preview.base, { characterId }), {
    isOver: () => preview.over,
    progress: () => undefined,
    done(document) {
      preview.show(document);
      preview.keep();
      const take = currentTake(wb)?.take;
      messages.note(`Reversed ${take?.name ?? 'the take'}: ${plural(take?.samples?.frameCount ?? 0, 'frame')}.`);
    },
    failed(error) {
      preview.putBack();
      throw error;
    },
  });
}
