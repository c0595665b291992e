/** What a drag in the plot is, and what it may use. */
import type { Uses } from '../../../state/workbench.ts';
import type { SelectionBox } from '../../timeline/box.ts';
import type { CurveScene } from '../scene/scene.ts';
import type { CurveSpace } from '../scene/space.ts';

/** A pointer over the plot: pixels from its top left corner, and the keys that are held. */
export interface PointerAt {
  readonly x: number;
  readonly y: number;
  readonly shift: boolean;
  /** Cmd on a Mac. */
  readonly ctrl: boolean;
  readonly alt: boolean;
}

/** As much of the plot as drags need. */
export interface PlotAccess {
  readonly wb: Uses<'store' | 'actions' | 'transport' | 'timeline' | 'settings' | 'messages'>;
  /** As it is now, with what the drag has changed so far. */
  scene(): CurveScene | undefined;
  look(space: CurveSpace): void;
  showBox(box: SelectionBox | undefined): void;
  /** What a drag has come to: `Δ +0.1 s`; empty takes it away. */
  say(text: string): void;
}

/**
 * One drag, from the press to the release. `move` is given the latest position once a frame and has to work from the
 * press on, not from the last call: then nothing drifts, and nothing depends on how many events there were.
 */
export interface Drag {
  /** While it lasts. */
  cursor(at: PointerAt): string;
  move(at: PointerAt): void;
  /** The release. @param moved whether it went further than a click may tremble */
  end(at: PointerAt, moved: boolean): void;
  /** Escape: everything as it was. */
  cancel(): void;
  /** Whether Escape was for it and it shows nothing any more. */
  cancelled?(): boolean;
}

/** A drag for what changes nothing that would have to be put back. */
export const NOTHING_TO_UNDO = () => {};
