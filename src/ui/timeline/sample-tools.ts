/** Tools for the take's samples that need nothing asked: at the playhead, or to what is played. */
import { cropSamples, reverseSamples, reverseSteps, splitSamples, trimSamples } from '../../edit/commands/samples.ts';
import { inSlices } from '../in-slices.ts';
import { plural } from '../number-text.ts';
import { Trial } from '../trial.ts';
import type { Workbench } from '../workbench.ts';
import { clipTime, takeInHand } from './in-hand.ts';

export type SampleTool = 'crop' | 'trimStart' | 'trimEnd' | 'split' | 'reverse';

export function runSampleTool(wb: Workbench, tool: SampleTool): void {
  const take = takeInHand(wb);
  if (!take) return;
  const { character } = take;
  const characterId = character.id;
  const timeSeconds = clipTime(wb, character);
  if (tool === 'crop') {
    const [from, to] = wb.transport.get().range;
    const offset = character.timeOffsetSeconds;
    wb.store.apply(cropSamples, { characterId, from: from + offset, to: to + offset });
  } else if (tool === 'split') wb.store.apply(splitSamples, { characterId, timeSeconds });
  else if (tool === 'reverse') reverse(wb, characterId);
  else wb.store.apply(trimSamples, { characterId, side: tool === 'trimStart' ? 'start' : 'end', timeSeconds });
  const now = takeInHand(wb)?.clip.samples;
  if (now && tool !== 'reverse') wb.messages.note(`${plural(now.frameCount, 'frame')} in this take.`);
}

/** A long take is turned around in slices; where anything else changes meanwhile, it is not. */
function reverse({ store, messages }: Workbench, characterId: string): void {
  const label = reverseSamples.label(store.document, { characterId });
  const trial = new Trial(store, label, () => {
    messages.note(`${label} was stopped: something else has changed meanwhile.`, 'warning');
  });
  inSlices(reverseSteps(trial.base, { characterId }), {
    isOver: () => trial.over,
    progress: () => undefined,
    done(document) {
      trial.show(document);
      trial.keep();
    },
    failed(error) {
      trial.putBack();
      throw error;
    },
  });
}
