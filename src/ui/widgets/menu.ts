/**
 * A popup menu: entries, separators, submenus, arrow keys, first letters, Escape. Used by the menu bar, menu buttons
 * and context menus; what the entries do is up to the caller.
 */
import { element, setAttribute, uniqueId } from './dom.ts';
import { type IconName, icon } from './icons.ts';
import { touchWords } from './touch-words.ts';

export type MenuEntry =
  | MenuItem
  | { readonly kind: 'line' }
  | { readonly kind: 'note'; readonly text: string }
  | SubMenu;

export interface MenuItem {
  readonly kind: 'item';
  readonly label: string;
  /** Before the label, where a menu shows those of its buttons elsewhere. */
  readonly icon?: IconName;
  readonly detail?: string;
  /** Shown at the right edge. */
  readonly shortcut?: string;
  readonly ariaShortcut?: string;
  readonly enabled: boolean;
  /** Chosen while disabled: says why. Without it the menu stays open. */
  readonly refuse?: () => void;
  /** Absent: not checkable. `mixed`: of some of what is selected, not for `radio`. */
  readonly checked?: boolean | 'mixed';
  readonly radio?: boolean;
  run(): void;
}

export interface SubMenu {
  readonly kind: 'menu';
  readonly label: string;
  entries(): readonly MenuEntry[];
}

/** A point of the window; opened by keyboard, the first entry is focused. */
export interface MenuPlace {
  readonly x: number;
  readonly y: number;
  readonly byKeyboard?: boolean;
}

/** Where a menu opens: below or beside an element, or at a point. */
export type Anchor = DOMRect | MenuPlace;

export interface MenuOptions {
  readonly label: string;
  /** What it belongs to; gets the focus back after keyboard use. */
  readonly opener?: HTMLElement;
  /** The opener is a button, whose next click closes the menu. */
  readonly opensByClick?: boolean;
  /** Opened by keyboard: focuses the first entry. */
  readonly focusFirst?: boolean;
  /** Index of the item that is in view, and focused first, instead of the first. */
  readonly startAt?: number;
  /** Pixels. */
  readonly minWidth?: number;
  /** Called once. */
  onClose?(): void;
  /** Left or right arrow out of the menu: the menu bar moves to its neighbour. */
  onLeave?(step: -1 | 1): void;
}

/** Whether a key opens the context menu of what has the focus: the Menu key, or Shift+F10. */
export function asksForMenu({ key, shiftKey, ctrlKey, altKey, metaKey }: KeyboardEvent): boolean {
  return !ctrlKey && !altKey && !metaKey && (key === 'ContextMenu' || (key === 'F10' && shiftKey));
}

const SMALL = '(max-width: 600px)';
/** Pixels kept free at the window's edges. */
const MARGIN = 4;
const HOVER_OPENS_MS = 120;
const TYPE_AHEAD_MS = 600;

/** The page's open menu. */
let open: Menu | undefined;

export function openMenu(anchor: Anchor, entries: readonly MenuEntry[], options: MenuOptions): Menu {
  // After mouse use the focus returns to where it was, so that shortcuts keep their meaning.
  const before = open?.returnTo ?? document.activeElement;
  open?.close(false);
  const focusFirst = options.focusFirst ?? ('byKeyboard' in anchor && anchor.byKeyboard === true);
  const menu = new Menu(entries, { ...options, focusFirst });
  menu.returnTo = focusFirst ? (options.opener ?? before) : before;
  open = menu;
  menu.showAt(anchor, 'below');
  return menu;
}

export class Menu {
  private readonly element = element('div', { role: 'menu', class: 'menu', tabindex: -1 });
  private readonly items: HTMLElement[] = [];
  /** Gets the focus when the menu closes. */
  returnTo: Element | null = null;
  private child: Menu | undefined;
  private timer: ReturnType<typeof setTimeout> | undefined;
  private typed = '';
  private typedAt = 0;
  private closed = false;

  constructor(
    entries: readonly MenuEntry[],
    private readonly options: MenuOptions,
    private readonly parent?: Menu,
  ) {
    setAttribute(this.element, 'aria-label', options.label);
    const ticks = entries.some((e) => e.kind === 'item' && e.checked !== undefined);
    this.element.classList.toggle('with-ticks', ticks);
    this.element.classList.toggle(
      'with-icons',
      entries.some((e) => e.kind === 'item' && e.icon !== undefined),
    );
    // A submenu fills a small screen: there is no other place to tap.
    if (parent && window.matchMedia(SMALL).matches) this.element.append(this.buildBack());
    for (const entry of entries) this.element.append(this.build(entry));
    this.element.addEventListener('keydown', (event) => this.onKey(event));
    this.element.addEventListener('contextmenu', (event) => event.preventDefault());
  }

