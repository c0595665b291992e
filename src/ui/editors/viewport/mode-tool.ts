/** The viewport's tool of one mode. */
import type { CanvasTool } from './canvas-tools.ts';

/** A tool that can be entered and left, with what it draws. */
export interface ModeTool extends CanvasTool {
  /** Its mode was entered: shows what it draws. */
  enter(): void;
  /** Another mode was entered: hides what it draws. */
  leave(): void;
}
