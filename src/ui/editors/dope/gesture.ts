/** What a drag in the sheet is, and what it may use. */
import type { Uses } from '../../state/workbench.ts';
import type { SelectionBox } from '../timeline/box.ts';
import type { SheetKeys } from './hit.ts';
import type { Sheet } from './sheet.ts';

/** Where the pointer is, in the sheet, and what is held down. */
export interface Pointer {
  readonly x: number;
  readonly y: number;
  readonly shift: boolean;
  /** Ctrl, or Cmd. */
  readonly ctrl: boolean;
  readonly alt: boolean;
}

/** What gestures see of the panel: always as it is now, for it may be scrolled and zoomed under them. */
export interface DopeHost {
  readonly wb: Uses<'store' | 'transport' | 'timeline' | 'settings' | 'messages'>;
  sheet(): Sheet;
  shown(): SheetKeys;
}

/** `move` works from the press on and not from the last call, so that nothing drifts. */
export interface DopeDrag {
  move(at: Pointer): void;
  /** @param moved the pointer went further than a click's */
  release(at: Pointer, moved: boolean): void;
  /** Escape: everything as it was. */
  cancel(): void;
  readonly box?: SelectionBox | undefined;
  /** What it has come to, to be read beside the pointer. */
  readonly readout?: string | undefined;
}
