/** The manual in the inspector's place: pages as the build makes them, with a way back, to the contents, and out. */

import { addressOf, MANUAL_WINDOW, type ManualPage } from '../../state/manual-link.ts';
import { button, element, setAttribute, write } from '../../widgets/dom.ts';
import { icon } from '../../widgets/icons.ts';

const FAILED = 'The manual could not be loaded. Reloading the page may help.';

export class ManualPanel {
  private readonly text = element('article', { class: 'manual-text scrolls', tabindex: 0, 'aria-label': 'Page' });
  /** Addresses; the last one is shown. */
  private readonly visited: string[] = [];
  private readonly back = button('Previous page', { class: 'tool' }, icon('undo'), () => {
    this.visited.pop();
    const before = this.visited.pop();
    if (before) void this.open(before);
  });
  readonly element = element(
    'section',
    { class: 'manual', 'aria-label': 'Manual', 'data-panel': 'manual' },
    element(
      'div',
      { class: 'manual-head' },
      element('h2', {}, 'Manual'),
      this.back,
      button('Contents', { class: 'tool' }, icon('menu'), () => this.show('index.html')),
      button('Open in a window', { class: 'tool' }, icon('window'), () => {
        window.open(this.visited.at(-1), MANUAL_WINDOW);
        this.close();
      }),
      button('Close manual', { class: 'tool' }, icon('close'), () => this.close()),
    ),
    this.text,
  );

  constructor(private readonly close: () => void) {
    this.element.addEventListener('keydown', (event) => {
      if (event.key !== 'Escape' || event.defaultPrevented) return;
      event.preventDefault();
      close();
    });
    this.text.addEventListener('click', (event) => this.follow(event));
  }

  show(page: ManualPage): void {
    void this.open(new URL(addressOf(page), document.baseURI).href);
  }

  private async open(address: string): Promise<void> {
    this.visited.push(address);
    write(this.back, 'disabled', this.visited.length < 2);
    const [path = '', anchor = ''] = address.split('#');
    const content = await read(path).catch(() => undefined);
    // Another was asked for meanwhile.
    if (this.visited.at(-1) !== address) return;
    const shown = content?.querySelector('main');
    this.text.replaceChildren(...(shown ? shown.childNodes : [element('p', {}, FAILED)]));
    this.text.scrollTop = 0;
    this.text.querySelector(`[data-anchor="${CSS.escape(decodeURIComponent(anchor))}"]`)?.scrollIntoView();
  }

  /** Links within the manual are followed here, and others in windows. */
  private follow(event: MouseEvent): void {
    const link = event.target instanceof Element ? event.target.closest('a') : null;
    if (!link || event.ctrlKey || event.metaKey || event.shiftKey) return;
    event.preventDefault();
    if (/\.html(#|$)/.test(link.href) && link.href.startsWith(new URL('manual/', document.baseURI).href)) {
      void this.open(link.href);
      // The link is gone, and the keyboard would be nowhere.
      this.text.focus({ preventScroll: true });
    } else window.open(link.href, '_blank', 'noopener');
  }
}

/**
 * A page of the manual, whose addresses are whole and whose anchors can't be mistaken for elements of this page. It is
 * read as a document, since the page makes none from text (`plugins/policy.ts`).
 */
function read(address: string): Promise<Document> {
  return new Promise((resolve, reject) => {
    const request = new XMLHttpRequest();
    request.open('GET', address);
    request.responseType = 'document';
    request.addEventListener('loadend', () => {
      const content = request.responseXML;
      if (request.status >= 400 || !content) return reject(new Error(`${address} answered ${request.status}.`));
      for (const link of content.querySelectorAll('a')) setAttribute(link, 'href', link.href);
      for (const image of content.querySelectorAll('img')) setAttribute(image, 'src', image.src);
      for (const one of content.querySelectorAll<HTMLElement>('[id]')) {
        write(one.dataset, 'anchor', one.id);
        one.removeAttribute('id');
      }
      resolve(content);
    });
    request.send();
  });
}
