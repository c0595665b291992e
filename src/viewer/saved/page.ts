/** The viewer of a saved page: the element, which reads the files of the page. */
import { numbersIn } from '../../view/camera/view-numbers.ts';
import { MarrowViewer, type ViewedFile } from '../element.ts';
import { unpack } from './unpack.ts';

/** As `files/web-page/web-page.ts` writes them. */
async function filesOfPage(): Promise<readonly ViewedFile[]> {
  const parts = [...document.querySelectorAll<HTMLElement>('pre[data-file], pre[data-packed]')];
  return Promise.all(
    parts.map(async ({ dataset: { file, packed = '' }, textContent }) =>
      file === undefined ? { name: packed, content: await unpack(textContent) } : { name: file, content: textContent },
    ),
  );
}

/** In a window that is narrower than the picture was, such as a phone's, the camera steps back: nothing is cut off. */
function fitWidth(viewer: HTMLElement): void {
  const camera = numbersIn(viewer.getAttribute('camera') ?? '', 6);
  const factor = (Number(viewer.dataset.aspect) * innerHeight) / innerWidth;
  if (!camera || !(factor > 1)) return;
  const [, , , ...target] = camera;
  const from = target.map((at, axis) => at + factor * (camera[axis] - at));
  viewer.setAttribute('camera', [...from, ...target].join(','));
}

const viewer = document.querySelector<MarrowViewer>('marrow-viewer');
if (viewer) {
  fitWidth(viewer);
  customElements.define('marrow-viewer', MarrowViewer);
  void filesOfPage().then((files) => viewer.showFiles(files));
}
