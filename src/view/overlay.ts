/**
 * What tools draw over the picture (gizmos, pins): objects of the scene that come with their tool and go with it. The
 * viewport gives them each frame, and does not know what they are.
 */
import type { Object3D, OrthographicCamera, PerspectiveCamera, Scene } from 'three';
import type { StageTheme } from './theme.ts';

export interface Overlay {
  /** In the scene: world coordinates. */
  readonly object: Object3D;
  /** Before each picture, when poses and camera are as they will be drawn. @param heightPx CSS pixels of the viewport */
  update(camera: PerspectiveCamera | OrthographicCamera, heightPx: number): void;
  setTheme(theme: StageTheme): void;
  dispose(): void;
}

export class Overlays {
  private readonly list = new Set<Overlay>();

  constructor(private readonly scene: Scene) {}

  /** @returns takes it away again, and disposes of it */
  add(overlay: Overlay, theme: StageTheme): () => void {
    this.list.add(overlay);
    this.scene.add(overlay.object);
    overlay.setTheme(theme);
    return () => {
      if (!this.list.delete(overlay)) return;
      this.scene.remove(overlay.object);
      overlay.dispose();
    };
  }

  update(camera: PerspectiveCamera | OrthographicCamera, heightPx: number): void {
    for (const overlay of this.list) overlay.update(camera, heightPx);
  }

  setTheme(theme: StageTheme): void {
    for (const overlay of this.list) overlay.setTheme(theme);
  }

  dispose(): void {
    for (const overlay of this.list) overlay.dispose();
    this.list.clear();
  }
}
