/**
 * The bar at the top right of the viewport: the style of skins or boxes, one menu of all switches of what is drawn, and
 * one of the camera. In little room the camera's is in the other.
 */

import { actionsOf, findAction, isEnabled } from '../../state/actions/action.ts';
import { itemOf, itemsOf, sectionsOf } from '../../state/actions/menu-entries.ts';
import { setActionTooltip } from '../../state/actions/tooltips.ts';
import type { Uses } from '../../state/workbench.ts';
import { element, keepsFocusElsewhere, setAttribute, write } from '../../widgets/dom.ts';
import { toolbar } from '../../widgets/focus/roving.ts';
import { type IconName, icon } from '../../widgets/icons.ts';
import { type MenuEntry, menuButton } from '../../widgets/menu.ts';
import { areBoxesVisible, drawnSkin, isSkinVisible, SKIN_STYLES } from './actions.ts';

type Parts = Uses<'store' | 'actions' | 'settings'>;

/** In the bar, where their labels have no room. */
const SHORT_LABELS: Readonly<Record<string, string>> = { heat: 'Weights', four: 'Four' };

/** Switches by what they are about, as the menu shows them; a path is a submenu. */
const SWITCHES: readonly (readonly [title: string, ids: readonly string[]])[] = [
  ['Draw', ['draw.bones', 'View/Boxes', 'draw.axes', 'draw.names', 'draw.characterNames', 'draw.normals']],
  ['Motion', ['view.ghosts', 'draw.trail']],
  ['Floor', ['draw.grid', 'draw.shadow', 'draw.floorAtLowest']],
];

/** A menu that is named by its text, which a small viewport hides. */
function barMenu(name: string, image: IconName, entries: () => readonly MenuEntry[]): HTMLButtonElement {
  const made = keepsFocusElsewhere(
    element('button', { type: 'button', class: 'tool text-tool', 'aria-label': name }, icon(image)),
  );
  made.append(element('span', {}, name), icon('fold'));
  menuButton(made, name, entries);
  return made;
}

export function displayBar(wb: Parts): HTMLElement {
  const bar = toolbar(element('div', { class: 'display-bar tools', 'aria-label': 'Display' }));
  const style = barMenu('Skin', 'skin', () => styleEntries(wb));
  style.classList.add('style-menu');
  setActionTooltip(wb, style, 'draw.nextSkin', () => style.ariaLabel ?? '');
  const camera = barMenu('Camera', 'perspective', () => cameraEntries(wb));
  camera.classList.add('camera-menu');
  // Laid out by the room of the stage, so that the menu asks what is shown.
  const hasCamera = () => camera.checkVisibility();
  const styles = (): MenuEntry => ({ kind: 'menu', label: style.ariaLabel ?? '', entries: () => styleEntries(wb) });
  const show = barMenu('Show', 'eye', () => [
    ...(style.hidden || style.checkVisibility() ? [] : [styles()]),
    ...switchEntries(wb),
    ...(hasCamera()
      ? []
      : [{ kind: 'line' } as const, { kind: 'menu', label: 'Camera', entries: () => cameraEntries(wb) } as const]),
  ]);
  bar.append(style, show, camera);
  const update = () => {
    const what = isSkinVisible(wb) ? 'skin' : areBoxesVisible(wb) ? 'boxes' : undefined;
    const hasCharacters = wb.store.document.characters.length > 0;
    write(style, 'hidden', what === undefined || !hasCharacters);
    const drawn = drawnSkin(wb);
    const label = SKIN_STYLES.find(([skin]) => skin === drawn)?.[1] ?? '';
    const text = what === 'boxes' ? 'Boxes' : (SHORT_LABELS[drawn] ?? label);
    if (style.textContent !== text)
      style.replaceChildren(icon(what ?? 'skin'), element('span', {}, text), icon('fold'));
    setAttribute(style, 'aria-label', what === 'boxes' ? text : `Skin: ${text}`);
  };
  wb.settings.subscribe(update);
  wb.store.subscribe((now, before) => {
    if (now.document.characters !== before.document.characters) update();
  });
  update();
  return bar;
}

/** Styles that what is open can be drawn in. */
function styleEntries(wb: Parts): readonly MenuEntry[] {
  const styles = isSkinVisible(wb) ? 'draw.skin.' : 'draw.boxes.';
  const possible = actionsOf(wb).filter((action) => action.id.startsWith(styles) && isEnabled(wb, action));
  return possible.map((action) => itemOf(wb, action));
}

/** All switches of what is drawn, with their keys. */
function switchEntries(wb: Parts): readonly MenuEntry[] {
  return SWITCHES.flatMap(([text, ids], i): MenuEntry[] => [
    ...(i > 0 ? [{ kind: 'line' } as const] : []),
    { kind: 'note', text },
    ...ids.flatMap((id) => switchEntry(wb, id)),
  ]);
}

function switchEntry(wb: Parts, id: string): readonly MenuEntry[] {
  const action = findAction(wb, id);
  if (!action) return sectionsOf(wb, [[id]]);
  return [{ ...itemOf(wb, action), icon: action.icon }];
}

/** Framing, views and what the camera follows. */
function cameraEntries(wb: Parts): readonly MenuEntry[] {
  // Keys that turn the camera step by step are no entries of a menu that closes.
  const views = actionsOf(wb).filter(({ menu, repeats }) => menu === 'View/Camera' && !repeats);
  return [...sectionsOf(wb, [['view.frameSelection', 'view.frameAll']]), { kind: 'line' }, ...itemsOf(wb, views)];
}
