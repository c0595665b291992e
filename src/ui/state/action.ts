/** What an action is: one record behind a menu entry, a shortcut, a line of the `?` page and a scripted call. */
import { type Character, findCharacter } from '../../model/document.ts';
import type { IconName } from '../kit/icons.ts';
import type { Bindable } from './shortcuts.ts';
import type { Workbench } from './workbench.ts';

/** The menus, left to right. */
export const MENUS = ['Open', 'Save', 'Samples', 'Edit', 'Rig', 'Keys', 'View', 'Play', 'Help'] as const;
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

export interface Action extends Bindable {
  /** Stable: `play.toggle`. */
  readonly id: string;
  readonly label: string | ((wb: Workbench) => string);
  /** Where the label depends on something: what it is called apart from that. */
  readonly name?: string;
  /** A second line in the menu. */
  readonly detail?: string;
  readonly group: GroupName;
  /** `View`, or `View/Draw` for a menu within. Absent: only keys and search. */
  readonly menu?: MenuName | `${MenuName}/${string}`;
  /** A second menu that it stands in, for those who look for it there. */
  readonly alsoIn?: { readonly menu: MenuName; readonly section?: number };
  /** Entries of one menu with different sections have a line between them. */
  readonly section?: number;
  readonly icon?: IconName;
  /** A held key runs it again and again. */
  readonly repeats?: boolean;
  /** Always, where absent. */
  enabled?(wb: Workbench): boolean;
  /** Where it is not: the reason, in a sentence, in place of the detail. */
  whyNot?(wb: Workbench): string | undefined;
  /** Shows a tick; `radio` among alternatives. */
  checked?(wb: Workbench): boolean;
  readonly radio?: boolean;
  /** A promise where its script is fetched first. */
  run(wb: Workbench, args?: unknown): void | Promise<void>;
}

export function actionLabel(wb: Workbench, action: Action): string {
  return typeof action.label === 'string' ? action.label : action.label(wb);
}

export function isEnabled(wb: Workbench, action: Action): boolean {
  return action.enabled?.(wb) ?? true;
}

/** The character that is meant where none is named: the selected one, else the first. */
export function currentCharacter(wb: Workbench): Character | undefined {
  const { document, selection } = wb.store;
  return findCharacter(document, selection.characterId) ?? document.characters[0];
}
