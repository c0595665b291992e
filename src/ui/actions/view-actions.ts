/** The camera, and what is drawn. */
import type { BoxStyle, Display, SkinStyle } from '../../model/session.ts';
import type { IconName } from '../icons.ts';
import type { Workbench } from '../workbench.ts';
import type { Action } from './action.ts';

export const SKIN_STYLES: readonly (readonly [SkinStyle, string])[] = [
  ['textured', 'Textured'],
  ['solid', 'Solid'],
  ['wire', 'Wire'],
  ['xray', 'X-ray'],
  ['heat', 'Influence of the joint'],
  ['hidden', 'Hidden'],
];

export const BOX_STYLES: readonly (readonly [BoxStyle, string])[] = [
  ['bare', 'Unless skinned'],
  ['wire', 'Wire'],
  ['solid', 'Solid'],
  ['hidden', 'Hidden'],
];

type Switch = { [K in keyof Display]: Display[K] extends boolean ? K : never }[keyof Display];

export function setDisplay(wb: Workbench, change: Partial<Display>): void {
  wb.settings.update((s) => ({ ...s, display: { ...s.display, ...change } }));
}

export const VIEW_ACTIONS: readonly Action[] = [
  {
    id: 'view.frameSelection',
    label: 'Frame selection',
    group: 'Camera',
    menu: 'View',
    shortcuts: ['F'],
    icon: 'frame',
    run: (wb) => wb.viewport.frameSelection(wb.store.selection),
  },
  {
    id: 'view.frameAll',
    label: 'Frame all',
    group: 'Camera',
    menu: 'View',
    shortcuts: ['A'],
    run: (wb) => wb.viewport.frameAll(),
  },
  look('front', 'Front', '1'),
  look('back', 'Back', 'Shift+1'),
  look('right', 'Right', '3'),
  look('left', 'Left', 'Shift+3'),
  look('top', 'Top', '7'),
  look('bottom', 'Bottom', 'Shift+7'),
  { ...toggle('orthographic', 'Orthographic', 'perspective', ['5'], 'View/Camera', 1), group: 'Camera' },
  { ...toggle('follow', 'Follow the joint', undefined, ['Shift+F'], 'View/Camera', 2), group: 'Camera' },
  { ...toggle('inPlace', 'In place', undefined, [], 'View/Camera', 2), group: 'Camera' },
  ...SKIN_STYLES.map(
    ([skin, label]): Action => ({
      id: `draw.skin.${skin}`,
      label,
      group: 'Draw',
      menu: 'View/Skin',
      section: 1,
      radio: true,
      ...(skin === 'heat' && { shortcuts: ['H'] }),
      checked: (wb) => wb.settings.get().display.skin === skin,
      run: (wb) => setDisplay(wb, { skin }),
    }),
  ),
  {
    id: 'draw.nextSkin',
    label: 'Next skin style',
    group: 'Draw',
    shortcuts: ['S'],
    run: (wb) => setDisplay(wb, { skin: following(SKIN_STYLES, wb.settings.get().display.skin) }),
  },
  ...BOX_STYLES.map(
    ([boxes, label]): Action => ({
      id: `draw.boxes.${boxes}`,
      label,
      group: 'Draw',
      menu: 'View/Boxes',
      section: 1,
      radio: true,
      checked: (wb) => wb.settings.get().display.boxes === boxes,
      run: (wb) => setDisplay(wb, { boxes }),
    }),
  ),
  {
    id: 'draw.nextBoxes',
    label: 'Next box style',
    group: 'Draw',
    shortcuts: ['B'],
    run: (wb) => setDisplay(wb, { boxes: following(BOX_STYLES, wb.settings.get().display.boxes) }),
  },
  toggle('bones', 'Bones', 'bones', ['Shift+B']),
  toggle('axes', 'Joint axes', 'axes', ['X']),
  toggle('names', 'Names', 'names', ['N']),
  toggle('normals', 'Normals', 'normals', ['Shift+N']),
  toggle('trail', 'Trail of the joint', undefined, []),
  toggle('ghosts', 'Ghosts before and after', 'ghosts', ['Shift+O']),
  toggle('grid', 'Grid', 'grid', ['G']),
  toggle('shadow', 'Shadow', 'shadow', ['Shift+G']),
];

function look(from: 'front' | 'back' | 'left' | 'right' | 'top' | 'bottom', label: string, key: string): Action {
  return {
    id: `view.${from}`,
    label,
    group: 'Camera',
    menu: 'View/Camera',
    shortcuts: [key],
    run: (wb) => wb.viewport.lookFrom(from),
  };
}

function toggle(
  what: Switch,
  label: string,
  icon: IconName | undefined,
  shortcuts: readonly string[],
  menu: NonNullable<Action['menu']> = 'View',
  section = 2,
): Action {
  return {
    id: `draw.${what}`,
    label,
    group: 'Draw',
    menu,
    section,
    ...(shortcuts.length > 0 && { shortcuts }),
    ...(icon && { icon }),
    checked: (wb) => wb.settings.get().display[what],
    run: (wb) => setDisplay(wb, { [what]: !wb.settings.get().display[what] }),
  };
}

function following<T>(list: readonly (readonly [T, string])[], now: T): T {
  const index = list.findIndex(([value]) => value === now);
  return list[(index + 1) % list.length][0];
}
