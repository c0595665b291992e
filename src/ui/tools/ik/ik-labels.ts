/** A few lines of text that stand beside points of the picture: names of pins, and what is in the way of one. */
import { element, setText } from '../../dom.ts';
import type { Workbench } from '../../workbench.ts';

export type LabelKind = 'name' | 'gap';

export interface Label {
  readonly text: string;
  readonly kind: LabelKind;
  /** Client coordinates of the point that it stands beside. */
  readonly x: number;
  readonly y: number;
}

export class IkLabels {
  readonly element = element('div', { class: 'ik-labels' });
  private readonly lines: HTMLElement[] = [];
  /** What is in the way, said once it stays: it changes with every move of the hand. */
  private readonly spoken = element('div', { class: 'visually-hidden', role: 'status' });

  constructor(private readonly wb: Workbench) {
    this.element.append(this.spoken);
  }

  show(labels: readonly Label[]): void {
    const { left, top, width, height } = labels.length
      ? this.wb.viewport.canvas.getBoundingClientRect()
      : { left: 0, top: 0, width: 0, height: 0 };
    labels.forEach(({ text, kind, x, y }, i) => {
      const line = this.line(i);
      setText(line, text);
      line.dataset.kind = kind;
      const isOut = x < left || y < top || x > left + width || y > top + height;
      // A target out of the picture still says what is in the way, at the edge.
      line.hidden = isOut && kind === 'name';
      const inX = Math.min(Math.max(x - left, 0), width);
      const inY = Math.min(Math.max(y - top, 0), height);
      line.style.transform = `translate(${inX.toFixed(1)}px, ${inY.toFixed(1)}px)`;
      line.classList.toggle('to-left', inX > width - 200);
    });
    for (let i = labels.length; i < this.lines.length; i++) this.lines[i].hidden = true;
  }

  /** For who can't see it. */
  say(text: string): void {
    setText(this.spoken, text);
  }

  private line(i: number): HTMLElement {
    let line = this.lines[i];
    if (!line) {
      line = element('div', { class: 'ik-label', 'aria-hidden': 'true' });
      this.lines.push(line);
      this.element.append(line);
    }
    line.hidden = false;
    return line;
  }
}
