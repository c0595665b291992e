/**
 * The command search: a list box under a text field, built from the list of actions, the joints by their names, and the
 * DOFs of the selected joint.
 */

import { characterDofs } from '../../../model/skeleton/dofs.ts';
import { jointName } from '../../../model/skeleton/joint-name.ts';
import { namedChannel, spokenName } from '../../editors/timeline/channels.ts';
import {
  actionLabel,
  actionsOf,
  currentCharacter,
  isEnabled,
  reasonNot,
  tryAction,
} from '../../state/actions/action.ts';
import { selectedJoint } from '../../state/joints/selected-joint.ts';
import { openPanel } from '../../state/panels/panels.ts';
import { shortcutsFor, shortcutText } from '../../state/shortcuts.ts';
import type { Action, Uses } from '../../state/workbench.ts';
import type { DialogContent } from '../../widgets/dialog.ts';
import { element, setAttribute, uniqueId } from '../../widgets/dom.ts';
import { focusField } from '../../widgets/focus/focus-regions.ts';
import { isMac } from '../../widgets/focus/keyboard.ts';

const MAX_SHOWN = 12;
/** Of these at most, and as many DOFs. */
const MAX_JOINTS = 4;

export function commandSearch(wb: Uses<'actions' | 'settings' | 'store'>, close: () => void): DialogContent {
  const listId = uniqueId('commands');
  const input = element('input', {
    type: 'text',
    role: 'combobox',
    'aria-label': 'Find a command',
    'aria-expanded': 'true',
    'aria-controls': listId,
    'aria-autocomplete': 'list',
    placeholder: 'Find a command',
    spellcheck: 'false',
    autocomplete: 'off',
    autofocus: true,
  });
  const list = element('ul', { id: listId, role: 'listbox', 'aria-label': 'Commands' });
  let found: Action[] = [];
  let chosen = 0;

  const choose = (index: number) => {
    chosen = found.length ? (index + found.length) % found.length : 0;
    for (const [i, row] of [...list.children].entries()) {
      setAttribute(row, 'aria-selected', String(i === chosen));
      if (i === chosen) row.scrollIntoView({ block: 'nearest' });
    }
    if (found.length) setAttribute(input, 'aria-activedescendant', list.children[chosen].id);
    else input.removeAttribute('aria-activedescendant');
  };
  const run = (action: Action | undefined) => {
    if (!action) return;
    close();
    tryAction(wb, action);
  };
  const show = () => {
    const dofs = searchDofs(wb, input.value);
    const joints = searchJoints(wb, input.value);
    const rest = MAX_SHOWN - dofs.length - joints.length;
    found = [...dofs, ...searchActions(wb, input.value).slice(0, rest), ...joints];
    list.replaceChildren(...found.map((action) => row(wb, action, () => run(action))));
    if (!found.length) list.append(element('li', { class: 'empty' }, 'No matching command'));
    choose(0);
  };
  input.addEventListener('input', show);
  input.addEventListener('keydown', (event) => {
    if (event.key === 'ArrowDown') choose(chosen + 1);
    else if (event.key === 'ArrowUp') choose(chosen - 1);
    else if (event.key === 'Enter') run(found[chosen]);
    else return;
    event.preventDefault();
  });
  show();
  return { title: 'Find a command', body: element('div', {}, input, list), kind: 'search-dialog', bare: true };
}

/**
 * The actions that match what is typed. Behind those that can run, those that can't and say why not; none of these if
 * nothing is typed.
 */
export function searchActions(wb: Uses<'actions'>, typed: string): readonly Action[] {
  const all = actionsOf(wb).filter(({ id }) => id !== 'help.search');
  const find = (actions: readonly Action[]) =>
    findActions(
      actions,
      typed,
      (a) => longLabel(wb, a),
      (a) => TRAVELS.includes(a.id) || /^Delete\b/.test(actionLabel(wb, a)),
      // The manual calls it by its name, while its label says what it is for now.
      ({ also = '', name = '' }) => `${also} ${name}`,
    );
  const found = find(all.filter((a) => isEnabled(wb, a)));
  // What is called exactly so comes first.
  const isNamed = (a: Action) => actionLabel(wb, a).toLowerCase() === typed.trim().toLowerCase();
  const available = [...found.filter(isNamed), ...found.filter((a) => !isNamed(a))];
  if (!typed.trim()) return available;
  return [...available, ...find(all.filter((a) => !isEnabled(wb, a) && reasonNot(wb, a) !== undefined))];
}

