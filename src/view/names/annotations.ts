/**
 * What tells of the characters over their picture: the names of joints and characters, the path of the selected joint,
 * and the poses before and after the current time. Given to the viewport, not made by it: the first picture does
 * without, and its script is smaller for it.
 */

import { MotionDrawing } from '../motion/motion-drawing.ts';
import type { ShownCharacters } from '../shown-characters.ts';
import type { StageTheme } from '../theme.ts';
import { LabelCover } from './label-cover.ts';
import { Labels } from './labels.ts';

export class Annotations {
  readonly labels = new Labels();
  /** Which joints' names are behind skins and boxes. */
  readonly cover = new LabelCover();
  readonly motion: MotionDrawing;

  /** @param redraw called when a path that takes longer is there */
  constructor(characters: Pick<ShownCharacters, 'seen' | 'visible'>, redraw: () => void) {
    this.motion = new MotionDrawing(characters, redraw);
  }

  setTheme(theme: StageTheme): void {
    this.labels.setTheme(theme);
    this.motion.setTheme(theme);
  }

  dispose(): void {
    this.labels.canvas.remove();
    this.motion.dispose();
  }
}
