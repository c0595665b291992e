/** Inserts a key on a curve where it was clicked. */
import { insertKeys } from '../../../edit/commands/keys.ts';
import { attempt } from '../../state/actions/attempt.ts';
import { addKeys } from '../../state/add-keys.ts';
import type { Uses } from '../../state/workbench.ts';
import { keyPlacing, onAllInHand } from '../timeline/current-take.ts';
import { timelineTake } from '../timeline/timeline-take.ts';

/** On the curve, preserving its shape; on the nearest frame if keys snap to frames. @param takeSeconds of the take */
export function insertOnCurve(
  wb: Uses<'store' | 'transport' | 'timeline' | 'messages'>,
  channel: number,
  takeSeconds: number,
): void {
  const current = timelineTake(wb);
  if (!current) return;
  const { framesPerSecond } = wb.transport.get();
  const offset = current.character.timeOffsetSeconds;
  const snapped = Math.round((takeSeconds - offset) * framesPerSecond) / framesPerSecond + offset;
  const timeSeconds = wb.timeline.view.get().snapsToFrames ? snapped : takeSeconds;
  const inserted = { characterId: current.character.id, channels: [channel], timeSeconds };
  const placing = keyPlacing(wb, current.character);
  attempt(wb.messages, () =>
    addKeys(wb, onAllInHand(wb, insertKeys), (outsideCycle) => ({ ...inserted, ...placing, outsideCycle })),
  );
}
