/** The bar at the top: menus on the left, what is loaded on the right. */
import { cutName } from '../../edit/cut-name.ts';
import { type Document, shownSkin, shownTake } from '../../model/document.ts';
import { arePoints } from '../../model/skeleton/joint-types.ts';
import { vertexCount } from '../../model/skin.ts';
import { tryById } from '../state/actions/action.ts';
import { menuEntries } from '../state/actions/menu-entries.ts';
import { keyNameOf, setActionTooltip } from '../state/actions/tooltips.ts';
import { MENUS, type MenuName } from '../state/menus.ts';
import { isPanelOpen, NARROW } from '../state/panels/panels.ts';
import type { Uses } from '../state/workbench.ts';
import { button, element, keepsFocusElsewhere, setAttribute, setText, write } from '../widgets/dom.ts';
import { icon } from '../widgets/icons.ts';
import { type Menu, menuButton, openMenu } from '../widgets/menu.ts';
import { bytes, plural } from '../widgets/numbers/number-text.ts';
import { setTooltip } from '../widgets/tooltip.ts';
import { undoButtons } from './undo-buttons.ts';

export function menuBar(wb: Uses<'store' | 'actions' | 'settings' | 'loading' | 'files'>): HTMLElement {
  const bar = element('div', { role: 'menubar', 'aria-label': 'Menus', class: 'menu-titles' });
  const titles = MENUS.map((name) =>
    element('button', { type: 'button', role: 'menuitem', 'aria-haspopup': 'menu', 'aria-expanded': 'false' }, name),
  );
  titles.forEach((title, i) => {
    write(title, 'tabIndex', i === 0 ? 0 : -1);
  });
  bar.append(...titles);
  letMenusDrop(wb, bar, titles);
  return element(
    'header',
    { class: 'menu-bar' },
    panelButton(wb, 'page.outliner', 'Outliner', 'outliner'),
    element('h1', { class: 'brand' }, icon('bones'), 'Marrow'),
    bar,
    allMenus(wb),
    undoButtons(wb),
    findButton(wb),
    element('div', { class: 'menu-end' }, whatIsUnsaved(wb), whatIsLoaded(wb)),
    panelButton(wb, 'page.inspector', 'Inspector', 'inspector'),
  );
}

function letMenusDrop(wb: Uses<'actions' | 'settings'>, bar: HTMLElement, titles: readonly HTMLButtonElement[]): void {
  let shown: { readonly index: number; readonly menu: Menu } | undefined;

  const focusTitle = (index: number) => {
    for (const [i, title] of titles.entries()) write(title, 'tabIndex', i === index ? 0 : -1);
    titles[index].focus();
  };
  const show = (index: number, focusFirst: boolean) => {
    const title = titles[index];
    const menu = openMenu(title.getBoundingClientRect(), menuEntries(wb, MENUS[index]), {
      label: MENUS[index] satisfies MenuName,
      opener: title,
      opensByClick: true,
      focusFirst,
      onClose() {
        setAttribute(title, 'aria-expanded', 'false');
        shown = undefined;
      },
      onLeave: (step) => show((index + step + titles.length) % titles.length, true),
    });
    setAttribute(title, 'aria-expanded', 'true');
    for (const other of titles) write(other, 'tabIndex', other === title ? 0 : -1);
    shown = { index, menu };
  };

  titles.forEach((title, index) => {
    title.addEventListener('click', (event) => {
      if (shown?.index === index) shown.menu.close(true);
      else show(index, event.detail === 0);
    });
    title.addEventListener('pointerenter', () => {
      if (shown && shown.index !== index) show(index, false);
    });
    title.addEventListener('keydown', (event) => {
      const step = event.key === 'ArrowRight' ? 1 : event.key === 'ArrowLeft' ? -1 : 0;
      if (step) focusTitle((index + step + titles.length) % titles.length);
      else if (event.key === 'ArrowDown') show(index, true);
      else return;
      event.preventDefault();
    });
  });
  keepsFocusElsewhere(bar);
}

/** On a page too narrow for the titles: all menus, below one button. */
function allMenus(wb: Uses<'actions' | 'settings'>): HTMLElement {
  const made = button('Menu', { class: 'tool text-tool all-menus' }, icon('menu'), () => {});
  made.append(element('span', {}, 'Menu'));
  menuButton(made, 'Menu', () =>
    MENUS.map((label) => ({ kind: 'menu', label, entries: () => menuEntries(wb, label) })),
  );
  return keepsFocusElsewhere(made);
}

/** The visible door to all commands. */
function findButton(wb: Uses<'actions' | 'settings'>): HTMLElement {
  const made = keepsFocusElsewhere(
    button('Find a command', { class: 'tool text-tool find-button', tooltip: undefined }, icon('search'), () =>
      tryById(wb, 'help.search'),
    ),
  );
  made.append(element('span', {}, 'Find'));
  // Drawn by the style sheet: as text it would be missing from the button's name.
  const show = () => setAttribute(made, 'data-key', keyNameOf(wb, 'help.search'));
  wb.settings.subscribe(show);
  show();
  return made;
}

