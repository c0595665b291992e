/** What the dope sheet shows: everything that drawing needs, read-only. */
import type { CompiledTake } from '../../../evaluate/compiled-take.ts';
import type { ChannelKeys } from '../../../model/session.ts';
import type { Motion } from '../../../model/takes/take.ts';
import type { SelectionBox } from '../timeline/box.ts';
import type { DopeRow } from '../timeline/dope-rows.ts';
import type { SheetKeys } from './hit.ts';
import type { Sheet } from './sheet.ts';

export interface DopeScene extends SheetKeys {
  readonly sheet: Sheet;
  readonly curves: CompiledTake;
  /** Of a take with layers: the motions other than the active one, whose keys are faint. */
  readonly others: readonly Motion[];
  /** Spans in which its root follows another character, in seconds of the transport, and what it follows. */
  readonly attached: readonly AttachedSpan[];
  readonly selected: readonly ChannelKeys[];
  /** Rows of selected joints are emphasised. */
  isSelected(row: DopeRow): boolean;
  /** Playback range, seconds of the transport. */
  readonly range: readonly [number, number];
  readonly framesPerSecond: number;
  readonly inFrames: boolean;
}

export interface AttachedSpan {
  readonly characterId: string;
  readonly from: number;
  readonly to: number;
  readonly label: string;
}

export interface DopeOverlay {
  readonly timeSeconds: number;
  readonly box?: SelectionBox;
  /** Beside the pointer, during a drag. */
  readonly readout?: { readonly x: number; readonly y: number; readonly text: string };
}
