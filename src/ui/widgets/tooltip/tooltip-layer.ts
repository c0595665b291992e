/**
 * Shows tooltips: a single element in the top layer, so that it is over dialogs too, with listeners on the window
 * rather than on every element. It lets pointer events through.
 */
import { element, setAttribute, setText, uniqueId, write } from '../dom.ts';
import { isTextField } from '../focus/focus.ts';
import { type Tooltip, tooltipAround, tooltipOf } from '../tooltip.ts';
import { isOnTooltip, placeTooltip } from './tooltip-placement.ts';
import { dueAt, NO_TOOLTIP, nextTooltip, type TooltipEvent, type TooltipState } from './tooltip-state.ts';

/** Interval at which the shown text is updated. */
const REFRESH_MS = 200;
/** A finger that moves further scrolls or drags. */
const HOLD_SLOP = 8;

/** @param signal removes it and its listeners */
export function startTooltips(signal: AbortSignal): void {
  const layer = new TooltipLayer();
  const on = <K extends keyof WindowEventMap>(type: K, listener: (event: WindowEventMap[K]) => void) =>
    window.addEventListener(type, listener, { signal, capture: true });
  on('pointerover', (event) => layer.onPointer(event));
  on('pointermove', (event) => layer.onPointer(event));
  on('pointerout', (event) => {
    if (event.relatedTarget === null) layer.send({ kind: 'over', target: undefined });
  });
  on('pointerdown', (event) => layer.onPress(event));
  on('pointerup', () => layer.send({ kind: 'lift' }));
  on('pointercancel', () => layer.send({ kind: 'lift' }));
  on('click', (event) => layer.onClick(event));
  // After the page, which may have a menu of its own.
  window.addEventListener('contextmenu', (event) => layer.onContextMenu(event), { signal });
  on('keydown', (event) => layer.onKeyDown(event));
  on('keyup', (event) => layer.onKeyUp(event));
  on('focusin', () => layer.showFocus());
  on('focusout', () => layer.send({ kind: 'focus', target: undefined }));
  on('scroll', (event) => layer.onScroll(event));
  on('wheel', () => layer.send({ kind: 'dismiss' }));
  on('blur', (event) => {
    if (event.target === window) layer.onLeave();
  });
  signal.addEventListener('abort', () => layer.remove());
}

class TooltipLayer {
  private readonly text = element('span', { class: 'tooltip-text' });
  private readonly shortcut = element('kbd', { id: uniqueId('tooltip') });
  private readonly element = element(
    'div',
    { class: 'tooltip', role: 'tooltip', id: uniqueId('tooltip'), popover: 'manual' },
    this.text,
    // For screen readers.
    ' ',
    this.shortcut,
  );
  private state: TooltipState<Element> = NO_TOOLTIP;
  private timer: ReturnType<typeof setTimeout> | undefined;
  private refreshing: ReturnType<typeof setInterval> | undefined;
  /** The target's `aria-describedby` without the tooltip. */
  private described: { readonly target: Element; readonly by: string | null } | undefined;
  /** Whether the keyboard was used last. */
  private isByKeyboard = false;
  private finger: { readonly x: number; readonly y: number; hasShown: boolean } | undefined;

  constructor() {
    document.body.append(this.element);
  }

  remove(): void {
    this.send({ kind: 'dismiss' });
    this.element.remove();
  }

  send(event: TooltipEvent<Element>): void {
    const before = this.state;
    const next = nextTooltip(before, event, performance.now());
    if (next === before) return;
    this.state = next;
    clearTimeout(this.timer);
    const due = dueAt(next);
    // Timers may fire slightly early.
    if (due !== undefined) this.timer = setTimeout(() => this.send({ kind: 'time' }), due - performance.now() + 1);
    const shown = next.kind === 'shown' ? next.target : undefined;
    if (shown === (before.kind === 'shown' ? before.target : undefined)) return;
    this.hide();
    if (shown) this.show(shown);
  }

  onPointer(event: PointerEvent): void {
    if (event.pointerType === 'touch') {
      const { finger } = this;
      if (finger && Math.hypot(event.clientX - finger.x, event.clientY - finger.y) > HOLD_SLOP) {
        this.finger = undefined;
        this.send({ kind: 'dismiss' });
      }
      return;
    }
    // While none is shown, only entering a new element matters.
    if (event.buttons || (event.type === 'pointermove' && this.state.kind !== 'shown')) return;
    const found = event.target instanceof Element ? worthShowing(tooltipAround(event.target)) : undefined;
    const isOn =
      !found &&
      this.state.kind === 'shown' &&
      isOnTooltip(event.clientX, event.clientY, this.element.getBoundingClientRect());
    this.send(isOn ? { kind: 'onTooltip' } : { kind: 'over', target: found?.target });
  }

  onPress(event: PointerEvent): void {
    this.isByKeyboard = false;
    this.finger = undefined;
    this.send({ kind: 'dismiss' });
    if (event.pointerType !== 'touch' || !event.isPrimary || !(event.target instanceof Element)) return;
    const found = worthShowing(tooltipAround(event.target));
    if (!found) return;
    this.finger = { x: event.clientX, y: event.clientY, hasShown: false };
    this.send({ kind: 'hold', target: found.target });
  }

