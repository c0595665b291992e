/** The shortcuts to learn first, for the `?` page and the manual. */

export interface EssentialShortcut {
  readonly what: string;
  /** Actions, each shown by its first key. */
  readonly ids?: readonly string[];
  /** What the mouse does instead. */
  readonly how?: string;
}

export interface Essentials {
  /** A heading. */
  readonly where: string;
  readonly lines: readonly EssentialShortcut[];
}

export const ESSENTIALS: readonly Essentials[] = [
  {
    where: 'Anywhere',
    lines: [
      { what: 'Play or pause', ids: ['play.toggle'] },
      { what: 'Previous, next frame', ids: ['play.stepBack', 'play.stepForward'] },
      { what: 'Previous, next key', ids: ['play.previousKey', 'play.nextKey'] },
      { what: 'Undo, redo', ids: ['edit.undo', 'edit.redo'] },
      { what: 'Find a command', ids: ['help.search'] },
      { what: 'Save changes', ids: ['save.changed'] },
      { what: 'Next panel', ids: ['page.nextPanel'] },
      { what: 'This page', ids: ['help.shortcuts'] },
      { what: 'Manual for what has the focus', ids: ['help.manual'] },
    ],
  },
  {
    where: 'Look',
    lines: [
      { what: 'Orbit, pan, dolly', how: 'drag, right drag, wheel' },
      { what: 'Frame selection, frame all', ids: ['view.frameSelection', 'view.frameAll'] },
      { what: 'Front, right, top', ids: ['view.front', 'view.right', 'view.top'] },
      { what: 'Bones, joint names', ids: ['draw.bones', 'draw.names'] },
    ],
  },
  {
    where: 'Pose',
    lines: [
      { what: 'Switch between FK and IK', ids: ['posing.toggle'] },
      { what: 'Key what changed', ids: ['key.changed'] },
      { what: 'Key whole pose', ids: ['key.pose'] },
      { what: 'Mirror pose', ids: ['pose.mirror'] },
      { what: 'Reset to file pose', ids: ['pose.resetToFile'] },
    ],
  },
  {
    where: 'Curves',
    lines: [
      { what: 'Show or hide the timeline', ids: ['page.timeline'] },
      { what: 'Insert a key', how: 'double-click on a curve' },
      {
        what: 'Flat, linear, smooth, auto tangents, step',
        ids: ['flat', 'linear', 'smooth', 'auto', 'step'].map((kind) => `timeline.tangents.${kind}`),
      },
      { what: 'Fit selected keys, fit all', ids: ['timeline.fitSelected', 'timeline.fitAll'] },
      { what: 'Delete selected keys', ids: ['timeline.delete'] },
    ],
  },
];
