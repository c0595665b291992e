/**
 * What tells of the characters over their picture: the names of joints and characters, the path of the selected joint,
 * the poses before and after the current time, and the mark of a picked vertex. Given to the viewport, not made by it: the first picture does
 * without, and its script is smaller for it.
 */

import { MotionDrawing } from '../motion/motion-drawing.ts';
import type { ShownCharacters } from '../shown-characters.ts';
import type { DrawnSkins } from '../skin/drawn-skins.ts';
import { VertexMarker } from '../skin/vertex-marker.ts';
import type { StageTheme } from '../theme.ts';
import { LabelCover } from './label-cover.ts';
import { Labels } from './labels.ts';

export class Annotations {
  readonly labels = new Labels();
  /** Which joints' names are behind skins and boxes. */
  readonly cover = new LabelCover();
  readonly motion: MotionDrawing;
  readonly vertexMarker = new VertexMarker();

  /** @param redraw called when a path that takes longer is there @param skins where ghosts of skins are drawn */
  constructor(characters: Pick<ShownCharacters, 'seen' | 'visible'>, redraw: () => void, skins: DrawnSkins) {
    this.motion = new MotionDrawing(characters, redraw, skins);
  }

  setTheme(theme: StageTheme): void {
    for (const part of [this.labels, this.motion, this.vertexMarker]) part.setTheme(theme);
  }

  dispose(): void {
    this.labels.canvas.remove();
    this.motion.dispose();
    this.vertexMarker.dispose();
  }
}
