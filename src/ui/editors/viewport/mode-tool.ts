/** The viewport's tool of one mode. */
import type { CanvasTool } from './canvas-tools.ts';

/** It can be put down, and what it draws with it. */
export interface ModeTool extends CanvasTool {
  /** Its mode was entered: what it draws comes. */
  enter(): void;
  /** Another mode was: what it draws goes. */
  leave(): void;
}
