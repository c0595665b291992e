/** One pose of the library: thumbnail, and name, edited in place. */
import { element, setAttribute, setText, write } from '../../widgets/dom.ts';
import { setTooltip } from '../../widgets/tooltip.ts';

/** CSS pixels. */
const PICTURE = { width: 112, height: 112 };

export interface CardEvents {
  rename(name: string): void;
  /** Editing has ended, either way. */
  renamed(): void;
}

export class PoseCard {
  readonly element: HTMLElement;
  readonly canvas = element('canvas', { class: 'pose-picture', 'aria-hidden': 'true' });
  private readonly name = element('span', { class: 'pose-name' });
  private readonly share = element('span', { class: 'pose-share', hidden: true });
  private field: HTMLInputElement | undefined;

  constructor(id: string) {
    const density = Math.min(2, window.devicePixelRatio || 1);
    this.canvas.width = Math.round(density * PICTURE.width);
    this.canvas.height = Math.round(density * PICTURE.height);
    this.element = element('div', { class: 'pose-card', role: 'option', id }, this.canvas, this.share, this.name);
  }

  show(name: string, isChosen: boolean): void {
    setText(this.name, name);
    setTooltip(this.name, `${name}. Double-click to rename`);
    setTooltip(this.element, `${name}. Click to apply, Alt+drag sideways to blend`);
    setAttribute(this.element, 'aria-selected', String(isChosen));
    setAttribute(this.element, 'aria-label', name);
  }

  /** Share of the pose while it is blended; undefined hides it. */
  showShare(share: number | undefined): void {
    write(this.share, 'hidden', share === undefined);
    if (share !== undefined) {
      setText(this.share, `${Math.round(100 * share)} %`);
      this.share.style.setProperty('--share', String(share));
    }
  }

  get isRenaming(): boolean {
    return this.field !== undefined;
  }

  startRename(events: CardEvents): void {
    if (this.field) return;
    const before = this.name.textContent ?? '';
    const field = element('input', { type: 'text', class: 'rename', 'aria-label': 'Pose name', value: before });
    const end = (keep: boolean) => {
      if (this.field !== field) return;
      this.field = undefined;
      const name = field.value.trim();
      field.replaceWith(this.name);
      if (keep && name && name !== before) events.rename(name);
      events.renamed();
    };
    field.addEventListener('keydown', (event) => {
      event.stopPropagation();
      if (event.isComposing) return;
      if (event.key === 'Enter' || event.key === 'Escape') {
        event.preventDefault();
        end(event.key === 'Enter');
      }
    });
    field.addEventListener('blur', () => end(true));
    for (const kind of ['pointerdown', 'click', 'dblclick'] as const) {
      field.addEventListener(kind, (event) => event.stopPropagation());
    }
    this.field = field;
    this.name.replaceWith(field);
    field.focus();
    field.select();
  }
}
