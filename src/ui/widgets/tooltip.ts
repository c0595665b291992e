/**
 * Tooltips: shown when the pointer rests on an element, the keyboard focuses it, or a finger holds it. Replaces the
 * browser's `title`, which neither focus nor touch shows. `startTooltips` (tooltip-layer.ts) displays them.
 */

import { cutMessage } from '../../model/names/cut-text.ts';

/** A function is called while shown, for texts that depend on state; empty or undefined: no tooltip. */
export type TooltipText = string | (() => string | undefined);

export interface Tooltip {
  readonly target: Element;
  readonly text: string;
  readonly shortcut: string | undefined;
}

interface Source {
  readonly text: TooltipText;
  readonly shortcut: (() => string | undefined) | undefined;
}

const sources = new WeakMap<Element, Source>();

/**
 * Sets the tooltip of an element. It isn't the accessible name: an element without a label needs an `aria-label` too.
 *
 * @param shortcut the equivalent shortcut, as text
 */
export function setTooltip(target: Element, text: TooltipText | undefined, shortcut?: () => string | undefined): void {
  if (text === undefined || text === '') sources.delete(target);
  else sources.set(target, { text, shortcut });
}

/** The tooltip of an element; undefined if it has none now. */
export function tooltipOf(target: Element): Tooltip | undefined {
  const source = sources.get(target);
  const text = typeof source?.text === 'function' ? source.text() : source?.text;
  return text ? { target, text: cutMessage(text), shortcut: source?.shortcut?.() } : undefined;
}

/** The tooltip of an element, or of its nearest ancestor with one. */
export function tooltipAround(inner: Element | null): Tooltip | undefined {
  for (let target = inner; target; target = target.parentElement) {
    const tooltip = tooltipOf(target);
    if (tooltip) return tooltip;
  }
  return undefined;
}
