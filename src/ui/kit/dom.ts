/**
 * Making elements, in one expression and never from markup: text that comes out of files stays text.
 */
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

/** A button that does something; `label` is what a screen reader says and what the tooltip shows. */
export function button(label: string, attributes: Attributes, content: Child, onClick: () => void): HTMLButtonElement {
  const made = element('button', { type: 'button', 'aria-label': label, tooltip: label, ...attributes }, content);
  made.addEventListener('click', onClick);
  return made;
}

/**
 * A mouse click on it leaves the focus where it was, so that keys go on meaning what they meant. Tab still gets there.
 * Only a text field lets go, as it would of any other click: its typing is over, and keys are meant for the panel again.
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

/** For state that changes at every frame: the DOM is only touched where it is different. */
export function setAttribute(target: Element, name: string, value: string | undefined): void {
  if (value === undefined) target.removeAttribute(name);
  else if (target.getAttribute(name) !== value) target.setAttribute(name, value);
}

/** A unique id for what aria attributes point at. */
export function uniqueId(prefix: string): string {
  return `${prefix}-${++ids}`;
}
let ids = 0;
