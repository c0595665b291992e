/** Box selection of diamonds. Its first corner stays at its time and row when the sheet is scrolled or zoomed. */

import { unionKeys, withoutKeys } from '../../../edit/keys/selection.ts';
import type { ChannelKeys } from '../../../model/session.ts';
import { timeAt, timeX } from '../../widgets/time/time-window.ts';
import type { SelectionBox } from '../timeline/box.ts';
import { selectedKeys, selectKeys } from '../timeline/current-take.ts';
import type { DopeDrag, DopeHost, Pointer } from './gesture.ts';
import { sheetKeysInBox } from './hit.ts';
import { HEAD, rowsTop } from './sheet.ts';

export class SelectBox implements DopeDrag {
  box: SelectionBox | undefined;
  private readonly before: readonly ChannelKeys[];
  private readonly seconds: number;
  /** Pixels below the sheet's top, as if unscrolled. */
  private readonly down: number;

  /** @param onSummary selects whole columns */
  constructor(
    private readonly host: DopeHost,
    private readonly from: Pointer,
    private readonly onSummary: boolean,
  ) {
    const sheet = host.sheet();
    this.before = selectedKeys(host.wb);
    this.seconds = timeAt(sheet, from.x);
    this.down = from.y + sheet.scrollTop;
  }

  move(at: Pointer): void {
    const { wb } = this.host;
    const sheet = this.host.sheet();
    const x0 = timeX(sheet, this.seconds);
    const top = rowsTop(sheet);
    this.box = this.onSummary
      ? { x0, y0: HEAD, x1: at.x, y1: top }
      : { x0, y0: this.down - sheet.scrollTop, x1: at.x, y1: Math.min(sheet.height, Math.max(top, at.y)) };
    const inside = sheetKeysInBox(sheet, this.host.shown(), this.box, this.onSummary);
    if (this.from.shift) selectKeys(wb, unionKeys(this.before, inside));
    else selectKeys(wb, this.from.ctrl ? withoutKeys(this.before, inside) : inside);
  }

  release(_at: Pointer, moved: boolean): void {
    this.box = undefined;
    if (!moved && !this.from.shift && !this.from.ctrl) selectKeys(this.host.wb, []);
  }

  cancel(): void {
    this.box = undefined;
    selectKeys(this.host.wb, this.before);
  }
}
