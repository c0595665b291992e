/** How one character is drawn, whatever the display says. */
import type { SkinStyle } from '../model/session.ts';

export interface Look {
  readonly characterId: string;
  readonly skin: SkinStyle;
  /** Whether its bones are drawn in place of boxes, and picked instead of its skin. */
  readonly bones: boolean;
  /** What the skin style `heat` shows instead of joint weights: 0 to 1 per vertex. Another array for other values. */
  readonly heat?: Float32Array;
}
