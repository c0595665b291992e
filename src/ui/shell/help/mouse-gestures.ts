/**
 * Mouse gestures, for the `?` page. They aren't actions, since they start at a position. The code that implements them
 * is the view's controls, `curves/tools/intent.ts`, `dope/gestures.ts` and others: keep this list in sync.
 */

export interface MouseGestures {
  /** A heading of the page. */
  readonly where: string;
  /** What it does, and how. `Ctrl` means the platform's command key, as in shortcuts. */
  readonly lines: readonly (readonly [what: string, how: string])[];
}

export const MOUSE_GESTURES: readonly MouseGestures[] = [
  {
    where: 'Mouse',
    lines: [
      ['Orbit', 'drag'],
      ['Pan', 'right drag or Shift+drag'],
      ['Dolly', 'wheel'],
      ['Select a joint or vertex', 'click'],
      ['Add a joint to the selection, or remove it', 'Shift+click or Ctrl+click'],
      ['Add all joints in a box', 'Ctrl+drag on the background'],
      ['Context menu of what is there', 'right click or long press'],
      ['Only select and orbit', 'Q: the select tool'],
      ['Change the current time', 'drag in the time ruler'],
      ['… with snapping to frames inverted', 'Shift+drag in the time ruler'],
      ['Change the playback range', 'drag a handle below the time ruler'],
      ['Ease a moment otherwise that was just keyed', 'drag an end of its band on the time ruler'],
      ['Fit the time ruler', 'double-click'],
      ['Context menu of a time: range, keys', 'right click in the time ruler'],
      ['Context menu of what has the focus', 'Shift+F10 or the Menu key'],
      ['Go to a row in the outliner', 'type its name'],
      ['Fine steps on a slider', 'Alt+↑ ↓'],
    ],
  },
  {
    where: 'Wheel in rulers, curves, dope sheet and charts',
    lines: [
      ['Zoom about the pointer', 'wheel'],
      ['Zoom time only', 'Ctrl+wheel'],
      ['Zoom values only, or scroll rows', 'Alt+wheel'],
      ['Pan in time', 'Shift+wheel'],
    ],
  },
  {
    where: 'Mouse in the outliner',
    lines: [
      ['Select a joint', 'click'],
      ['Add it to the selection, or remove it', 'Ctrl+click or Ctrl+Space'],
      ['Select all joints from the last one', 'Shift+click'],
      ['Menu', 'right click'],
    ],
  },
  {
    where: 'Mouse in Pose mode',
    lines: [
      ['Pose a limb', 'drag its hand, foot or head, or its end'],
      ['… in depth', 'Alt+drag'],
      ['… in depth on a touchscreen', 'drag, then a second finger'],
      ['Turn or move a DOF of the selected joint', 'drag its ring or arrow'],
      ['… in fine steps, snapping', 'Shift+drag, Ctrl+drag'],
      ['Move the selected joint by its limb', 'drag the dot in the middle of its rings'],
      ['Move a pin', 'drag it'],
      ['… selected, along an axis or in a plane', 'drag its arrow or square'],
      ['Orbit', 'drag anywhere else'],
      ['Cancel drag', 'Esc'],
    ],
  },
  {
    where: 'Mouse in IK mode',
    lines: [
      ['Pin a point, or remove a pin', 'click'],
      ['Select a joint or a pin', 'Shift+click'],
      ['Add a joint to the selection, or remove it', 'Ctrl+click'],
      ['… on a touchscreen', 'long press'],
      ['Move a pin', 'drag it'],
      ['… in depth', 'Alt+drag or right drag'],
      ['… in depth on a touchscreen', 'drag, then a second finger'],
      ['… selected, along an axis or in a plane', 'drag its arrow or square'],
      ['Turn what the selected pin holds', 'drag its ring'],
      ['Move any other point while pins hold', 'drag it'],
      ['… in depth (right drag pans there)', 'Alt+drag'],
      ['Rotate the selected joint while pins hold', 'drag a ring'],
      ['… in fine steps, snapping', 'Shift+drag, Ctrl+drag'],
      ['Move the selected pin', '← → ↑ ↓, Shift for larger steps'],
      ['… in depth with the keyboard', 'Alt+↑ ↓'],
      ['Remove the selected pin', 'Delete'],
      ['Cancel drag', 'Esc'],
    ],
  },
  {
    where: 'Mouse in rig mode',
    lines: [
      ['Select a joint', 'click it or its bone'],
      ['Add it to the selection, or remove it', 'Shift+click'],
      ['Move it', 'drag'],
      ['… in depth', 'right drag or Alt+drag'],
      ['… in fine steps, without snapping to the grid', 'Shift+drag'],
      ['… snapping to round numbers or opposite another joint', 'Ctrl+drag'],
      ['Move it along an axis', 'drag an arrow'],
      ['Resize its box', 'drag a face’s dot'],
      ['… from both sides', 'Alt+drag a face’s dot'],
      ['Add child', 'Ctrl+click, or click while adding'],
      ['… without snapping to the grid', 'Shift+click while adding'],
      ['Reparent it', 'drag its row in the outliner'],
      ['Cancel drag', 'Esc'],
    ],
  },
  {
    where: 'Mouse in FK',
    lines: [
      ['Select a joint and change its active DOF', 'drag its bone or skin up or down'],
      ['Rotate or move a DOF', 'drag its ring or arrow'],
      ['Rotate about the view axis', 'drag the outer ring'],
      ['Rotate freely', 'drag inside the rings, next to the character'],
      ['Orbit from a character', 'Alt+drag'],
      ['Fine adjustment', 'Shift while dragging'],
      ['In steps of 5°', 'Ctrl while dragging'],
      ['Cancel drag', 'Esc'],
    ],
  },
  {
    where: 'Mouse in the curve editor',
    lines: [
      ['Select a key, or all keys of a curve', 'click'],
      ['Box select', 'drag on the background'],
      ['Add to selection', 'Shift+click or Shift+drag'],
      ['Remove from selection', 'Ctrl+click or Ctrl+drag'],
      ['Move the selected keys', 'drag a key'],
      ['… only in time or in value', 'Shift+drag a key'],
      ['… with snapping inverted', 'Ctrl+drag a key'],
      ['Insert a key', 'double-click or Ctrl+click on a curve'],
      ['Change a tangent', 'drag its handle'],
      ['… one side only', 'Alt+drag a handle'],
      ['… both sides together', 'Ctrl+drag a handle'],
      ['Scale keys about the current time', 'drag while holding its key'],
      ['… about the middle', 'Alt+drag the transform box'],
      ['Pan', 'middle drag or Alt+drag'],
      ['Zoom', 'Alt+right drag'],
      ['Context menu of a time: range, keys', 'right click in the ruler'],
      ['Change the current time', 'drag in the ruler'],
      ['… with snapping to frames inverted', 'Shift+drag in the ruler'],
      ['Menu', 'right click'],
      ['Cancel drag', 'Esc'],
    ],
  },
  {
    where: 'In the pose library',
    lines: [
      ['Apply a pose', 'click or Enter'],
      ['Blend to it', 'Alt+drag sideways, or the Blend slider'],
      ['Next or previous card', '← → ↑ ↓'],
      ['Rename it', 'F2 or double-click on its name'],
      ['Remove it', 'Delete'],
    ],
  },
  {
    where: 'Mouse in the dope sheet',
    lines: [
      ['Select keys', 'click, or drag on the background'],
      ['Add to selection', 'Shift+click or Shift+drag'],
      ['Remove from selection', 'Ctrl+click or Ctrl+drag on the background'],
      ['Move the selected keys', 'drag one or the bar above'],
      ['… rippling later keys', 'Alt+drag'],
      ['Drag a copy', 'Ctrl+drag'],
      ['Scale in time', 'drag an end of the bar above'],
      ['… about the current time', 'Alt+drag an end'],
      ['Go to a key', 'double-click'],
      ['Pan', 'middle drag'],
      ['Change the current time', 'drag in the ruler'],
      ['Menu', 'right click'],
    ],
  },
];

/** With a Mac's key names. */
export function macText(how: string): string {
  return how.replaceAll('Ctrl+wheel', '⌘ wheel or pinch').replaceAll('Ctrl+', '⌘ ').replaceAll('Alt+', '⌥ ');
}
