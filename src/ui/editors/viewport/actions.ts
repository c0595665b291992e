/** Actions for camera and display. */

import { boolean, record } from '../../../edit/schema/shape.ts';
import { type Character, shownSkin } from '../../../model/document.ts';
import { baseName, sameName } from '../../../model/files.ts';
import type { BoxStyle, Display, SkinStyle } from '../../../model/session.ts';
import { hasBoxes } from '../../../model/skeleton/boxes.ts';
import { looksOf } from '../../../view/skin/skin-looks.ts';
import { needs } from '../../state/actions/needs.ts';
import type { Action, Uses } from '../../state/workbench.ts';
import type { IconName } from '../../widgets/icons.ts';

export const SKIN_STYLES: readonly (readonly [SkinStyle, string])[] = [
  ['textured', 'Textured'],
  ['solid', 'Solid'],
  ['wire', 'Wireframe'],
  ['xray', 'X-ray'],
  ['heat', 'Joint weights'],
  ['four', 'Four attachments'],
  ['hidden', 'Hidden'],
];

export const BOX_STYLES: readonly (readonly [BoxStyle, string])[] = [
  ['bare', 'When unskinned'],
  ['wire', 'Wireframe'],
  ['solid', 'Solid'],
  ['hidden', 'Hidden'],
];

/** Radians that a key turns the view, or a character in it. */
export const TURN = Math.PI / 36;

type Switch = { [K in keyof Display]: Display[K] extends boolean ? K : never }[keyof Display];

export function setDisplay(wb: Uses<'settings'>, change: Partial<Display>): void {
  wb.settings.update((s) => ({ ...s, display: { ...s.display, ...change } }));
}

/** Without characters, the style can still be chosen. */
function isAnyVisible(wb: Uses<'store'>, has: (character: Character) => boolean): boolean {
  const { characters } = wb.store.document;
  return characters.length === 0 || characters.some((c) => !c.isHidden && has(c));
}

export const isSkinVisible = (wb: Uses<'store'>) => isAnyVisible(wb, (c) => shownSkin(c) !== undefined);
export const areBoxesVisible = (wb: Uses<'store'>) =>
  isAnyVisible(wb, ({ skeleton }) => skeleton !== undefined && hasBoxes(skeleton));

/** Without one the style *Textured* draws the same as *Solid*. */
const isAnyTextured = (wb: Uses<'store'>) =>
  isAnyVisible(wb, (character) => {
    const skin = shownSkin(character);
    const isThere = (name: string) => character.textures.some((one) => sameName(one.name, baseName(name)));
    return (
      skin !== undefined && looksOf(skin).looks.some(({ texture, color }) => color || (texture && isThere(texture)))
    );
  });

/** The style that skins look like: the chosen one, but for textures where there are none. */
export function drawnSkin(wb: Uses<'store' | 'settings'>): SkinStyle {
  const { skin } = wb.settings.get().display;
  return skin === 'textured' && !isAnyTextured(wb) ? 'solid' : skin;
}

export const NO_SKIN = 'No visible character has a skin.';
export const NO_BOXES = 'No visible character has boxes; they are drawn as bones.';
const needsSkin = needs(NO_SKIN, isSkinVisible);
const needsTexture = needs('No visible skin has a texture or colours.', isAnyTextured);
const needsBoxed = needs(NO_BOXES, areBoxesVisible);

/** Without boxes only the choice of bones matters. */
const needsBoxes = (style: BoxStyle) => style === 'wire' || style === 'solid';
const skinStyles = (wb: Uses<'store'>) => SKIN_STYLES.filter(([style]) => style !== 'textured' || isAnyTextured(wb));
const boxStyles = (wb: Uses<'store'>) => BOX_STYLES.filter(([style]) => !needsBoxes(style) || areBoxesVisible(wb));

/** What scripts give to a switch. */
const SWITCH = record({ on: boolean });

