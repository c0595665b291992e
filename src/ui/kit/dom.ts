/** Creates elements, in one expression and never from markup: text from files stays text. */
import { isTextField, leaveField } from './focus.ts';
import { setTooltip } from './tooltip.ts';

type Attributes = Readonly<Record<string, string | number | boolean | undefined>>;
type Child = Node | string | undefined | false;

/** `true` sets an empty attribute, `false` and undefined none; `tooltip` is its tooltip, as by `setTooltip`. */
export function element<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  attributes: Attributes = {},
  ...children: Child[]
): HTMLElementTagNameMap[K] {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (value === undefined || value === false) continue;
    if (name === 'tooltip') setTooltip(made, String(value));
    else made.setAttribute(name, value === true ? '' : String(value));
  }
  for (const child of children) if (child) made.append(child);
  return made;
}

/** A button; `label` is its accessible name and tooltip. */
export function button(label: string, attributes: Attributes, content: Child, onClick: () => void): HTMLButtonElement {
  const made = element('button', { type: 'button', 'aria-label': label, tooltip: label, ...attributes }, content);
  made.addEventListener('click', onClick);
  return made;
}

/**
 * A mouse click on it keeps the focus elsewhere, so that shortcuts keep their meaning. Tab still reaches it. Only a
 * text field loses the focus, as with any other click: editing ends, and keys belong to the panel again.
 */
export function keepsFocusElsewhere<T extends HTMLElement>(target: T): T {
  target.addEventListener('mousedown', (event) => {
    event.preventDefault();
    const { activeElement } = document;
    if (isTextField(activeElement) && !target.contains(activeElement)) leaveField(activeElement, target);
  });
  return target;
}

export function setText(target: Element, text: string): void {
  if (target.textContent !== text) target.textContent = text;
}

/** For state that changes every frame: touches the DOM only if it differs. */
export function setAttribute(target: Element, name: string, value: string | undefined): void {
  if (value === undefined) target.removeAttribute(name);
  else if (target.getAttribute(name) !== value) target.setAttribute(name, value);
}

/** A unique id for aria attributes to refer to. */
export function uniqueId(prefix: string): string {
  return `${prefix}-${++ids}`;
}
let ids = 0;
