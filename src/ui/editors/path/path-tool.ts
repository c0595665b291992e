/**
 * Keys on the motion path of the selected joint, and frames of a capture. A drag moves the joint at that time, in the
 * plane that faces the eye, by its limb: one step, and only keys at that time change. A click goes to the time.
 */
import { movePathKey } from '../../../edit/commands/drags/drags.ts';
import { NO_TRAVEL, placementMatrix } from '../../../evaluate/space/placements.ts';
import { runToEnd } from '../../../evaluate/steps.ts';
import { invertAffine, isSingular } from '../../../math/mat4.ts';
import { add, subtract, transformPoint, transformVector, type Vec3 } from '../../../math/vec3.ts';
import { findCharacter } from '../../../model/document.ts';
import type { PathHandles } from '../../../view/motion/path-marks.ts';
import { samplePath, type Trail } from '../../../view/motion/trail.ts';
import { HandEdit } from '../../state/actions/hand-edit.ts';
import { pausePlayback } from '../../state/pause-playback.ts';
import type { Workbench } from '../../state/workbench.ts';
import { type CanvasDrag, type CanvasPointer, type CanvasTool, CLICK_PIXELS } from '../viewport/canvas-tools.ts';

/** CSS pixels around a key; more for a finger. */
const GRAB_PIXELS = 9;
const FINGER_PIXELS = 18;

/** @param tool the mode's, for clicks at the current time */
export function pathTool(wb: Workbench, trail: Trail, tool: () => CanvasTool | undefined): CanvasTool {
  return new PathTool(wb, trail, tool);
}

class PathTool implements CanvasTool {
  private readonly toScene = new Float64Array(16);

  constructor(
    private readonly wb: Workbench,
    private readonly trail: Trail,
    private readonly tool: () => CanvasTool | undefined,
  ) {}

  press(at: CanvasPointer): CanvasDrag | undefined {
    const { held } = this.trail;
    const handle = held && at.button === 0 && !at.shiftKey ? this.handleAt(held, at) : -1;
    if (!held || handle < 0) return undefined;
    this.trail.light(handle);
    return new PathDrag(this.wb, held, handle, at, this.toScene.slice(), () => {
      this.trail.light(undefined);
      const timeSeconds = held.times[handle];
      if (this.wb.transport.get().timeSeconds === timeSeconds) this.tool()?.press(at)?.end(at);
      else this.wb.transport.update((now) => ({ ...now, timeSeconds, playing: false }));
    });
  }

  hover(at: CanvasPointer | undefined): string | undefined {
    const { trail } = this;
    const handle = at && trail.held ? this.handleAt(trail.held, at) : -1;
    trail.light(handle < 0 ? undefined : handle);
    return handle < 0 ? undefined : 'grab';
  }

  /** The handle under the pointer; −1 if there is none. Of handles at one place a key comes before a frame. */
  private handleAt({ character, places }: PathHandles, { clientX, clientY, pointerType }: CanvasPointer): number {
    const { wb, toScene } = this;
    placementMatrix(character.placements[wb.viewport.pickedCopy(character)], character.space, NO_TRAVEL, toScene);
    const { origin, direction } = wb.viewport.eye.rayAt(clientX, clientY);
    const { orthographic } = wb.settings.get().display;
    let [best, least] = [-1, Infinity];
    for (let i = 0; 3 * i < places.length; i++) {
      let [along, squared] = [0, 0];
      for (let r = 0; r < 3; r++) {
        let v = toScene[12 + r] - origin[r];
        for (let c = 0; c < 3; c++) v += toScene[4 * c + r] * places[3 * i + c];
        along += v * direction[r];
        squared += v * v;
      }
      const away = (squared - along * along) / (orthographic ? 1 : along * along);
      if (along <= 0 || !(away <= least)) continue;
      [best, least] = [i, away];
    }
    if (best < 0) return -1;
    const { x, y } = wb.viewport.eye.toScreen(worldOf(toScene, places, best));
    const near = pointerType === 'touch' ? FINGER_PIXELS : GRAB_PIXELS;
    return Math.hypot(x - clientX, y - clientY) <= near ? best : -1;
  }
}

class PathDrag implements CanvasDrag {
  hasBegun = false;
  private readonly edit: HandEdit;
  /** From the scene to the character's own space. */
  private readonly toOwn = new Float64Array(16);
  /** The handle in the scene, where the pointer took it, and where the joint is at that time, also while drawn in place. */
  private readonly anchor: Vec3;
  private readonly grabbed: Vec3;
  private readonly own: Vec3;

  /** @param clicked called at the release if it hasn't moved */
  constructor(
    private readonly wb: Workbench,
    private readonly held: PathHandles,
    private readonly handle: number,
    private readonly from: CanvasPointer,
    toScene: Float64Array,
    private readonly clicked: () => void,
  ) {
    const { character, joint, times, places } = held;
    const { id, skeleton } = character;
    this.edit = new HandEdit(wb.store, wb.messages, () => findCharacter(wb.store.document, id)?.skeleton === skeleton);
    if (!isSingular(toScene)) invertAffine(toScene, 0, this.toOwn, 0);
    this.anchor = worldOf(toScene, places, handle);
    this.grabbed = this.pointAt(from);
    const time = times[handle];
    const [x, y, z] = runToEnd(
      samplePath(findCharacter(wb.store.document, id) ?? character, joint, [time, time], 1, false),
    );
    this.own = [x, y, z];
  }

  move(at: CanvasPointer): void {
    const { wb, from, edit, held, handle, toOwn, own, grabbed } = this;
    if (!this.hasBegun) {
      if (Math.hypot(at.clientX - from.clientX, at.clientY - from.clientY) < CLICK_PIXELS) return;
      this.hasBegun = true;
      pausePlayback(wb);
    }
    if (edit.cancelled) return;
    const to = add(own, transformVector(toOwn, subtract(this.pointAt(at), grabbed)));
    const { character, joint, times } = held;
    edit.preview(movePathKey, { characterId: character.id, timeSeconds: times[handle], joint, to });
  }

  end(): void {
    this.edit.commit();
    if (!this.hasBegun) this.clicked();
  }

  cancel(): void {
    this.edit.cancel();
  }

  private pointAt({ clientX, clientY }: CanvasPointer): Vec3 {
    return this.wb.viewport.eye.inPlaneOf(this.anchor, clientX, clientY);
  }
}

function worldOf(toScene: Float64Array, places: Float64Array, i: number): Vec3 {
  return transformPoint(toScene, [places[3 * i], places[3 * i + 1], places[3 * i + 2]]);
}