  showAt(anchor: Anchor, side: 'below' | 'beside'): void {
    const { minWidth, focusFirst, startAt = 0 } = this.options;
    // A modal dialog covers, and disables, everything that isn't in it.
    (document.querySelector('dialog:modal') ?? document.body).append(this.element);
    if (minWidth) this.element.style.minWidth = `${minWidth}px`;
    place(this.element, anchor, side);
    if (!this.parent) document.addEventListener('pointerdown', this.onOutside, true);
    if (startAt > 0) this.items[startAt]?.scrollIntoView({ block: 'nearest' });
    if (focusFirst) this.focusAt(Math.max(0, startAt));
    else this.element.focus({ preventScroll: true });
  }

  close(refocus: boolean): void {
    if (this.closed) return;
    this.closed = true;
    clearTimeout(this.timer);
    this.child?.close(false);
    document.removeEventListener('pointerdown', this.onOutside, true);
    this.element.remove();
    if (open === this) open = undefined;
    this.options.onClose?.();
    if (refocus && this.returnTo instanceof HTMLElement) this.returnTo.focus({ preventScroll: true });
  }

  /** Closes all of them, from the root. */
  private closeAll(refocus: boolean): void {
    if (this.parent) this.parent.closeAll(refocus);
    else this.close(refocus);
  }

  private readonly onOutside = (event: PointerEvent) => {
    if (!(event.target instanceof Node) || this.contains(event.target)) return;
    // Its click closes the menu: if the press did, the click would find none and open it again.
    if (this.options.opensByClick && this.options.opener?.contains(event.target)) return;
    this.close(false);
  };

  private contains(node: Node): boolean {
    return this.element.contains(node) || (this.child?.contains(node) ?? false);
  }

  private build(entry: MenuEntry): HTMLElement {
    switch (entry.kind) {
      case 'line':
        return element('div', { role: 'separator', class: 'menu-line' });
      case 'note':
        return element('div', { class: 'menu-note' }, entry.text);
      case 'menu':
        return this.buildSubMenu(entry);
      case 'item':
        return this.buildItem(entry);
    }
  }

  private buildBack(): HTMLElement {
    const label = element('span', { class: 'menu-label' }, '‹ Back');
    const item = element('div', { role: 'menuitem', class: 'menu-item', tabindex: -1 }, label);
    item.addEventListener('click', () => this.back(false));
    this.items.push(item);
    return item;
  }

  private buildItem(entry: MenuItem): HTMLElement {
    const role = entry.checked === undefined ? 'menuitem' : entry.radio ? 'menuitemradio' : 'menuitemcheckbox';
    const item = element('div', {
      role,
      class: 'menu-item',
      tabindex: -1,
      'aria-checked': entry.checked === undefined ? undefined : String(entry.checked),
      'aria-disabled': entry.enabled ? undefined : 'true',
      'aria-keyshortcuts': entry.ariaShortcut,
    });
    const tick = element('span', { class: 'menu-tick' });
    if (entry.checked) tick.append(icon(entry.radio ? 'dot' : entry.checked === 'mixed' ? 'mixed' : 'check'));
    const text = element('span', { class: 'menu-label' }, entry.label);
    // The space is for screen readers.
    if (entry.detail) text.append(' ', element('span', { class: 'menu-detail' }, touchWords(entry.detail)));
    item.append(tick, ...(entry.icon ? [icon(entry.icon)] : []), text);
    if (entry.shortcut) item.append(element('kbd', { 'aria-hidden': 'true' }, entry.shortcut));
    item.addEventListener('pointerenter', (event) => {
      if (hovers(event)) this.hover(item);
    });
    item.addEventListener('click', () => this.run(entry));
    this.items.push(item);
    return item;
  }

  private buildSubMenu(entry: SubMenu): HTMLElement {
    const item = element(
      'div',
      { role: 'menuitem', class: 'menu-item', tabindex: -1, 'aria-haspopup': 'menu', 'aria-expanded': 'false' },
      element('span', { class: 'menu-tick' }),
      element('span', { class: 'menu-label' }, entry.label),
      icon('fold'),
    );
    const show = (focusFirst: boolean) => {
      this.child?.close(false);
      setAttribute(item, 'aria-expanded', 'true');
      this.child = new Menu(
        entry.entries(),
        {
          label: entry.label,
          focusFirst,
          onClose: () => {
            this.child = undefined;
            setAttribute(item, 'aria-expanded', 'false');
          },
        },
        this,
      );
      this.child.showAt(item.getBoundingClientRect(), 'beside');
    };
    item.addEventListener('pointerenter', (event) => {
      if (!hovers(event)) return;
      this.hover(item);
      this.timer = setTimeout(() => show(false), HOVER_OPENS_MS);
    });
    item.addEventListener('click', () => show(false));
    this.subMenus.set(item, show);
    this.items.push(item);
    return item;
  }

  private readonly subMenus = new Map<HTMLElement, (focusFirst: boolean) => void>();

  private hover(item: HTMLElement): void {
    clearTimeout(this.timer);
    if (this.child && item.getAttribute('aria-expanded') !== 'true') this.child.close(false);
    item.focus({ preventScroll: true });
  }

  private run(entry: MenuItem): void {
    if (!entry.enabled && !entry.refuse) return;
    this.closeAll(true);
    if (entry.enabled) entry.run();
    else entry.refuse?.();
  }

