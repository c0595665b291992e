/** Drags a marker in the scrubber, or the end of a span: one undo step; Escape restores it. */
import { changeMarker } from '../../../../edit/commands/markers.ts';
import type { HandEdit } from '../../../state/actions/hand-edit.ts';
import type { Uses } from '../../../state/workbench.ts';
import { type CurrentTake, currentTake, editOfTakes } from '../current-take.ts';

const MOVE = { ...changeMarker, label: () => 'Move marker' };

export class MarkerDrag {
  private readonly take: CurrentTake | undefined;
  private readonly edit: HandEdit | undefined;

  /** @param isEnd the end of a span, rather than all of it */
  constructor(
    wb: Uses<'store' | 'messages'>,
    private readonly index: number,
    private readonly isEnd: boolean,
  ) {
    this.take = currentTake(wb);
    this.edit = this.take && editOfTakes(wb, [this.take]);
  }

  /** @param toSeconds of the transport */
  move(toSeconds: number): void {
    const { take: current, edit, index } = this;
    const marker = current?.take.markers?.[index];
    if (!current || !edit || !marker) return;
    const at = toSeconds + current.character.timeOffsetSeconds;
    const { timeSeconds, endSeconds } = marker;
    const next = this.isEnd
      ? { ...marker, endSeconds: Math.max(timeSeconds, at) }
      : { ...marker, timeSeconds: at, ...(endSeconds !== undefined && { endSeconds: endSeconds + at - timeSeconds }) };
    edit.preview(MOVE, { characterId: current.character.id, index, marker: next });
  }

  end(): void {
    this.edit?.commit();
  }

  /** Restores the marker. */
  cancel(): void {
    this.edit?.cancel();
  }
}
