/** A small line beside the pointer while something is dragged: for the eye alone, and gone with the drag. */
import { element, setText } from './dom.ts';

/** CSS pixels. */
const BESIDE = 16;

export class Readout {
  readonly element = element('div', { class: 'hand-readout', 'aria-hidden': 'true', hidden: true });
  private readonly value = element('span');
  private readonly note = element('span', { class: 'hand-note' });

  /** @param container what it stands in, which the viewport fills */
  constructor(private readonly container: HTMLElement) {
    this.element.append(this.value, this.note);
    container.append(this.element);
  }

  /** @param note what is in the way, if anything */
  show(clientX: number, clientY: number, value: string, note = ''): void {
    const { left, top, width, height } = this.container.getBoundingClientRect();
    this.element.hidden = false;
    setText(this.value, value);
    setText(this.note, note);
    this.note.hidden = note === '';
    const x = Math.min(clientX - left + BESIDE, width - this.element.offsetWidth - 4);
    const y = Math.min(clientY - top + BESIDE, height - this.element.offsetHeight - 4);
    this.element.style.transform = `translate(${Math.round(x)}px, ${Math.round(y)}px)`;
  }

  hide(): void {
    this.element.hidden = true;
  }

  remove(): void {
    this.element.remove();
  }
}
