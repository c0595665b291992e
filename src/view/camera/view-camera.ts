/** What the page asks of the camera: to look at something, from somewhere. */
import { Box3, Vector3 } from 'three';
import type { Selection } from '../../model/session.ts';
import type { ShownDocument } from '../shown-document.ts';
import type { CameraRig, CameraView, ViewDirection } from './camera.ts';
import type { Framer } from './framer.ts';

export class ViewCamera {
  private readonly box = new Box3();
  private readonly point = new Vector3();

  /** @param events `update` is called before anything is measured, `redraw` for a frame that begins a move */
  constructor(
    private readonly rig: CameraRig,
    private readonly framer: Framer,
    private readonly shown: ShownDocument,
    private readonly events: { update(): void; redraw(): void },
  ) {}

  /** Sets the function that returns how many CSS pixels at the top are covered by overlays, for framing. */
  keepClear(coveredTop: () => number): void {
    this.framer.coveredTop = coveredTop;
  }

  /** Frames everything. */
  frameAll(): void {
    this.framer.frameAll();
    this.events.redraw();
  }

  /** Frames the selected vertex or joint of the picked instance, or the character with its motion; else everything. */
  frameSelection(selection: Selection): void {
    this.events.update();
    this.framer.frameSelection(selection, this.shown.playedRange, this.shown.timeSeconds);
    this.events.redraw();
  }

  /** Frames these characters with the next frame, with room for their motion, unless they are well in view. */
  reveal(...characterIds: readonly string[]): void {
    this.framer.reveal(characterIds);
    this.events.redraw();
  }

  lookFrom(side: ViewDirection): void {
    this.rig.lookFrom(side);
  }

  /** Orbits about the target; radians, positive moves the camera to the right and down. */
  turn(azimuth: number, polar = 0): void {
    this.rig.turn(azimuth, polar);
  }

  /**
   * Orbits so that a visible character seems to turn where it is; of another, as `turn` does.
   *
   * @param angle radians, positive turns its near side to the right
   */
  turnCharacter(characterId: string, angle: number): void {
    const box = this.shown.characters.seen(characterId)?.view.bounds(this.box);
    const about = box && !box.isEmpty() ? box.getCenter(this.point) : undefined;
    this.rig.turn(-angle, 0, about);
  }

  /** The current view, or the one being moved to. */
  get view(): CameraView {
    return this.rig.view;
  }

  /** Sets the view at once and cancels pending framing. */
  set view(view: CameraView) {
    this.framer.leave();
    this.rig.view = view;
  }
}
