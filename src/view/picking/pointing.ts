/**
 * What is under the pointer: picked by a click, and highlighted as it moves, once per frame. A joint is hit by its
 * bones, its box, or the skin that follows it; a character alone by its name.
 */
import { characterIdOf } from '../../model/drawn-id.ts';
import type { CameraRig } from '../camera/camera.ts';
import type { Screen } from '../screen.ts';
import type { ShownDocument } from '../shown-document.ts';
import type { JointRef } from '../skeleton/drawn-skeletons.ts';
import { isOpaque } from '../skeleton/skeleton-drawing.ts';
import { type Hit, Picker, type PickScene } from './picking.ts';

/** Above this many triangles hover picking would be slow: skins are then picked on click only. */
const MAX_TRIANGLES = 300_000;

export class Pointing {
  private readonly picker: Picker;
  /** A tool has captured the pointer. */
  private isTaken = false;
  /** Where the pointer has moved to since the last frame; CSS pixels of the viewport. */
  private pointer: { readonly x: number; readonly y: number } | undefined;
  private readonly listening = new AbortController();

  /** @param events `update` is called before anything is picked, `redraw` for a frame that looks under the pointer */
  constructor(
    private readonly screen: Screen,
    private readonly shown: ShownDocument,
    private readonly rig: CameraRig,
    private readonly events: { update(): void; redraw(): void },
  ) {
    this.picker = new Picker(screen.renderer);
    const { canvas } = screen;
    const { signal } = this.listening;
    canvas.addEventListener('pointermove', (event) => this.move(event), { signal });
    canvas.addEventListener('pointerleave', () => this.leave(), { signal });
  }

  /** What is under a point of the page, by the document's ids; a character alone under its name. */
  pick(clientX: number, clientY: number): Hit | undefined {
    const scene = this.scene();
    if (!scene) return undefined;
    const { left, top } = this.screen.canvas.getBoundingClientRect();
    const named = this.shown.annotations?.labels.characterAt(clientX - left, clientY - top);
    const hit =
      named === undefined
        ? this.picker.pick(scene, clientX - left, clientY - top)
        : { characterId: named, placement: 0 };
    return hit && { ...hit, characterId: characterIdOf(hit.characterId) };
  }

  /** The highlighted joint, by the document's ids. */
  get hovered(): JointRef | undefined {
    const { joint } = this.shown.highlighted;
    return joint && { ...joint, characterId: characterIdOf(joint.characterId) };
  }

  /** Calls back when `hovered` changes. Returns an unsubscribe function. */
  onHover(listener: () => void): () => void {
    return this.shown.highlighted.subscribe(listener);
  }

  /** Highlights a joint as if under the pointer, for rows of lists; undefined: none. */
  hover(joint: JointRef | undefined): void {
    if (this.shown.highlight(joint)) this.events.redraw();
  }

  /** Whether a tool has captured the pointer: no joint is highlighted meanwhile. */
  take(isTaken: boolean): void {
    this.isTaken = isTaken;
    if (isTaken) this.hover(undefined);
  }

  /** Each frame, before it is drawn: highlights what the pointer has moved to. */
  settle(): void {
    const { pointer, shown } = this;
    this.pointer = undefined;
    if (!pointer || this.isTaken || this.rig.handling || !shown.canBePointedAt) return;
    const named = shown.annotations?.labels.characterAt(pointer.x, pointer.y);
    shown.annotations?.labels.hoverCharacter(named);
    const scene = named === undefined ? this.scene() : undefined;
    shown.highlight(scene && this.jointAt(scene, pointer.x, pointer.y));
  }

  dispose(): void {
    this.listening.abort();
    this.picker.dispose();
  }

  private move({ buttons, pointerType, offsetX, offsetY }: PointerEvent): void {
    this.pointer = buttons === 0 && pointerType === 'mouse' ? { x: offsetX, y: offsetY } : undefined;
    if (this.pointer && this.shown.canBePointedAt) this.events.redraw();
  }

  private leave(): void {
    this.pointer = undefined;
    this.shown.annotations?.labels.hoverCharacter(undefined);
    this.hover(undefined);
    this.events.redraw();
  }

  private scene(): PickScene | undefined {
    const { screen, shown, rig } = this;
    if (!screen.canDraw) return undefined;
    this.events.update();
    shown.stage.scene.updateMatrixWorld();
    rig.camera.updateMatrixWorld();
    const { width, height } = screen;
    const { skeletons, pickableSkins: skins, display } = shown;
    return { camera: rig.camera, width, height, skeletons, skins, skinsAreOpaque: isOpaque(display.skin) };
  }

  /** Undefined if there is none, or finding it would be slow. */
  private jointAt(scene: PickScene, x: number, y: number): JointRef | undefined {
    const { picker } = this;
    const triangles = scene.skins.reduce((sum, { mesh }) => sum + mesh.shared.skin.triangles.length / 3, 0);
    if (triangles > MAX_TRIANGLES) return scene.skinsAreOpaque ? undefined : picker.pickJoint(scene, x, y);
    const hit = picker.pick(scene, x, y);
    return hit?.joint === undefined ? undefined : { ...hit, joint: hit.joint };
  }
}
