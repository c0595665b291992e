/** The save dialog: each character, with every file format it can be saved as. */
import { type Character, shownClip, shownSkin } from '../../model/document.ts';
import { vertexCount } from '../../model/skin.ts';
import { FORMAT_KINDS, KINDS, type Kind } from '../../project/kinds.ts';
import type { DialogContent } from '../kit/dialog.ts';
import { element } from '../kit/dom.ts';
import { icon } from '../kit/icons.ts';
import { plural } from '../kit/number-text.ts';
import type { Uses } from '../state/workbench.ts';

export function saveList(wb: Uses<'store' | 'transport' | 'files'>, close: () => void): DialogContent {
  const body = element('div', { class: 'save-list' });
  for (const character of wb.store.document.characters) {
    const row = element('div', { class: 'save-files' });
    for (const kind of FORMAT_KINDS) {
      if (!KINDS[kind].has(character)) continue;
      row.append(
        saveButton(
          KINDS[kind].saveLabel,
          contents(character, KINDS[kind].content, wb.transport.get().framesPerSecond),
          () => {
            close();
            wb.files.save(character.id, kind);
          },
        ),
      );
    }
    row.append(
      saveButton('Everything (.zip)', 'with textures', () => {
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

function contents(character: Character, content: Kind['content'], framesPerSecond: number): string {
  const skin = shownSkin(character);
  const clip = shownClip(character);
  switch (content) {
    case 'skel':
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
      return frames === undefined ? `at ${framesPerSecond} frames per second` : plural(frames, 'frame');
    }
    case 'pose':
      return plural(character.poses?.length ?? 0, 'pose');
    case 'rig':
      return 'which files belong together';
  }
}
