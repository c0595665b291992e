/** The About dialog. */

import type { Uses } from '../../state/workbench.ts';
import type { DialogContent } from '../../widgets/dialog.ts';
import { element, write } from '../../widgets/dom.ts';

export function aboutDialog(wb: Uses<'offline'>): DialogContent {
  const body = element(
    'div',
    { class: 'about' },
    element(
      'p',
      {},
      'A workbench for text-based character animation: skeletons, skins, morphs, keyframes and motion capture.',
    ),
    element('p', {}, 'Drop .bvh, .skel, .skin, .morph, .anim and .rig files anywhere, or a folder or zip of them.'),
    element('p', {}, 'Characters from other programs open too: .gltf, .glb, .vrm, .fbx.'),
    element('p', {}, 'Everything runs in this page. Nothing is uploaded.'),
    worksOffline(wb),
  );
  return { title: 'About Marrow', body, kind: 'about-dialog' };
}

/** Appears as soon as it does. */
function worksOffline({ offline }: Uses<'offline'>): HTMLElement {
  const line = element('p', {}, 'Works offline: the page is stored in this browser.');
  const show = () => {
    write(line, 'hidden', !offline.get().isReady);
  };
  const stop = offline.subscribe(() => {
    show();
    if (!line.isConnected) stop();
  });
  show();
  return line;
}
