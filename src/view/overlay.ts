/**
 * What tools draw over the scene (gizmos, pins): objects that are added and removed with their tool. The viewport
 * updates them each frame and doesn't know what they are.
 */
import type { Object3D, OrthographicCamera, PerspectiveCamera } from 'three';
import type { StageTheme } from './theme.ts';

/** Left, top, right, bottom, in CSS pixels of the viewport. */
export type ScreenBox = readonly [left: number, top: number, right: number, bottom: number];

export interface Overlay {
  /** In the scene: world coordinates. */
  readonly object: Object3D;
  /** Call before each frame, with poses and camera as they will be drawn. @param heightPx CSS pixels of the viewport */
  update(camera: PerspectiveCamera | OrthographicCamera, heightPx: number): void;
  setTheme(theme: StageTheme): void;
  /** Where no label may be, as of the last update. */
  readonly covers?: readonly ScreenBox[];
  dispose(): void;
}

export class Overlays {
  private readonly list = new Set<Overlay>();

  constructor(private readonly parent: Object3D) {}

  /** @returns removes and disposes of it */
  add(overlay: Overlay, theme: StageTheme): () => void {
    this.list.add(overlay);
    this.parent.add(overlay.object);
    overlay.setTheme(theme);
    return () => {
      if (!this.list.delete(overlay)) return;
      this.parent.remove(overlay.object);
      overlay.dispose();
    };
  }

  update(camera: PerspectiveCamera | OrthographicCamera, heightPx: number): void {
    for (const overlay of this.list) overlay.update(camera, heightPx);
  }

  /** Where no label may be. */
  get covers(): readonly ScreenBox[] {
    return [...this.list].flatMap(({ covers }) => covers ?? []);
  }

  setTheme(theme: StageTheme): void {
    for (const overlay of this.list) overlay.setTheme(theme);
  }

  dispose(): void {
    for (const overlay of this.list) overlay.dispose();
    this.list.clear();
  }
}
