/**
 * `marrow/viewer`: the element `<marrow-viewer>`, with three.js as a peer. Importing it defines the element.
 *
 *     import 'marrow/viewer';
 *
 * [The element](../guide/element.md) says what its attributes, properties and events are.
 */
import { MarrowViewer } from '../viewer/element.ts';

export { MarrowViewer, type ReadDetail, type ViewedFile } from '../viewer/element.ts';

declare global {
  interface HTMLElementTagNameMap {
    'marrow-viewer': MarrowViewer;
  }
}

if (globalThis.customElements && !customElements.get('marrow-viewer')) {
  customElements.define('marrow-viewer', MarrowViewer);
}