/** Selects a joint of the current character that is called so, and moves the focus to the viewport; a few of them. */
export function searchJoints(wb: Uses<'store'>, typed: string): readonly Action[] {
  const character = currentCharacter(wb);
  const joints = character?.skeleton?.joints ?? [];
  if (!character || !typed.trim()) return [];
  const found = findActions([...joints.keys()], typed, (joint) => `Select joint ${joints[joint].name}`);
  return found.slice(0, MAX_JOINTS).map((joint) => ({
    id: `select.joint.${joint}`,
    label: `Select ${jointName(character.skeleton, joint)}`,
    group: 'Select',
    run({ store, viewport }) {
      store.select({ characterId: character.id, joint });
      viewport.canvas.focus({ preventScroll: true });
    },
  }));
}

/** Goes to the field of a DOF of the selected joint that is called so, where a value is typed. */
export function searchDofs(wb: Uses<'store'>, typed: string): readonly Action[] {
  const selected = selectedJoint(wb);
  const [name = ''] = typed.trim().toLowerCase().split(/\s/);
  if (!selected || name === '') return [];
  const { character, skeleton, joint } = selected;
  const dofs = [...characterDofs(skeleton, []).entries()].filter(([, dof]) => dof.joint === joint && dof.name === name);
  return dofs.slice(0, MAX_JOINTS).map(([index]) => ({
    id: `type.dof.${index}`,
    label: `Type ${spokenName(namedChannel(character, index))}`,
    group: 'Pose',
    run(at) {
      openPanel(at, 'inspector', true);
      focusField(`.inspector [data-dof="${index}"] input[type="text"]`);
    },
  }));
}

function row(wb: Uses<'actions' | 'settings'>, action: Action, run: () => void): HTMLElement {
  const [shortcut] = shortcutsFor(action, wb.settings.get());
  const reason = reasonNot(wb, action);
  const made = element(
    'li',
    { role: 'option', id: uniqueId('command'), 'aria-disabled': reason !== undefined && 'true' },
    element('span', { class: 'faint' }, placeOf(action)),
    element('span', {}, actionLabel(wb, action)),
    reason !== undefined && element('span', { class: 'reason' }, reason),
    shortcut && element('kbd', {}, shortcutText(shortcut, isMac)),
  );
  made.addEventListener('click', run);
  return made;
}

/** Its menu, or what it is about, with the panel that has its key. */
function placeOf({ menu, group, panel }: Action): string {
  return menu?.replace('/', ' › ') ?? (panel === undefined ? group : `${group}, in ${panel}`);
}

/** Their labels contain the name of another command, which should not match. */
const TRAVELS: readonly string[] = ['edit.undo', 'edit.redo'];

/** With its menu: "Hidden" alone says nothing. */
function longLabel(wb: Uses<'actions'>, action: Action): string {
  const label = (TRAVELS.includes(action.id) && action.name) || actionLabel(wb, action);
  return `${action.menu?.replace('/', ' ') ?? action.group} ${label}`;
}

/**
 * Actions whose label, or other words for it, have every typed word; first those with words that start so, in the label
 * before the other words.
 *
 * @param isLast sorts behind other matches, so that nobody undoes by accident
 */
export function findActions<A>(
  actions: readonly A[],
  typed: string,
  label: (action: A) => string,
  isLast: (action: A) => boolean = () => false,
  also: (action: A) => string = () => '',
): A[] {
  const words = typed.toLowerCase().split(/\s+/).filter(Boolean);
  const scored: { readonly action: A; readonly score: number }[] = [];
  for (const action of actions) {
    const own = label(action).toLowerCase();
    const other = also(action).toLowerCase();
    if (!words.every((word) => own.includes(word) || other.includes(word))) continue;
    scored.push({ action, score: 2 * beginnings(own, words) + beginnings(other, words) });
  }
  const place = ({ action }: { readonly action: A }) => (words.length && isLast(action) ? 1 : 0);
  return scored.sort((a, b) => b.score - a.score || place(a) - place(b)).map(({ action }) => action);
}

/** How many of the typed words a word of the text starts with. */
function beginnings(text: string, typed: readonly string[]): number {
  const parts = text.split(/[^\p{L}\p{N}]+/u);
  return typed.filter((word) => parts.some((part) => part.startsWith(word))).length;
}
