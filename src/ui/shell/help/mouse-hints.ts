/** What the mouse does at a place of the page: the text of the status bar. */
import type { PosingMode } from '../../state/posing.ts';

/** What it does, and how: as in `MOUSE_GESTURES`. */
export type MouseHint = readonly [what: string, how: string];

/** Where the pointer is. */
export interface MousePlace {
  readonly area: MouseArea;
  /** The CSS cursor there, which says what a press would take. */
  readonly cursor: string;
  readonly mode: PosingMode;
  /** Name of the joint under the pointer in the viewport. */
  readonly joint?: string;
  /** Pose and IK modes: what a drag of that joint moves. */
  readonly moves?: string;
  /** Pose and IK modes: the pointer is on a pin. */
  readonly isPin?: boolean;
  /** Rig mode: clicks add joints. */
  readonly isAdding?: boolean;
  /** *Snap to frames* is on. */
  readonly snapsToFrames?: boolean;
}

/** Areas of the page that have gestures, by a selector of their element; inner ones first. */
export const MOUSE_AREAS = {
  viewport: '.stage .viewport',
  curves: '.curve-plot',
  channels: '.channel-rows',
  dope: '.dope-sheet',
  scrubber: '.scrubber',
  tree: '.tree',
  slider: '.inspector .slider',
  pose: '.pose-card',
  takes: '.take-row',
} as const;
export type MouseArea = keyof typeof MOUSE_AREAS;

const CAMERA: readonly MouseHint[] = [
  ['Orbit', 'drag'],
  ['Pan', 'right drag'],
  ['Dolly', 'wheel'],
];

const ELSEWHERE: Readonly<
  Record<Exclude<MouseArea, 'viewport' | 'curves' | 'dope' | 'scrubber'>, readonly MouseHint[]>
> = {
  channels: [
    ['Isolate', 'click'],
    ['Isolate several', 'Ctrl+click'],
    ['Select its keys', 'double-click'],
    ['Menu', 'right click'],
  ],
  tree: [
    ['Select', 'click'],
    ['Add or remove', 'Ctrl+click'],
    ['Select up to here', 'Shift+click'],
    ['Frame', 'double-click'],
    ['Menu', 'right click'],
  ],
  slider: [
    ['Change', 'drag'],
    ['In fine steps', 'Alt+↑ ↓'],
  ],
  takes: [
    ['Select', 'click'],
    ['Add a second one to compare', 'Ctrl+click'],
    ['Play alone', 'double-click'],
    ['Menu, with Compare', 'right click'],
  ],
  pose: [
    ['Apply', 'click'],
    ['Blend to it', 'Alt+drag sideways'],
    ['Menu', 'right click'],
  ],
};

export function mouseHints(place: MousePlace): readonly MouseHint[] {
  if (place.area === 'viewport') return inViewport(place);
  if (place.area === 'scrubber') return inTime(place);
  if (place.area === 'curves') return inCurves(place);
  if (place.area === 'dope') return inDope(place);
  return ELSEWHERE[place.area];
}

/** Cursors over a tool's handle; the second over one that yields to joints under the pointer, and there is none. */
const HANDLES: readonly string[] = ['grab', 'move'];

function inViewport(place: MousePlace): readonly MouseHint[] {
  const isHandle = HANDLES.includes(place.cursor);
  return { select: inSelect, pose: inPose, fk: inFk, ik: inIk, rig: inRig }[place.mode](place, isHandle);
}

function inSelect({ joint }: MousePlace): readonly MouseHint[] {
  if (joint !== undefined) return [[`Select ${joint}`, 'click'], ['Add or remove', 'Shift+click'], ...CAMERA];
  return [...CAMERA, ['Select a joint', 'click'], ['Box select', 'Ctrl+drag']];
}

const ON_HANDLE: readonly MouseHint[] = [
  ['Rotate or move', 'drag'],
  ['Fine', 'Shift+drag'],
  ['In steps', 'Ctrl+drag'],
  ['Cancel', 'Esc'],
];

function inPose(place: MousePlace, isHandle: boolean): readonly MouseHint[] {
  if (place.isPin) {
    return [
      ['Move the pin', 'drag'],
      ['In depth', 'Alt+drag'],
      ['Select it', 'click'],
    ];
  }
  if (isHandle) return ON_HANDLE;
  const { joint, moves } = place;
  if (joint === undefined || moves === undefined) return inSelect(place);
  return [
    [moves, 'drag'],
    ['In depth', 'Alt+drag'],
    [`Select ${joint}`, 'click'],
    ['Add or remove', 'Shift+click'],
  ];
}

