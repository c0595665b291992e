/** The interface of drags in the plot. */
import type { Uses } from '../../../state/workbench.ts';
import type { SelectionBox } from '../../timeline/box.ts';
import type { CurveScene } from '../scene/scene.ts';
import type { CurveSpace } from '../scene/space.ts';

/** Pointer position in pixels from the plot's top left corner, with modifiers. */
export interface PointerAt {
  readonly x: number;
  readonly y: number;
  readonly shift: boolean;
  /** Cmd on a Mac. */
  readonly ctrl: boolean;
  readonly alt: boolean;
}

/** The part of the plot that drags need. */
export interface PlotAccess {
  readonly wb: Uses<'store' | 'actions' | 'transport' | 'timeline' | 'settings' | 'messages'>;
  /** The current scene, including what the drag has changed so far. */
  scene(): CurveScene | undefined;
  look(space: CurveSpace): void;
  showBox(box: SelectionBox | undefined): void;
  /** Shows a drag's result: `Δ +0.1 s`; empty clears it. */
  say(text: string): void;
}

/**
 * One drag, from press to release. `move` gets the latest position once a frame and must compute from the press, not
 * from the last call: then nothing drifts, and the number of events doesn't matter.
 */
export interface Drag {
  /** The cursor during the drag. */
  cursor(at: PointerAt): string;
  move(at: PointerAt): void;
  /** The release. @param moved whether it moved further than a click */
  end(at: PointerAt, moved: boolean): void;
  /** Escape: restores everything. */
  cancel(): void;
  /** Whether Escape has cancelled its edit. */
  cancelled?(): boolean;
}

/** For drags that change nothing to be restored. */
export const NOTHING_TO_UNDO = () => {};
