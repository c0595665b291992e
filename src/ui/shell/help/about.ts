/** The About dialog. */

import { FORMAT_KINDS, type FormatKind, isSaved, KINDS, type Kind } from '../../../files/kinds.ts';
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
    element('p', {}, `Drop ${extensionsOf(isSaved)} files anywhere, or a folder or zip of them.`),
    element('p', {}, `Files of other programs open too: ${extensionsOf((kind) => !isSaved(kind))}.`),
    element('p', {}, 'Everything runs in this page. Nothing is uploaded.'),
    worksOffline(wb),
  );
  return { title: 'About Marrow', body, kind: 'about-dialog' };
}

/** `.skel, .skin, …`: of the kinds that are opened as characters or as parts of them. */
function extensionsOf(isListed: (kind: FormatKind) => boolean): string {
  const listed = FORMAT_KINDS.map((kind): Kind & { readonly isListed: boolean } => ({
    ...KINDS[kind],
    isListed: isListed(kind),
  })).filter((kind) => kind.isListed && !kind.isRare && kind.content !== 'texture');
  return listed.flatMap(({ extensions }) => extensions.map((extension) => `.${extension}`)).join(', ');
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
