/** Inserts a key on a curve where it was clicked. */
import { insertKeys } from '../../../edit/commands/keys.ts';
import type { Uses } from '../../state/workbench.ts';
import { takeInHand } from '../timeline/in-hand.ts';

/** On the curve, preserving its shape; on the nearest frame if keys snap to frames. @param clipSeconds of the clip */
export function insertOnCurve(
  wb: Uses<'store' | 'transport' | 'timeline'>,
  channel: number,
  clipSeconds: number,
): void {
  const take = takeInHand(wb);
  if (!take) return;
  const { framesPerSecond } = wb.transport.get();
  const offset = take.character.timeOffsetSeconds;
  const snapped = Math.round((clipSeconds - offset) * framesPerSecond) / framesPerSecond + offset;
  const timeSeconds = wb.timeline.view.get().snapsToFrames ? snapped : clipSeconds;
  wb.store.apply(insertKeys, { characterId: take.character.id, channels: [channel], timeSeconds });
}
