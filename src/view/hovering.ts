/** The joint under the pointer, by its bones, its box or the skin that follows it; found once per frame. */
import type { JointRef } from './drawn-skeletons.ts';
import type { Picker, PickScene } from './picking.ts';

/** Above this many triangles hover picking would be slow: skins are then picked on click only. */
const MAX_TRIANGLES = 300_000;

export class Hovering {
  /** The highlighted joint. */
  joint: JointRef | undefined;
  /** A tool has captured the pointer: no joint is highlighted meanwhile. */
  isTaken = false;
  /** Where the pointer has moved to since the last frame; CSS pixels of the viewport. */
  pointer: { readonly x: number; readonly y: number } | undefined;
  private readonly listeners = new Set<() => void>();

  /** Calls back when another joint or none is highlighted. Returns an unsubscribe function. */
  subscribe(listener: () => void): () => void {
    this.listeners.add(listener);
    return () => this.listeners.delete(listener);
  }

  changed(): void {
    for (const listener of this.listeners) listener();
  }

  /** The joint under a point of the viewport; undefined if there is none, or finding it would be slow. */
  jointAt(picker: Picker, scene: PickScene, x: number, y: number): JointRef | undefined {
    const triangles = scene.skins.reduce((sum, { mesh }) => sum + mesh.gpu.skin.triangles.length / 3, 0);
    if (triangles > MAX_TRIANGLES) return scene.skinsAreOpaque ? undefined : picker.pickJoint(scene, x, y);
    const hit = picker.pick(scene, x, y);
    return hit?.joint === undefined ? undefined : { ...hit, joint: hit.joint };
  }
}
