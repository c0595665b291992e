/** How actions are organised: menus, and headings of the `?` page. */

/** The menus, left to right. */
export const MENUS = ['Open', 'Save', 'Examples', 'Edit', 'Rig', 'Keys', 'View', 'Play', 'Help'] as const;
export type MenuName = (typeof MENUS)[number];

/** The headings of the `?` page. */
export const GROUPS = [
  'Files',
  'Edit',
  'Select',
  'Pose',
  'Rig',
  'Keys',
  'Curves',
  'Play',
  'Camera',
  'Draw',
  'Page',
] as const;
export type GroupName = (typeof GROUPS)[number];
