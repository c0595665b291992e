/**
 * What the mouse does, for the `?` page. No actions, for these begin at a place: the code that reads them is the view's
 * controls, `curves/tools/intent.ts`, `dope/gestures.ts` and their neighbours, and whoever changes one changes it here.
 */

export interface MouseGestures {
  /** A heading of the page. */
  readonly where: string;
  /** What it does, and how. `Ctrl` is the platform's own key for commands, as in shortcuts. */
  readonly lines: readonly (readonly [what: string, how: string])[];
}

export const MOUSE_GESTURES: readonly MouseGestures[] = [
  {
    where: 'Mouse',
    lines: [
      ['Orbit', 'drag'],
      ['Pan', 'right drag or Shift+drag'],
      ['Dolly', 'wheel'],
      ['Pick a joint or vertex', 'click'],
      ['Zoom the time ruler', 'wheel'],
      ['Pan the time ruler', 'Shift+wheel'],
      ['Fit the time ruler', 'double click'],
      ['Fine steps on a slider', 'Alt+↑ ↓'],
    ],
  },
  {
    where: 'Mouse in IK mode',
    lines: [
      ['Pin a point, or let a pin go', 'click'],
      ['Select a joint, or a pin', 'Shift+click'],
      ['… with a finger', 'long press'],
      ['Move a pin', 'drag it'],
      ['… nearer or further away', 'Alt+drag or right drag'],
      ['… with fingers', 'drag with two'],
      ['Move any other point, the pins hold', 'drag it'],
      ['… nearer or further away (right drag pans there)', 'Alt+drag'],
      ['Move the selected pin', '← → ↑ ↓, Shift further'],
      ['… in depth', 'Alt+↑ ↓'],
      ['Let the selected pin go', 'Delete'],
      ['Give a drag up', 'Esc'],
    ],
  },
  {
    where: 'Mouse in rig mode',
    lines: [
      ['Select a joint', 'click it or its bone'],
      ['Place it', 'drag'],
      ['… in depth', 'right drag or Alt+drag'],
      ['… finely', 'Shift+drag'],
      ['… on round numbers, or opposite another joint', 'Ctrl+drag'],
      ['Move it along an axis', 'drag an arrow'],
      ['Size its box', 'drag a face’s dot'],
      ['… both faces', 'Alt+drag a face’s dot'],
      ['Add a child', 'Ctrl+click, or click while adding'],
      ['Hang it elsewhere', 'drag its row in the tree'],
      ['Give a drag up', 'Esc'],
    ],
  },
  {
    where: 'Mouse in FK, on the selected joint',
    lines: [
      ['Turn or move a DOF', 'drag its ring or arrow'],
      ['Turn the active DOF', 'drag the bone up or down'],
      ['Turn about the line of sight', 'drag the outer ring'],
      ['Turn any way', 'drag within the rings'],
      ['A tenth as far', 'Shift while dragging'],
      ['In steps of 5°', 'Ctrl while dragging'],
      ['Give a drag up', 'Esc'],
    ],
  },
  {
    where: 'Mouse in the curves',
    lines: [
      ['Select a key, or all keys of a curve', 'click'],
      ['Select what is in a box', 'drag on ground'],
      ['Add to it', 'Shift+click or Shift+drag'],
      ['Take from it', 'Ctrl+click or Ctrl+drag'],
      ['Move the selected keys', 'drag a key'],
      ['In time or in value alone', 'Shift+drag a key'],
      ['The other way of snapping', 'Ctrl+drag a key'],
      ['Insert a key', 'double or Ctrl+click on a curve'],
      ['Turn a tangent', 'drag its handle'],
      ['This side alone', 'Alt+drag a handle'],
      ['Both sides together', 'Ctrl+drag a handle'],
      ['Scale keys about the playhead', 'drag, its key held'],
      ['… about the middle', 'Alt+drag the scale frame'],
      ['Pan', 'middle drag or Alt+drag'],
      ['Zoom', 'wheel or Alt+right drag'],
      ['Zoom time alone', 'Shift+wheel'],
      ['Zoom values alone', 'Alt+wheel'],
      ['Move the playhead', 'drag in the ruler'],
      ['… off the frames', 'Shift+drag in the ruler'],
      ['Menu', 'right click'],
      ['Give a drag up', 'Esc'],
    ],
  },
  {
    where: 'Among the poses',
    lines: [
      ['Take a pose on', 'click or Enter'],
      ['Blend to it', 'Alt+drag'],
      ['Another card', '← → ↑ ↓'],
      ['Rename it', 'F2 or double click on its name'],
      ['Remove it', 'Delete'],
    ],
  },
  {
    where: 'Mouse in the dope sheet',
    lines: [
      ['Select keys', 'click, or drag on ground'],
      ['Add to it', 'Shift+click or Shift+drag'],
      ['Take from it', 'Ctrl+click or Ctrl+drag on ground'],
      ['Move the selected keys', 'drag one or the bar above'],
      ['… with all later keys', 'Alt+drag'],
      ['Drag a copy', 'Ctrl+drag'],
      ['Scale times', 'drag an end of the bar above'],
      ['… about the playhead', 'Alt+drag an end'],
      ['Go to a key', 'double click'],
      ['Pan', 'middle drag or Shift+wheel'],
      ['Zoom time', 'Ctrl+wheel, or wheel in the ruler'],
      ['Move the playhead', 'drag in the ruler'],
      ['Menu', 'right click'],
    ],
  },
];

/** With a Mac's names of the keys. */
export function macText(how: string): string {
  return how.replaceAll('Ctrl+wheel', '⌘ wheel or pinch').replaceAll('Ctrl+', '⌘ ').replaceAll('Alt+', '⌥ ');
}
