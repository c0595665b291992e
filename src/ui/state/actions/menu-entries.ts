/** Builds menus from the list of actions. */
import { isMac } from '../../widgets/focus/keyboard.ts';
import type { MenuEntry, MenuItem } from '../../widgets/menu.ts';
import type { MenuName } from '../menus.ts';
import { ariaShortcut, shortcutsFor, shortcutText } from '../shortcuts.ts';
import type { Action, Uses } from '../workbench.ts';
import { actionLabel, actionsOf, isChecked, tryAction } from './action.ts';

/** A menu's current entries: build them when it opens. */
export function menuEntries(wb: Uses<'actions' | 'settings'>, menu: MenuName): MenuEntry[] {
  const actions = actionsOf(wb).flatMap((action) => inMenu(action, menu));
  if (!actions.length) return [{ kind: 'note', text: `This page has no ${menu.toLowerCase()}.` }];
  const entries: MenuEntry[] = [];
  const subMenus = new Set<string>();
  let section = actions[0].section ?? 0;
  for (const action of inSections(actions)) {
    const path = action.menu ?? '';
    if (subMenus.has(path)) continue;
    if ((action.section ?? 0) !== section && entries.length) entries.push({ kind: 'line' });
    section = action.section ?? 0;
    if (path === menu) {
      entries.push(itemOf(wb, action));
      continue;
    }
    subMenus.add(path);
    const within = actions.filter((a) => a.menu === path);
    entries.push({ kind: 'menu', label: path.slice(menu.length + 1), entries: () => itemsOf(wb, within) });
  }
  return entries;
}

/** The action as it appears in this menu; empty if it doesn't. */
function inMenu(action: Action, menu: MenuName): Action[] {
  if (action.menu === menu || action.menu?.startsWith(`${menu}/`)) return [action];
  const { alsoIn } = action;
  return alsoIn?.menu === menu ? [{ ...action, menu, section: alsoIn.section ?? 0 }] : [];
}

/** A submenu takes the place and section of its first entry. */
function inSections(actions: readonly Action[]): Action[] {
  const placeOf = (action: Action) => {
    const first = action.menu?.includes('/') ? actions.find((a) => a.menu === action.menu) : undefined;
    return (first ?? action).section ?? 0;
  };
  return [...actions].sort((a, b) => placeOf(a) - placeOf(b));
}

/** Entries of these actions, with a line where the section changes. */
export function itemsOf(wb: Uses<'actions' | 'settings'>, actions: readonly Action[]): MenuEntry[] {
  const entries: MenuEntry[] = [];
  let before: Action | undefined;
  for (const action of actions) {
    if (before && before.section !== action.section) entries.push({ kind: 'line' });
    entries.push(itemOf(wb, action));
    before = action;
  }
  return entries;
}

/**
 * Entries of a context menu, with lines between the sections: actions by id, submenus of a menu by their path
 * (`View/Skin`), and entries of its own. Ids of actions that don't exist are left out.
 */
export function sectionsOf(
  wb: Uses<'actions' | 'settings'>,
  sections: readonly (readonly (string | MenuEntry)[])[],
): MenuEntry[] {
  const actions = actionsOf(wb);
  const entriesOf = (one: string | MenuEntry): MenuEntry[] => {
    if (typeof one !== 'string') return [one];
    const [, label] = one.split('/');
    const within = label ? actions.filter((action) => action.menu === one) : [];
    if (label && within.length) return [{ kind: 'menu', label, entries: () => itemsOf(wb, within) }];
    return actions.filter((action) => action.id === one).map((action) => itemOf(wb, action));
  };
  return sections
    .map((section) => section.flatMap(entriesOf))
    .filter((entries) => entries.length > 0)
    .flatMap((entries, i): MenuEntry[] => (i > 0 ? [{ kind: 'line' }, ...entries] : entries));
}

export function itemOf(wb: Uses<'actions' | 'settings'>, action: Action): MenuItem {
  const [shortcut] = shortcutsFor(action, wb.settings.get());
  const reason = wb.actions.refusal(action);
  return {
    kind: 'item',
    label: actionLabel(wb, action),
    detail: (action.explained ? reason : undefined) ?? action.detail,
    shortcut: shortcut && shortcutText(shortcut, isMac),
    ariaShortcut: shortcut && ariaShortcut(shortcut, isMac),
    enabled: reason === undefined,
    checked: isChecked(wb, action),
    radio: action.radio,
    run: () => tryAction(wb, action),
    refuse: () => tryAction(wb, action),
  };
}