  /** Holding a finger to read doesn't press the button. */
  onClick(event: MouseEvent): void {
    if (!this.finger?.hasShown || event.detail === 0) return;
    this.finger = undefined;
    event.preventDefault();
    event.stopImmediatePropagation();
  }

  /**
   * A held finger also asks for a context menu. The page's own, and that of a text field, win over the tooltip; the
   * tooltip wins over any other of the browser's.
   */
  onContextMenu(event: MouseEvent): void {
    if (!this.finger) return;
    const { target } = event;
    if (event.defaultPrevented || (target instanceof Element && isTextField(target))) this.send({ kind: 'dismiss' });
    else event.preventDefault();
  }

  onKeyDown(event: KeyboardEvent): void {
    this.isByKeyboard = true;
    this.finger = undefined;
    if (event.key === 'Escape' || event.key === 'Enter' || event.key === ' ') this.send({ kind: 'dismiss' });
  }

  /** Lists keep the focus while arrow keys move between rows. */
  onKeyUp(event: KeyboardEvent): void {
    const isMove = /^(Arrow|Home|End|Page)/.test(event.key);
    if (isMove && document.activeElement?.hasAttribute('aria-activedescendant')) this.showFocus();
  }

  /** Tooltip of the focused control, or of its active row. */
  showFocus(): void {
    const { activeElement } = document;
    if (!this.isByKeyboard || !activeElement?.matches(':focus-visible')) return;
    const row = document.getElementById(activeElement.getAttribute('aria-activedescendant') ?? '');
    const found = row ? tooltipWithin(row) : worthShowing(tooltipAround(activeElement));
    if (this.state.kind === 'hidden' && this.state.dismissed === found?.target) return;
    this.send({ kind: 'focus', target: found?.target });
  }

  /** Scrolling of what contains the target; other scrolling doesn't move it. */
  onScroll(event: Event): void {
    const { state } = this;
    if (state.kind === 'hidden' || !(event.target instanceof Node) || !event.target.contains(state.target)) return;
    this.send({ kind: 'dismiss' });
  }

  onLeave(): void {
    this.isByKeyboard = false;
    this.send({ kind: 'dismiss' });
  }

  private show(target: Element): void {
    const tooltip = tooltipOf(target);
    if (!tooltip) return;
    if (this.finger) this.finger.hasShown = true;
    this.write(tooltip);
    // Before it is there, so that it is laid out where it has room.
    this.element.style.left = this.element.style.top = '0';
    this.element.showPopover();
    this.place(target);
    this.describe(tooltip);
    this.refreshing = setInterval(() => this.refresh(target), REFRESH_MS);
  }

  private hide(): void {
    clearInterval(this.refreshing);
    const { described } = this;
    if (described) setAttribute(described.target, 'aria-describedby', described.by ?? undefined);
    this.described = undefined;
    if (this.element.matches(':popover-open')) this.element.hidePopover();
  }

  /** The text may change while shown, and its element may be removed. */
  private refresh(target: Element): void {
    const tooltip = target.isConnected && target.getClientRects().length > 0 ? tooltipOf(target) : undefined;
    if (!tooltip) this.send({ kind: 'dismiss' });
    else if (this.write(tooltip)) this.place(target);
  }

  private write({ text, shortcut = '' }: Tooltip): boolean {
    if (this.text.textContent === text && this.shortcut.textContent === shortcut) return false;
    setText(this.text, text);
    setText(this.shortcut, shortcut);
    write(this.shortcut, 'hidden', shortcut === '');
    return true;
  }

  private place(target: Element): void {
    const { width, height } = this.element.getBoundingClientRect();
    const { clientWidth, clientHeight } = document.documentElement;
    const at = placeTooltip(
      target.getBoundingClientRect(),
      { width, height },
      { width: clientWidth, height: clientHeight },
    );
    this.element.style.left = `${at.left}px`;
    this.element.style.top = `${at.top}px`;
  }

  /** A text equal to the name isn't read twice. */
  private describe({ target, text, shortcut }: Tooltip): void {
    const isNamed = text === (target.getAttribute('aria-label') ?? plain(target.textContent));
    const id = !isNamed ? this.element.id : shortcut ? this.shortcut.id : undefined;
    if (id === undefined) return;
    const by = target.getAttribute('aria-describedby');
    this.described = { target, by };
    setAttribute(target, 'aria-describedby', by ? `${by} ${id}` : id);
  }
}

/** No tooltip that only repeats a fully visible text. */
function worthShowing(tooltip: Tooltip | undefined): Tooltip | undefined {
  if (!tooltip || tooltip.shortcut || plain(tooltip.target.textContent) !== plain(tooltip.text)) return tooltip;
  const parts = [tooltip.target, ...tooltip.target.querySelectorAll('*')];
  return parts.some((part) => part.scrollWidth > part.clientWidth && part.clientWidth > 0) ? tooltip : undefined;
}

/** The row's own tooltip, or else the first in it. */
function tooltipWithin(row: Element): Tooltip | undefined {
  for (const part of [row, ...row.querySelectorAll('*')]) {
    const found = worthShowing(tooltipOf(part));
    if (found) return found;
  }
  return undefined;
}

function plain(text: string | null): string {
  return (text ?? '').replace(/\s+/g, ' ').trim();
}