export const VIEW_ACTIONS: readonly Action[] = [
  {
    id: 'view.frameSelection',
    label: 'Frame selection',
    group: 'Camera',
    menu: 'View',
    shortcuts: ['F'],
    icon: 'frame',
    run: (wb) => wb.viewport.camera.frameSelection(wb.store.selection),
  },
  {
    id: 'view.frameAll',
    label: 'Frame all',
    group: 'Camera',
    menu: 'View',
    shortcuts: ['A'],
    also: 'zoom fit home everything',
    run: (wb) => wb.viewport.camera.frameAll(),
  },
  look('front', 'Front', '1'),
  look('back', 'Back', 'Shift+1'),
  look('right', 'Right', '3'),
  look('left', 'Left', 'Shift+3'),
  look('top', 'Top', '7'),
  look('bottom', 'Bottom', 'Shift+7'),
  {
    ...toggle('orthographic', 'Orthographic', 'perspective', ['5'], 'View/Camera', 1),
    group: 'Camera',
    also: 'perspective projection parallel',
  },
  { ...toggle('follow', 'Follow joint', undefined, ['Shift+F'], 'View/Camera', 2), group: 'Camera' },
  { ...toggle('followRoot', 'Follow root', undefined, [], 'View/Camera', 2), group: 'Camera', also: 'camera tracks' },
  {
    ...toggle('inPlace', 'In place', undefined, [], 'View/Camera', 2),
    group: 'Camera',
    also: 'root motion treadmill',
  },
  orbit('Left', -1, 0),
  orbit('Right', 1, 0),
  orbit('Up', 0, -1),
  orbit('Down', 0, 1),
  ...SKIN_STYLES.map(
    ([skin, label]): Action => ({
      id: `draw.skin.${skin}`,
      label,
      group: 'Draw',
      menu: 'View/Skin',
      section: 1,
      radio: true,
      also: 'material shading wireframe texture heat map influences',
      ...(skin === 'heat' && { shortcuts: ['H'] }),
      refuses: (wb) => needsSkin(wb) ?? (skin === 'textured' ? needsTexture(wb) : undefined),
      explained: true,
      checked: (wb) => drawnSkin(wb) === skin,
      run: (wb) => setDisplay(wb, { skin }),
    }),
  ),
  {
    id: 'draw.nextSkin',
    label: 'Next skin style',
    group: 'Draw',
    shortcuts: ['S'],
    refuses: needsSkin,
    explained: true,
    run: (wb) => setDisplay(wb, { skin: following(skinStyles(wb), drawnSkin(wb)) }),
  },
  ...BOX_STYLES.map(
    ([boxes, label]): Action => ({
      id: `draw.boxes.${boxes}`,
      label,
      group: 'Draw',
      menu: 'View/Boxes',
      section: 1,
      radio: true,
      ...(needsBoxes(boxes) && { refuses: needsBoxed, explained: true }),
      checked: (wb) => wb.settings.get().display.boxes === boxes,
      run: (wb) => setDisplay(wb, { boxes }),
    }),
  ),
  {
    id: 'draw.nextBoxes',
    label: 'Next box style',
    group: 'Draw',
    shortcuts: ['B'],
    run: (wb) => setDisplay(wb, { boxes: following(boxStyles(wb), wb.settings.get().display.boxes) }),
  },
  { ...toggle('bones', 'Bones', 'bones', ['Shift+B']), also: 'skeleton' },
  toggle('axes', 'Joint axes', 'axes', ['X']),
  { ...toggle('names', 'Joint names', 'names', ['N']), also: 'labels' },
  toggle('characterNames', 'Character names', undefined, []),
  toggle('normals', 'Normals', 'normals', ['Shift+N']),
  { ...toggle('trail', 'Motion path', undefined, []), also: 'trail trajectory' },
  {
    ...toggle('ghosts', 'Onion skin', 'ghosts', ['Shift+O']),
    id: 'view.ghosts',
    also: 'ghosts',
    async run(wb, args) {
      if (typeof args === 'object') (await import('./show-ghosts.ts')).showGhosts(wb, args);
      else setDisplay(wb, { ghosts: !wb.settings.get().display.ghosts });
    },
  },
  { ...toggle('grid', 'Grid', 'grid', ['G']), also: 'floor ground background' },
  {
    id: 'view.steppedPreview',
    label: 'Stepped preview',
    group: 'Draw',
    menu: 'View',
    section: 2,
    also: 'blocking hold pose to pose',
    shortcuts: ['Shift+D'],
    checked: (wb) => wb.settings.get().display.stepped,
    run(wb, args) {
      // A shortcut says that it was a key.
      const toggles = args === undefined || args === 'key';
      const stepped = toggles ? !wb.settings.get().display.stepped : SWITCH.read(args, '').on;
      setDisplay(wb, { stepped });
    },
  },
  { ...toggle('shadow', 'Shadow', 'shadow', ['Shift+G']), also: 'light' },
  { ...toggle('floorAtLowest', 'Floor at lowest point', undefined, []), also: 'ground origin level' },
];

function look(from: 'front' | 'back' | 'left' | 'right' | 'top' | 'bottom', label: string, key: string): Action {
  return {
    id: `view.${from}`,
    label,
    group: 'Camera',
    menu: 'View/Camera',
    shortcuts: [key],
    run: (wb) => wb.viewport.camera.lookFrom(from),
  };
}

function orbit(way: 'Left' | 'Right' | 'Up' | 'Down', azimuth: number, polar: number): Action {
  return {
    id: `view.orbit${way}`,
    label: `Orbit ${way.toLowerCase()}`,
    group: 'Camera',
    menu: 'View/Camera',
    section: 3,
    shortcuts: [`Ctrl+${way}`],
    repeats: true,
    run: (wb) => wb.viewport.camera.turn(azimuth * TURN, polar * TURN),
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
