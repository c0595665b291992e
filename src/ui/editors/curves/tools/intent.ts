/**
 * What a press in the plot does, and its cursor. Pure logic, since users notice every difference here:
 *
 *                   plain        Shift        Ctrl            Alt            S held
 *     handle        slope        slope        both sides      this side      slope
 *     key           move         add, lock    remove, unsnap  pan            scale
 *     curve         select       add          insert          pan            scale
 *     empty ground  box          box adds     box removes     pan            scale
 *
 * The middle button pans everywhere, the right one zooms with Alt and opens the menu without.
 */
import type { CurveHit } from '../scene/scene.ts';
import type { PointerAt } from './tool.ts';

export type Intent = 'pan' | 'zoom' | 'slope' | 'scale' | 'keys' | 'curve' | 'insert' | 'box' | 'menu';

export interface Press extends Pick<PointerAt, 'shift' | 'ctrl' | 'alt'> {
  /** As in PointerEvent: 0 left, 1 middle, 2 right. */
  readonly button: number;
  /** The S key is held. */
  readonly scaling: boolean;
}

export function intentOf(press: Press, hit: CurveHit): Intent {
  if (press.button === 1) return 'pan';
  if (press.button === 2) return press.alt ? 'zoom' : 'menu';
  if (press.scaling) return 'scale';
  if (hit.kind === 'handle') return 'slope';
  if (press.alt) return 'pan';
  if (hit.kind === 'key') return 'keys';
  if (hit.kind === 'curve') return press.ctrl ? 'insert' : 'curve';
  return 'box';
}

/** The cursor for a press. */
export function cursorOf(intent: Intent, press: Pick<Press, 'shift' | 'ctrl'>, isSelected: boolean): string {
  switch (intent) {
    case 'pan':
      return 'grab';
    case 'zoom':
      return 'zoom-in';
    case 'slope':
      return 'pointer';
    case 'scale':
      return 'nwse-resize';
    case 'keys':
      // Shift adds what isn't selected, and otherwise constrains the drag to one direction.
      return press.shift && !isSelected ? 'copy' : 'move';
    case 'curve':
      return press.shift ? 'copy' : 'pointer';
    case 'insert':
      return 'crosshair';
    case 'box':
    case 'menu':
      return 'default';
  }
}
