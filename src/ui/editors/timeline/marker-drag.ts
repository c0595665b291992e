/** Drags a marker in the scrubber, or the end of a span: one undo step. */
import { changeMarker } from '../../../edit/commands/markers.ts';
import type { Gesture } from '../../../edit/store.ts';
import { shownClip } from '../../../model/document.ts';
import { currentCharacter } from '../../state/action.ts';
import type { Uses } from '../../state/workbench.ts';

export class MarkerDrag {
  private gesture: Gesture | undefined;

  /** @param isEnd the end of a span, rather than all of it */
  constructor(
    private readonly wb: Uses<'store'>,
    private readonly index: number,
    private readonly isEnd: boolean,
  ) {}

  /** @param toSeconds of the transport */
  move(toSeconds: number): void {
    const { store } = this.wb;
    const character = currentCharacter(this.wb);
    if (!character) return;
    this.gesture ??= store.begin('Move marker');
    const before = this.gesture.base.characters.find(({ id }) => id === character.id) ?? character;
    const marker = shownClip(before)?.markers?.[this.index];
    if (!marker) return;
    const at = toSeconds + before.timeOffsetSeconds;
    const { timeSeconds, endSeconds } = marker;
    const next = this.isEnd
      ? { ...marker, endSeconds: Math.max(timeSeconds, at) }
      : { ...marker, timeSeconds: at, ...(endSeconds !== undefined && { endSeconds: endSeconds + at - timeSeconds }) };
    this.gesture.preview(
      changeMarker.run(this.gesture.base, { characterId: before.id, index: this.index, marker: next }),
    );
  }

  end(): void {
    this.gesture?.commit();
  }
}