function inFk(place: MousePlace, isHandle: boolean): readonly MouseHint[] {
  if (isHandle) return ON_HANDLE;
  const { joint } = place;
  if (joint === undefined) return inSelect(place);
  return [
    [`Rotate or move ${joint}`, 'drag'],
    [`Select ${joint}`, 'click'],
    ['Add or remove', 'Shift+click'],
    ['Orbit', 'Alt+drag'],
  ];
}

function inIk(
  { joint, moves = 'Move it while pins hold', isPin }: MousePlace,
  isHandle: boolean,
): readonly MouseHint[] {
  if (isPin) {
    return [
      ['Move the pin', 'drag'],
      ['In depth', 'Alt+drag'],
      ['Remove it', 'click'],
      ['Select it', 'Shift+click'],
    ];
  }
  if (isHandle) return ON_HANDLE;
  if (joint !== undefined) {
    return [
      [`Pin ${joint}`, 'click'],
      [moves, 'drag'],
      ['Select it', 'Shift+click'],
      ['Add or remove', 'Ctrl+click'],
    ];
  }
  return [...CAMERA, ['Pin a point of the character', 'click']];
}

function inRig({ joint, isAdding }: MousePlace, isHandle: boolean): readonly MouseHint[] {
  if (isAdding) {
    return [
      ['Add a joint', 'click'],
      ['Without the grid', 'Shift+click'],
      ['Finish', 'Esc'],
    ];
  }
  if (joint !== undefined || isHandle) {
    return [
      [joint === undefined ? 'Move' : `Move ${joint}`, 'drag'],
      ['In depth', 'Alt+drag'],
      ['Without the grid', 'Shift+drag'],
      ['Add child', 'Ctrl+click'],
      ['Add to selection', 'Shift+click'],
    ];
  }
  return [...CAMERA, ['Edit a joint', 'click']];
}

/** The scrubber and the rulers. */
function inTime({ cursor, snapsToFrames }: MousePlace): readonly MouseHint[] {
  const snapping: MouseHint = [snapsToFrames ? 'Without snapping to frames' : 'Snapping to frames', 'Shift+drag'];
  if (cursor === 'ew-resize') return [['Move this end of the range, or this marker', 'drag'], snapping];
  return [['Change the current time', 'drag'], snapping, ['Zoom', 'wheel'], ['Fit', 'double-click']];
}

function inCurves(place: MousePlace): readonly MouseHint[] {
  const { cursor } = place;
  if (cursor === 'move' || cursor === 'copy') {
    return [
      ['Move selected keys', 'drag'],
      ['Only in time or in value', 'Shift+drag'],
      ['Snapping inverted', 'Ctrl+drag'],
      ['Menu', 'right click'],
    ];
  }
  if (cursor === 'pointer' || cursor === 'crosshair') {
    return [
      ['Select its keys', 'click'],
      ['Insert a key', 'double-click'],
      ['Change a tangent', 'drag its handle'],
      ['Menu', 'right click'],
    ];
  }
  if (cursor === 'col-resize') return inTime(place);
  return [
    ['Box select', 'drag'],
    ['Pan', 'middle drag or Alt+drag'],
    ['Zoom', 'wheel'],
    ['Zoom time only', 'Ctrl+wheel'],
    ['Menu', 'right click'],
  ];
}

function inDope(place: MousePlace): readonly MouseHint[] {
  const { cursor } = place;
  if (cursor === 'col-resize') return inTime(place);
  if (cursor === 'ew-resize') {
    return [
      ['Scale in time', 'drag'],
      ['About the current time', 'Alt+drag'],
    ];
  }
  if (cursor === 'move' || cursor === 'copy' || cursor === 'pointer') {
    return [
      ['Select', 'click'],
      ['Move selected keys', 'drag'],
      ['Ripple later keys', 'Alt+drag'],
      ['Drag a copy', 'Ctrl+drag'],
    ];
  }
  return [
    ['Box select', 'drag'],
    ['Pan', 'middle drag'],
    ['Zoom', 'wheel'],
    ['Scroll', 'Alt+wheel'],
    ['Menu', 'right click'],
  ];
}
