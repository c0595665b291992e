/** The About dialog. */
import type { DialogContent } from '../kit/dialog.ts';
import { element } from '../kit/dom.ts';

export function aboutDialog(): DialogContent {
  const body = element(
    'div',
    { class: 'about' },
    element(
      'p',
      {},
      'A workbench for text-based character animation: skeletons, skins, morphs, keyframes and motion capture.',
    ),
    element('p', {}, 'Drop .bvh, .skel, .skin, .morph, .anim and .rig files anywhere, in folders or a zip.'),
    element('p', {}, 'Everything runs in this page. Nothing is uploaded.'),
  );
  return { title: 'About Marrow', body, kind: 'about-dialog' };
}
