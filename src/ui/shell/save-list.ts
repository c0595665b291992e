/** The save dialog: each character, and every file it can be saved as. */
import { type Character, shownClip, shownSkin } from '../../model/document.ts';
import { vertexCount } from '../../model/skin.ts';
import type { DialogContent } from '../kit/dialog.ts';
import { element } from '../kit/dom.ts';
import { icon } from '../kit/icons.ts';
import { plural } from '../kit/number-text.ts';
import { SAVE_KINDS, type SaveKind, type Workbench } from '../state/workbench.ts';
import { canSave, SAVE_LABELS } from './file-actions.ts';

export function saveList(wb: Workbench, close: () => void): DialogContent {
  const body = element('div', { class: 'save-list' });
  for (const character of wb.store.document.characters) {
    const row = element('div', { class: 'save-files' });
    for (const kind of SAVE_KINDS) {
      if (!canSave(character, kind)) continue;
      row.append(
        saveButton(SAVE_LABELS[kind], contents(character, kind, wb.transport.get().framesPerSecond), () => {
          close();
          wb.files.save(character.id, kind);
        }),
      );
    }
    row.append(
      saveButton('All of it (.zip)', 'with textures', () => {
        close();
        wb.files.saveAll(character.id);
      }),
    );
    body.append(element('section', {}, element('h3', {}, character.name), row));
  }
  if (!body.children.length) body.append(element('p', { class: 'empty' }, 'There is nothing to save yet.'));
  return { title: 'Save as', body, kind: 'save-dialog' };
}

function saveButton(label: string, detail: string, save: () => void): HTMLElement {
  const made = element(
    'button',
    { type: 'button', class: 'save-file' },
    icon('save'),
    element('span', {}, label),
    element('span', { class: 'faint' }, detail),
  );
  made.addEventListener('click', save);
  return made;
}

function contents(character: Character, kind: SaveKind, framesPerSecond: number): string {
  const skin = shownSkin(character);
  const clip = shownClip(character);
  switch (kind) {
    case 'skel':
    case 'axskel':
      return plural(character.skeleton?.joints.length ?? 0, 'joint');
    case 'skin':
      return skin ? plural(vertexCount(skin), 'vertex', 'vertices') : '';
    case 'morph':
      return plural(character.morphs.length, 'morph');
    case 'anim':
      return clip ? `${clip.name}, ${plural(clip.channels.length, 'channel')}` : '';
    case 'bvh': {
      const frames = clip?.samples?.frameCount;
      if (!clip) return 'the pose, 1 frame';
      return frames === undefined ? `at ${framesPerSecond} frames a second` : plural(frames, 'frame');
    }
    case 'pose':
      return plural(character.poses?.length ?? 0, 'pose');
    case 'rig':
      return 'which files belong together';
  }
}
