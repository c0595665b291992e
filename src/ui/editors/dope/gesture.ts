/** The interface of drags in the sheet. */
import type { Uses } from '../../state/workbench.ts';
import type { SelectionBox } from '../timeline/box.ts';
import type { SheetKeys } from './hit.ts';
import type { Sheet } from './sheet.ts';

/** Pointer position in the sheet, with modifiers. */
export interface Pointer {
  readonly x: number;
  readonly y: number;
  readonly shift: boolean;
  /** Ctrl, or Cmd. */
  readonly ctrl: boolean;
  readonly alt: boolean;
}

/** The panel as gestures see it: always current, since it may be scrolled and zoomed meanwhile. */
export interface DopeHost {
  readonly wb: Uses<'store' | 'transport' | 'timeline' | 'settings' | 'messages'>;
  sheet(): Sheet;
  shown(): SheetKeys;
}

/** `move` computes from the press, not from the last call, so that nothing drifts. */
export interface DopeDrag {
  move(at: Pointer): void;
  /** @param moved the pointer moved further than a click */
  release(at: Pointer, moved: boolean): void;
  /** Escape: restores everything. */
  cancel(): void;
  readonly box?: SelectionBox;
  /** The result so far, shown beside the pointer. */
  readonly readout?: string;
}