  private focusAt(index: number): void {
    const count = this.items.length;
    if (count) this.items[(index + count) % count].focus();
  }

  private onKey(event: KeyboardEvent): void {
    // A menu captures the keyboard, including keys that it doesn't use.
    event.stopPropagation();
    if (event.key === 'Tab') {
      this.closeAll(true);
      return;
    }
    event.preventDefault();
    const { activeElement } = document;
    const focused = activeElement instanceof HTMLElement ? this.items.indexOf(activeElement) : -1;
    const item = this.items[focused];
    const show = item && this.subMenus.get(item);
    if (event.key === 'ArrowDown') this.focusAt(focused + 1);
    else if (event.key === 'ArrowUp') this.focusAt(focused < 0 ? -1 : focused - 1);
    else if (event.key === 'Home') this.focusAt(0);
    else if (event.key === 'End') this.focusAt(-1);
    else if (event.key === 'Escape') this.back(true);
    else if (event.key === 'ArrowRight' && show) show(true);
    else if (event.key === 'ArrowRight') this.leave(1);
    else if (event.key === 'ArrowLeft' && this.parent) this.back(true);
    else if (event.key === 'ArrowLeft') this.leave(-1);
    else if ((event.key === 'Enter' || event.key === ' ') && show) show(true);
    else if (event.key === 'Enter' || event.key === ' ') item?.click();
    else if (event.key.length === 1 && !event.ctrlKey && !event.metaKey) this.typeAhead(event.key, focused);
  }

  private back(refocus: boolean): void {
    const { parent } = this;
    const from = parent?.items.find((item) => item.getAttribute('aria-expanded') === 'true');
    this.close(refocus);
    from?.focus();
  }

  private leave(step: -1 | 1): void {
    if (this.parent) this.parent.leave(step);
    else this.options.onLeave?.(step);
  }

  private typeAhead(key: string, focused: number): void {
    const now = performance.now();
    this.typed = now - this.typedAt < TYPE_AHEAD_MS ? this.typed + key.toLowerCase() : key.toLowerCase();
    this.typedAt = now;
    const from = this.typed.length > 1 ? Math.max(0, focused) : focused + 1;
    for (let i = 0; i < this.items.length; i++) {
      const item = this.items[(from + i) % this.items.length];
      const label = item.querySelector('.menu-label')?.textContent?.toLowerCase() ?? '';
      if (!label.startsWith(this.typed)) continue;
      item.focus();
      return;
    }
  }
}

/**
 * A menu button: the menu opens below it, closes on the next click on it or press outside, and
 * returns the focus.
 *
 * @param instead what a press does where no choice is needed; returns whether it did
 */
export function menuButton(
  target: HTMLButtonElement,
  label: string,
  entries: () => readonly MenuEntry[],
  instead?: () => boolean,
): void {
  setAttribute(target, 'aria-haspopup', 'menu');
  setAttribute(target, 'aria-expanded', 'false');
  target.id ||= uniqueId('menu-button');
  let shown: Menu | undefined;
  const show = (focusFirst: boolean) => {
    setAttribute(target, 'aria-expanded', 'true');
    shown = openMenu(target.getBoundingClientRect(), entries(), {
      label,
      opener: target,
      opensByClick: true,
      focusFirst,
      onClose() {
        shown = undefined;
        setAttribute(target, 'aria-expanded', 'false');
      },
    });
  };
  target.addEventListener('click', (event) => {
    if (shown) shown.close(true);
    else if (!instead?.()) show(event.detail === 0);
  });
  target.addEventListener('keydown', (event) => {
    if (event.key !== 'ArrowDown' && event.key !== 'ArrowUp') return;
    event.preventDefault();
    show(true);
  });
}

/** A finger that comes by scrolls the menu. */
function hovers({ pointerType }: PointerEvent): boolean {
  return pointerType !== 'touch';
}

function place(menu: HTMLElement, anchor: Anchor, side: 'below' | 'beside'): void {
  const { innerWidth, innerHeight } = window;
  const isRect = anchor instanceof DOMRect;
  menu.style.maxHeight = `${innerHeight - 2 * MARGIN}px`;
  const { width, height } = menu.getBoundingClientRect();
  let left: number;
  let top: number;
  if (side === 'beside' && isRect) {
    left = anchor.right - 2;
    if (left + width > innerWidth - MARGIN) left = anchor.left - width + 2;
    top = anchor.top - 5;
  } else {
    left = isRect ? anchor.left : anchor.x;
    top = isRect ? anchor.bottom + 2 : anchor.y;
    // Near the window's bottom it opens upwards, if there is room.
    if (isRect && top + height > innerHeight - MARGIN && anchor.top - height - 2 >= MARGIN)
      top = anchor.top - height - 2;
  }
  menu.style.left = `${Math.max(MARGIN, Math.min(left, innerWidth - width - MARGIN))}px`;
  menu.style.top = `${Math.max(MARGIN, Math.min(top, innerHeight - height - MARGIN))}px`;
}
