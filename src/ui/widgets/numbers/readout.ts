/** A line of text beside the pointer during a drag; not for screen readers. */
import { element, setStyle, setText, write } from '../dom.ts';

/** CSS pixels. */
const BESIDE = 16;

export class Readout {
  readonly element = element('div', { class: 'hand-readout', 'aria-hidden': 'true', hidden: true });
  private readonly value = element('span');
  private readonly note = element('span', { class: 'hand-note' });

  /** @param container the element that contains the viewport */
  constructor(private readonly container: HTMLElement) {
    this.element.append(this.value, this.note);
    container.append(this.element);
  }

  /** @param note what limits the drag, if anything */
  show(clientX: number, clientY: number, value: string, note = ''): void {
    const { left, top, width, height } = this.container.getBoundingClientRect();
    write(this.element, 'hidden', false);
    setText(this.value, value);
    setText(this.note, note);
    write(this.note, 'hidden', note === '');
    const x = Math.min(clientX - left + BESIDE, width - this.element.offsetWidth - 4);
    const y = Math.min(clientY - top + BESIDE, height - this.element.offsetHeight - 4);
    setStyle(this.element, 'transform', `translate(${Math.round(x)}px, ${Math.round(y)}px)`);
  }

  hide(): void {
    write(this.element, 'hidden', true);
  }

  remove(): void {
    this.element.remove();
  }
}