function panelButton(
  wb: Uses<'actions' | 'settings'>,
  id: string,
  label: string,
  name: 'outliner' | 'inspector',
): HTMLButtonElement {
  const made = keepsFocusElsewhere(
    button(`${label} panel`, { class: `tool panel-button ${name}-button` }, icon(name), () => tryById(wb, id)),
  );
  const show = () => {
    setAttribute(made, 'aria-pressed', String(isPanelOpen(wb.settings.get(), name)));
  };
  setActionTooltip(wb, made, id, `${label} panel`);
  wb.settings.subscribe(show);
  window.matchMedia(NARROW).addEventListener('change', show);
  show();
  return made;
}

/** Unsaved parts, and the button that saves them. */
function whatIsUnsaved(wb: Uses<'actions' | 'settings' | 'files'>): HTMLElement {
  const names = element('span');
  // On a narrow page only the mark is visible, and the word is for screen readers.
  const word = element('span', { class: 'unsaved-word' }, 'Unsaved: ');
  const text = element('span', { class: 'unsaved-text', role: 'status' }, word, names);
  const save = keepsFocusElsewhere(
    button('Save changes', { class: 'link' }, 'Save', () => tryById(wb, 'save.changed')),
  );
  setActionTooltip(wb, save, 'save.changed', 'Save changes');
  const all = element('div', { class: 'unsaved' }, text, save);
  const show = () => {
    const parts = wb.files.unsaved.get();
    // Appears without moving anything else.
    write(all, 'hidden', parts.length === 0);
    setText(names, unsavedNames(parts));
    setTooltip(text, `Unsaved:\n${parts.map(({ name }) => name).join('\n')}`);
  };
  wb.files.unsaved.subscribe(show);
  show();
  return all;
}

/** `wasp_walk.anim`; `wasp.skel and 2 more`. */
function unsavedNames(parts: readonly { readonly name: string }[]): string {
  const [first, ...others] = parts;
  if (!first) return '';
  return `${first.name}${others.length ? ` and ${others.length} more` : ''}`;
}

/** On the right: what is loaded, or the progress of loading, in the same place so that nothing shifts. */
function whatIsLoaded(wb: Uses<'store' | 'loading'>): HTMLElement {
  const text = element('span', { class: 'loaded-text' });
  const bar = element('progress', { class: 'loaded-progress', 'aria-label': 'Reading', max: 1, hidden: true });
  const cancel = button('Cancel', { class: 'link', hidden: true }, 'Cancel', () => wb.loading.get()?.cancel());
  const show = () => {
    const loading = wb.loading.get();
    for (const each of [bar, cancel]) write(each, 'hidden', loading === undefined);
    if (!loading) {
      showLoaded(text, wb.store.document);
      return;
    }
    setText(text, `Reading ${loading.label}, ${bytes(loading.done)}${loading.of ? ` of ${bytes(loading.of)}` : ''}`);
    if (loading.of) bar.value = loading.done / loading.of;
    else bar.removeAttribute('value');
  };
  wb.loading.subscribe(show);
  wb.store.subscribe((now, before) => {
    if (now.document !== before.document) show();
  });
  show();
  return element('div', { class: 'loaded', role: 'status' }, text, bar, cancel);
}

/** Part by part, since a phone has room for one: the take, else the name. */
function showLoaded(text: HTMLElement, document: Document): void {
  const { example, name, facts, take } = loadedText(document, cutName);
  const parts = [
    element('span', { class: 'loaded-facts' }, example),
    element('span', { class: facts || take ? 'loaded-name' : '' }, name),
    element('span', { class: 'loaded-facts' }, facts),
    element('span', { class: 'loaded-take' }, take),
  ];
  const whole = loadedText(document);
  // Told to screen readers, so only when it changes.
  if (text.textContent === parts.map((part) => part.textContent).join('')) return;
  text.replaceChildren(...parts);
  setTooltip(text, [whole.example + whole.name + whole.facts, whole.take].filter(Boolean).join(' · '));
}

interface Loaded {
  /** `Example: `, or empty. */
  readonly example: string;
  readonly name: string;
  /** ` · 31 joints · 1,042 vertices`. */
  readonly facts: string;
  /** Of the only character; empty if it has none. */
  readonly take: string;
}

/** Long names would hide what follows them, so `cut` may shorten them. */
function loadedText(document: Document, cut = (name: string) => name): Loaded {
  const { characters, review } = document;
  const one = characters.length === 1 ? characters[0] : undefined;
  if (!characters.length) {
    const name = review ? `${plural(review.length, 'take')} in review` : 'Nothing is open';
    return { example: '', name, facts: '', take: '' };
  }
  const joints = characters.reduce((sum, c) => sum + (c.skeleton?.joints.length ?? 0), 0);
  const isPoints = characters.every(({ skeleton }) => arePoints(skeleton));
  const vertices = characters.reduce((sum, c) => sum + (shownSkinSize(c) ?? 0), 0);
  return {
    example: document.isOpeningSample ? 'Example: ' : '',
    name: one ? cut(one.name) : plural(characters.length, 'character'),
    facts:
      (joints ? ` · ${plural(joints, isPoints ? 'point' : 'joint')}` : '') +
      (vertices ? ` · ${plural(vertices, 'vertex', 'vertices')}` : ''),
    take: cut((one && shownTake(one)?.name) ?? ''),
  };
}

function shownSkinSize(character: Document['characters'][number]): number | undefined {
  const skin = shownSkin(character);
  return skin && vertexCount(skin);
}
