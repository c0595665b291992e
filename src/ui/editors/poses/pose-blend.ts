/** One blend by hand from the displayed pose towards a pose of the library, in one undo step. Escape restores it. */
import { applyPose } from '../../../edit/commands/poses.ts';
import { HandEdit } from '../../state/actions/hand-edit.ts';
import { addKeyed } from '../../state/add-keys.ts';
import type { Uses } from '../../state/workbench.ts';
import { moment } from './pose-edits.ts';

export interface Blended {
  readonly characterId: string;
  /** Index in the library. */
  readonly pose: number;
  /** Only these joints and their descendants; undefined: the whole character. */
  readonly joints: readonly number[] | undefined;
}

export class PoseBlend {
  private readonly hand: HandEdit;
  private readonly at: ReturnType<typeof moment>;

  /** Stops playback: the pose is that at the beginning. */
  constructor(
    private readonly wb: Uses<'store' | 'transport' | 'timeline' | 'settings' | 'messages'>,
    private readonly blended: Blended,
  ) {
    this.hand = new HandEdit(wb.store, wb.messages);
    this.at = moment(wb);
  }

  /** By Escape. */
  get cancelled(): boolean {
    return this.hand.cancelled;
  }

  /** @param share 0: the pose at the beginning, 1: that of the library */
  to(share: number): void {
    const args = { ...this.blended, share, ...this.at };
    this.hand.preview(applyPose, args, () => addKeyed(this.wb, applyPose, args));
  }

  /** Makes it an undo step. */
  commit(): void {
    this.hand.commit();
  }

  cancel(): void {
    this.hand.cancel();
  }
}
